"""Reports a name that is not declared, with the most similar one that is."""

from __future__ import annotations

from collections.abc import Iterable

from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Code, Report, nearest
from robocomp_dsl.syntax.ast.base import Name


def report_unknown_name(
    report: Report, code: Code, name: Name, message: str, known: Iterable[str], help: str
) -> str:
    """Report `name`, and offer to replace it by the most similar of `known`.

    `help` is for a name to which none is similar. Returns the similar name; "" if there is none.
    """
    guess = nearest(name.text, known) or ""
    report.add(
        code,
        name.span,
        message,
        label=f"did you mean `{guess}`?" if guess else "",
        help="" if guess else help,
        fix=replace_fix(name.span, guess) if guess else None,
    )
    return guess
