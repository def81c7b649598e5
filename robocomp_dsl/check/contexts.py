"""The configuration that a component of a deployment searches for: its context, its file.

In: an instance as written. Out: two names that the search takes, and findings about others. What
the names lead to is known only on the machine on which the component starts.
"""

from __future__ import annotations

import re
from pathlib import PurePath

from robocomp_dsl.check import codes
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.syntax import ast_ddsl as ast
from robocomp_dsl.syntax.ast_base import Text

_PART = "[A-Za-z0-9_][A-Za-z0-9_.-]{0,99}"
CONTEXT = re.compile(f"{_PART}(/{_PART}){{0,7}}")
"""What the runtime takes for a context; a test holds the two against each other."""


def is_searchable(file: str) -> bool:
    """Whether a file of this name can be searched for, as the runtime sees it."""
    path = PurePath(file)
    return bool(path.parts) and not path.is_absolute() and ".." not in path.parts


def searched_of(tree: ast.Instance, report: Report) -> tuple[str, str]:
    """The context and the file; empty where nothing was written, or nothing that can be used."""
    context, file = tree.context, tree.from_
    if context and not CONTEXT.fullmatch(context.value):
        right = 'it is a name such as `"lab"`, or `"lab/night"` for one inside another'
        _refuse(context, "context", right, report)
        context = None
    if file and not is_searchable(file.value):
        _refuse(file, "file to search for", "use `config` for a file beside this one", report)
        file = None
    for one, keyword in ((context, "context"), (file, "from")):
        if one and tree.config:
            said = f"`config` names a file, there is nothing left to search for with `{keyword}`"
            notes = [Note(tree.config.span, "the file is named here")]
            report.add(codes.SEARCHED, one.span, said, notes=notes, help="remove one of the two")
    return (context.value if context else "", file.value if file else "")


def _refuse(written: Text, what: str, right: str, report: Report) -> None:
    report.add(codes.SEARCHED, written.span, f'"{written.value:.60}" is no {what}', help=right)
