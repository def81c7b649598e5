"""Checks the configuration search of an instance: its context and its file name.

In: an instance. Out: the two names for the search, and diagnostics. Which files they resolve to is
known only on the machine on which the component starts.
"""

from __future__ import annotations

import re
from pathlib import PurePath

from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Text

_PART = "[A-Za-z0-9_][A-Za-z0-9_.-]{0,99}"
CONTEXT = re.compile(f"{_PART}(/{_PART}){{0,7}}")
"""The pattern of the runtime for contexts; a test compares the two."""


def is_searchable(file: str) -> bool:
    """Whether the runtime accepts this file name for a search."""
    path = PurePath(file)
    return bool(path.parts) and not path.is_absolute() and ".." not in path.parts


def config_search_of(tree: ast.Instance, report: Report) -> tuple[str, str]:
    """The context and the file name; empty if not written or invalid."""
    context, file = tree.context, tree.from_
    if context and not CONTEXT.fullmatch(context.value):
        right = 'a context is a name such as `"lab"`, or `"lab/night"` for a nested one'
        _reject(context, "context", right, report)
        context = None
    if file and not is_searchable(file.value):
        _reject(file, "file to search for", "use `config` for a file relative to this one", report)
        file = None
    for value, keyword in ((context, "context"), (file, "from")):
        if value and tree.config:
            message = f"`config` names the file, so `{keyword}` cannot search for it"
            notes = [Note(tree.config.span, "the file is named here")]
            report.add(
                codes.CONFIG_SEARCH, value.span, message, notes=notes, help="remove one of the two"
            )
    return (context.value if context else "", file.value if file else "")


def _reject(written: Text, noun: str, right: str, report: Report) -> None:
    report.add(
        codes.CONFIG_SEARCH, written.span, f'"{written.value:.60}" is not a {noun}', help=right
    )
