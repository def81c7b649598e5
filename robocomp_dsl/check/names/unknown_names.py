"""Reports a name that is not declared, with the most similar one that is."""

from __future__ import annotations

from collections.abc import Iterable

from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Code, Fix, Note, Report, UnknownName, nearest
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast.base import Name


def report_unknown_name(
    report: Report,
    code: Code,
    name: Name,
    message: str,
    known: Iterable[str],
    help: str,
    *,
    declared: Iterable[Span] = (),
    notes: Iterable[Note] = (),
    fix: Fix | None = None,
) -> str:
    """Report `name`, and offer to replace it by the most similar of `known`.

    `help` and `fix` are for a name to which none is similar. `declared` are the names of those
    known declarations that may be in the file of `name`: if one of them is misspelled, the error
    moves there (`misspelled_declarations`). Returns the similar name; "" if there is none.
    """
    guess = nearest(name.text, known) or ""
    report.add(
        code,
        name.span,
        message,
        label=f"did you mean `{guess}`?" if guess else "",
        notes=notes,
        help="" if guess else help,
        fix=replace_fix(name.span, guess) if guess else fix,
        unknown=UnknownName(name.text, tuple(declared)),
    )
    return guess
