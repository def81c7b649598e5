"""Applies `--set motors[2].min=-1`: values of the command line override the tree of the file.

In: items `path=value`. Out: the same tree with raw scalars at these paths, and findings that point
into the command line.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from robocomp_dsl.finding import Finding, Location, SourceText
from robocomp_dsl.runtime.parameters.tree import (
    NODE_NAMES,
    Items,
    Mapping,
    Member,
    Node,
    Scalar,
    TextSyntax,
)
from robocomp_dsl.runtime.parameters.value_list import split

SOURCE_NAME = "--set"
"""Name of the command line in findings."""
_STEP = re.compile(r"\.?([A-Za-z_][A-Za-z0-9_-]*)|\[([0-9]{1,6})\]")


def parse_path(path: str) -> list[str | int] | None:
    """`a.b[2].c` as `["a", "b", 2, "c"]`; None if the path is invalid."""
    steps: list[str | int] = []
    at = 0
    while at < len(path):
        step = _STEP.match(path, at)
        if step is None or (at == 0 and path[0] in ".["):
            return None
        steps.append(step[1] if step[1] is not None else int(step[2]))
        at = step.end()
        if at < len(path) and path[at] not in ".[":
            return None
    return steps or None


def format_path(path: Iterable[str | int]) -> str:
    """The inverse of `parse_path`."""
    text = ""
    for step in path:
        text += f"[{step}]" if isinstance(step, int) else f".{step}" if text else step
    return text


def apply(root: Mapping, overrides: Iterable[str], findings: list[Finding]) -> Mapping:
    """`root` with all overrides applied; later ones take precedence."""
    for written in overrides:
        path, equals, value = written.partition("=")
        text = SourceText(SOURCE_NAME, (written,))
        key = Location(text, 1, 1, max(1, len(path)))
        found = parse_path(path.strip()) if equals else None
        if found is None:
            message = f"`--set {written:.80}` is not of the form `key=value`"
            findings.append(
                Finding(key, message, help="write for instance `--set motors[2].min=-1`")
            )
            continue
        leaf = Scalar(Location(text, 1, len(path) + 2, max(1, len(value))), value, TextSyntax.RAW)
        root = set_node(root, found, key, leaf, findings)
    return root


def set_node(
    root: Mapping,
    path: list[str | int],
    key: Location,
    leaf: Node,
    findings: list[Finding],
) -> Mapping:
    """`root` with `leaf` at `path`; adds a finding at `key` if the path is invalid."""
    try:
        changed = _replace(root, path, 0, key, leaf)
    except _InvalidPath as error:
        findings.append(Finding(key, str(error)))
        return root
    assert isinstance(changed, Mapping)  # noqa: S101 - a root stays what it is
    return changed


class _InvalidPath(Exception):
    """A path step that does not fit the node it is applied to."""


def _replace(
    node: Node | None, path: list[str | int], depth: int, key: Location, leaf: Node
) -> Node:
    """A copy of `node` with `leaf` at `path[depth:]`; aliases of the node are unchanged."""
    if depth == len(path):
        return leaf
    step = path[depth]
    if isinstance(step, int):
        items = _items(node, step, path[:depth])
        entry = items[step] if step < len(items) else None
        items[step:] = [_replace(entry, path, depth + 1, key, leaf), *items[step + 1 :]]
        return Items(node.place if node else key, items)
    members = _members(node, step, path[:depth])
    member = members.get(step)
    old = member.value if member else None
    below = _replace(old, path, depth + 1, key, leaf)
    members[step] = Member(key if below is leaf or member is None else member.place, below)
    return Mapping(node.place if node else key, members)


def _items(node: Node | None, step: int, above: list[str | int]) -> list[Node]:
    if isinstance(node, Scalar) and node.style is TextSyntax.RAW:
        node = Items(node.place, [*split(node)])
    if not isinstance(node, Items | None):
        raise _InvalidPath(
            f"`{format_path(above)}` is {NODE_NAMES[type(node)]}, it has no entry [{step}]"
        )
    items = list(node.items) if node else []
    if step > len(items):
        raise _InvalidPath(
            f"`{format_path(above)}` has {len(items)} entries, there is no [{step}]"
            " (they count from 0)"
        )
    return items


def _members(node: Node | None, step: str, above: list[str | int]) -> dict[str, Member]:
    if not isinstance(node, Mapping | None):
        raise _InvalidPath(
            f"`{format_path(above)}` is {NODE_NAMES[type(node)]}, it has no member `{step}`"
        )
    return dict(node.members) if node else {}
