"""Repairs of syntax errors as data: the replacement tokens and the diagnostic.

In: the context of a syntax error. Out: values that `recovery` applies and reports.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.diagnostics import Code, Note, UncertainText
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.syntax.codes import legacy as legacy_codes
from robocomp_dsl.syntax.codes import syntax as syntax_codes
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.recovery.error_context import ErrorContext, quote_token


class Repair(ValueRecord):
    """Replace the next `skip` tokens by `replacement`, after dropping all but `keep` states.

    At least `required` of the following tokens must be accepted. `is_certain`: what was meant is
    known, so the statement is checked further. `declares`: a declaration remains without a name.
    `loses_names`: what the names in the statement are is not known.
    `since`: where the faulty text begins if it is before the statement.
    The other fields are the diagnostic: `edits` are its fix; an empty message means "expected …,
    found …".
    """

    code: Code
    start: int
    end: int
    message: str = ""
    label: str = ""
    help: str = ""
    notes: tuple[Note, ...] = ()
    title: str = ""
    edits: tuple[tuple[int, int, str], ...] = ()
    replacement: tuple[Token, ...] = ()
    skip: int = 0
    keep: int = 0
    required: int = 3
    is_certain: bool = False
    declares: bool = False
    loses_names: bool = False
    since: int = -1

    def report(self, findings: FileDiagnostics, expected: str, uncertain: UncertainText) -> None:
        """Add the diagnostic; `expected` is the default message."""
        findings.add(
            self.code,
            self.start,
            self.end,
            self.message or expected,
            label=self.label,
            help=self.help,
            notes=self.notes,
            fix=findings.fix(self.title, *self.edits) if self.edits else None,
            uncertain=uncertain,
        )


def missing_sign(kind: str, sign: str, previous: Token, *, required: int) -> Repair:
    """Insert a punctuation character of a terminal after the token `previous`."""
    at = previous.end
    return Repair(
        syntax_codes.MISSING_PUNCTUATION,
        at,
        at,
        f"`{sign}` is missing after {quote_token(previous)}",
        title=f"add `{sign}`",
        edits=((at, at, sign),),
        replacement=(Token(kind, sign, at, at),),
        required=required,
    )


def panic_mode(context: ErrorContext, item: Sequence[Token]) -> Repair:
    """The diagnostic without a repair: the statement that began with `item` is skipped."""
    start, end = context.error_range()
    if module := context.nested_module(item):
        message = "modules cannot be nested"
        help_text = "move it to its own file and import that; this module is skipped"
        return Repair(
            syntax_codes.MISPLACED,
            module.start,
            module.end,
            message,
            help=help_text,
            loses_names=True,
        )
    if context.lookahead[0].kind != END or not context.open_braces:
        # In DDSL, a dot follows only the instance of a port reference.
        ports = context.tables.language == "ddsl" and "DOT" in context.accepted_terminals()
        message = "a connection has the form `component.Port -> component.Port`" if ports else ""
        return Repair(syntax_codes.UNEXPECTED, start, end, help=message, loses_names=True)
    opened = context.open_braces[-1]
    return Repair(
        syntax_codes.UNCLOSED_BLOCK,
        start,
        end,
        "`};` is missing before the end of the file",
        notes=(Note(context.source.span(opened.start, opened.end), "opened here"),),
        loses_names=True,
    )


def trailing_text(first: Token, last: Token, harmless: bool) -> Repair:
    """The diagnostic about the text from `first` to `last` after the end of the block."""
    return Repair(
        legacy_codes.TRAILING_TEXT if harmless else syntax_codes.TEXT_AFTER_END,
        first.start,
        last.end if harmless else first.end,
        "text after the end of the block is ignored"
        if harmless
        else "text after the end of the block is skipped",
        help="" if harmless else "an extra `}` may have ended the block too early",
        title="delete it" if harmless else "",
        edits=((first.start, last.end, ""),) if harmless else (),
        loses_names=True,
    )
