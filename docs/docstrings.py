"""A Sphinx extension: prepares docstrings of the project for reStructuredText.

In: the lines of a docstring, as autodoc found them. Out: the same lines, changed in place: a tree
that is drawn with box characters becomes a literal block.
"""

from __future__ import annotations

from typing import Any

from sphinx.application import Sphinx

_TREE = ("├", "└", "│")


def mark_trees(lines: list[str]) -> list[str]:
    """`lines` with every drawn tree, and the line that is its root, in a literal block."""
    first = next((i for i, line in enumerate(lines) if line.lstrip().startswith(_TREE)), None)
    if first is None:
        return lines
    root = first - 1
    last = max(i for i, line in enumerate(lines) if line.lstrip().startswith(_TREE))
    tree = [f"    {line}" for line in lines[root : last + 1]]
    return [*lines[:root], "::", "", *tree, "", *lines[last + 1 :]]


def _process(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    lines[:] = mark_trees(lines)


def setup(app: Sphinx) -> dict[str, bool]:
    """Connect to autodoc."""
    app.connect("autodoc-process-docstring", _process)
    return {"parallel_read_safe": True}
