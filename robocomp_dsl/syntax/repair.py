"""A correction of a broken text, as data: what to read instead, and what to tell the user about it.

In: the situation of a parser that is stuck. Out: values that `recovery` applies and reports.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.diagnostics import Code, Note
from robocomp_dsl.record import Value
from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.findings import Findings
from robocomp_dsl.syntax.lexer import Token
from robocomp_dsl.syntax.situation import Situation
from robocomp_dsl.syntax.tables import END


class Repair(Value):
    """Read `put` in the place of the next `skip` tokens, after dropping all but `keep` states.

    At least `need` of the tokens behind must fit. The rest is the finding: `edits` are the fix.
    An empty message stands for "expected …, found …", which the parser words.
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
    put: tuple[Token, ...] = ()
    skip: int = 0
    keep: int = 0
    need: int = 3

    def tell(self, findings: Findings, expected: str) -> None:
        """Report it."""
        findings.add(
            self.code,
            self.start,
            self.end,
            self.message or expected,
            label=self.label,
            help=self.help,
            notes=self.notes,
            fix=findings.fix(self.title, *self.edits) if self.edits else None,
        )


def hopeless(situation: Situation, item: Sequence[Token]) -> Repair:
    """No correction but the finding alone: the statement that began with `item` is given up."""
    start, end = situation.place()
    if module := situation.nested_module(item):
        said = "a module is not inside of another"
        way_out = "give it a file of its own, and import that; nothing of it is read here"
        return Repair(codes.MISPLACED, module.start, module.end, said, help=way_out)
    if situation.ahead[0].kind != END or not situation.opened:
        # Only in one place of a deployment nothing but a dot can follow.
        ports = situation.tables.language == "ddsl" and situation.accepted() == ["DOT"]
        said = "a connection joins ports: `component.Port -> component.Port`" if ports else ""
        return Repair(codes.UNEXPECTED, start, end, help=said)
    opened = situation.opened[-1]
    return Repair(
        codes.UNCLOSED_BLOCK,
        start,
        end,
        "`};` is missing before the end of the file",
        notes=(Note(situation.source.span(opened.start, opened.end), "it is opened here"),),
    )


def stray_text(first: Token, last: Token, harmless: bool) -> Repair:
    """The finding about everything from `first` to `last`, behind the end."""
    return Repair(
        codes.STRAY_TEXT if harmless else codes.TEXT_BEHIND_END,
        first.start,
        last.end if harmless else first.end,
        "this stands behind the end and is ignored"
        if harmless
        else "this stands behind the end, and nothing of it is read",
        help="" if harmless else "a `}` too many before it may have ended the block too early",
        title="delete it" if harmless else "",
        edits=((first.start, last.end, ""),) if harmless else (),
    )
