"""What the builders of all languages share: leaves, doc comments, and the words of findings.

In: what the parser recognised. Out: the leaves of the trees.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any, ClassVar, TypeVar

from robocomp_dsl.diagnostics import Code, Fix, Note, did_you_mean, nearest
from robocomp_dsl.source import Span
from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.ast_base import Import, Name, Node, Number, Text, Unit
from robocomp_dsl.syntax.findings import Findings
from robocomp_dsl.syntax.lexer import Token

NodeT = TypeVar("NodeT", bound=Node)
_ESCAPE = re.compile(r"\\(.)")
_ESCAPED = {"n": "\n", "t": "\t", '"': '"', "\\": "\\"}


class Setting(Node):
    """A statement that gives a block one of its values, called `field` in the block's node."""

    field: str
    value: Any


class Builder:
    """Base of the builders; the parser calls their methods, named after the rules of the grammar.

    Each gets the span of its rule and the children that the grammar keeps. `ITEMS` tells what the
    user would call the items of a block; `docs` holds the doc comments by the offset of what they
    precede. `has_block` becomes true with the block that the file is about. `ITEMS_STAND_ALONE`
    says that an item of a block is made of its own text alone, and read again when that changes.
    """

    ITEMS: ClassVar[Mapping[str, str]] = {}
    ITEMS_STAND_ALONE: ClassVar = True

    def __init__(self, findings: Findings) -> None:
        self.findings = findings
        self.docs: dict[int, str] = {}
        self.has_block = False

    def leaf(self, terminal: str) -> Callable[[Token], Node]:
        """What makes a node of a token that the grammar keeps as `terminal`."""
        known = {"STRING": self._text, "NUMBER": self._number, "BRACKETED": self._unit}
        return known.get(terminal, self._name)

    def _name(self, token: Token) -> Name:
        return Name(Span(self.findings.place, token.start, token.end), token.text)

    def _text(self, token: Token) -> Text:
        span = Span(self.findings.place, token.start, token.end)
        return Text(span, _ESCAPE.sub(_unescape, token.text[1:-1]))

    def _number(self, token: Token) -> Number:
        return Number(Span(self.findings.place, token.start, token.end), number(token.text))

    def _unit(self, token: Token) -> Unit:
        span = Span(self.findings.place, token.start, token.end)
        return Unit(span, token.text[1:-1].strip())

    def import_file(self, span: Span, path: Text) -> Import:
        """`import "path";`."""
        return Import(span, path)

    def lone_semicolon(self, span: Span) -> None:
        """A `;` where a statement could stand."""
        self.say(
            codes.EMPTY_STATEMENT,
            span,
            "this `;` ends nothing",
            fix=self.rewrite("delete it", span),
        )

    def doc(self, span: Span) -> str:
        """The doc comment of what begins where `span` does."""
        return self.docs.get(span.start, "")

    def say(
        self,
        code: Code,
        span: Span,
        message: str,
        *,
        label: str = "",
        notes: tuple[Note, ...] = (),
        help: str = "",
        fix: Fix | None = None,
    ) -> None:
        """Add a finding."""
        self.findings.add(
            code, span.start, span.end, message, label=label, notes=notes, help=help, fix=fix
        )

    def rewrite(self, title: str, span: Span, text: str = "") -> Fix:
        """A fix that puts `text` in the place of `span`."""
        return self.findings.fix(title, (span.start, span.end, text))

    def without_comma(self, children: Iterable[Any]) -> list[Any]:
        """The items of a list; a comma behind the last one is reported and left out."""
        kept = [child for child in children if child is not None]
        if kept and isinstance(kept[-1], Name) and kept[-1].text == ",":
            span = kept.pop().span
            self.say(
                codes.TRAILING_COMMA,
                span,
                "nothing follows this comma",
                fix=self.rewrite("delete it", span),
            )
        return kept

    def vocabulary(self, word: Name, known: Iterable[str], what: str) -> bool:
        """Whether `word` is one of the `known`, in any case; reports it where it is not."""
        known = tuple(known)
        if word.text.lower() in {one.lower() for one in known}:
            return True
        meant = nearest(word.text, known)
        self.say(
            codes.UNKNOWN_WORD,
            word.span,
            f"there is no {what} `{word.text}`",
            label=did_you_mean(word.text, known),
            help="" if meant else f"one of {', '.join(known)}",
            fix=self.rewrite(f"write `{meant}`", word.span, meant) if meant else None,
        )
        return False

    def once(self, first: NodeT | None, again: NodeT, what: str) -> NodeT:
        """The first of two nodes of which a block has but one; reports the second."""
        if first is None:
            return again
        self.say(
            codes.REPEATED,
            again.span,
            f"{what} is given twice",
            label="this one is ignored",
            notes=(Note(first.span, "it is first given here"),),
            fix=self.rewrite("delete the second", again.span),
        )
        return first

    def settings(self, items: Iterable[Any]) -> dict[str, Any]:
        """Field to value of the settings among `items`; of one given twice the first."""
        given: dict[str, Setting] = {}
        for one in only(Setting, items):
            given[one.field] = self.once(given.get(one.field), one, f"`{one.field.rstrip('_')}`")
        return {field: one.value for field, one in given.items()}

    def finished(self, what: str) -> bool:
        """Whether the whole file was understood; reports it when there is no `what` in it."""
        source = self.findings.source
        if not self.has_block and not self.findings.errors:
            blank = not source.text.strip()
            message = "the file is empty" if blank else f"there is no {what} in this file"
            self.findings.add(codes.NOTHING_IN_FILE, 0, 0, message)
        return not self.findings.errors


def number(text: str) -> int | float:
    """The value of a number as written."""
    if text[:2] in ("0x", "0X"):
        return int(text, 16)
    try:
        return int(text)
    except ValueError:
        return float(text)


def only(kind: type[NodeT], children: Iterable[Any]) -> tuple[NodeT, ...]:
    """The children of one kind, in order."""
    return tuple([child for child in children if isinstance(child, kind)])


def _unescape(match: re.Match[str]) -> str:
    return _ESCAPED.get(match[1], match[0])
