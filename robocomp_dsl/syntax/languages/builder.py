"""Base class of the tree builders: leaves, doc comments and diagnostics.

In: the rules and tokens that the parser recognised. Out: the leaves of the trees.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any, ClassVar, TypeVar

from robocomp_dsl.diagnostics import Code, Fix, Note, did_you_mean, nearest
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast.base import (
    Bool,
    Duration,
    Import,
    Literal,
    LiteralList,
    Name,
    Node,
    Number,
    QualifiedName,
    Text,
    Unit,
)
from robocomp_dsl.syntax.codes import file as file_codes
from robocomp_dsl.syntax.codes import legacy as legacy_codes
from robocomp_dsl.syntax.codes import syntax as syntax_codes
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.grammar.lexer import Token

NodeT = TypeVar("NodeT", bound=Node)
TIME_UNITS = {"ms": 0.001, "s": 1.0, "min": 60.0, "h": 3600.0}
_ESCAPE = re.compile(r"\\(.)")
_ESCAPED = {"n": "\n", "t": "\t", '"': '"', "\\": "\\"}


class BlockSetting(Node):
    """A statement that sets one value of a block, the attribute `field` of the block's node."""

    field: str
    value: Any


class Builder:
    """Base of the builders; the parser calls their methods, named after the rules of the grammar.

    A method gets the span of its rule and the children that the grammar keeps. `ITEM_NAMES` maps
    the items of a block to names for messages; `docs` maps offsets to the doc comments before them.
    `has_block` becomes true with the top-level block. An item depends on its own text only, so it
    can be reused while that is unchanged.
    """

    ITEM_NAMES: ClassVar[Mapping[str, str]] = {}

    def __init__(self, findings: FileDiagnostics) -> None:
        self.findings = findings
        self.docs: dict[int, str] = {}
        self.has_block = False

    def leaf(self, terminal: str) -> Callable[[Token], Node]:
        """The function that builds the node of a token of the kind `terminal`."""
        known = {"STRING": self._text, "NUMBER": self._number, "BRACKETED": self._unit}
        return known.get(terminal, self._name)

    def _name(self, token: Token) -> Name:
        return Name(Span(self.findings.region, token.start, token.end), token.text)

    def _text(self, token: Token) -> Text:
        span = Span(self.findings.region, token.start, token.end)
        return Text(span, _ESCAPE.sub(_unescape, token.text[1:-1]))

    def _number(self, token: Token) -> Number:
        return Number(Span(self.findings.region, token.start, token.end), parse_number(token.text))

    def _unit(self, token: Token) -> Unit:
        span = Span(self.findings.region, token.start, token.end)
        return Unit(span, token.text[1:-1].strip())

    def inside(self, bracket: Unit) -> Span:
        """The range of the text between brackets; all of it if the parser swapped the token."""
        start = bracket.span.start + bracket.span.text.find(bracket.text)
        if start < bracket.span.start:
            return bracket.span
        return bracket.span.subspan(start, start + len(bracket.text))

    def import_file(self, span: Span, path: Text) -> Import:
        """`import "path";`."""
        return Import(span, path)

    def qualified(self, span: Span, first: Name, second: Name | None) -> QualifiedName:
        """`Name` or `Module::Name`."""
        return QualifiedName(span, second, first) if second else QualifiedName(span, first)

    def lone_semicolon(self, span: Span) -> None:
        """A `;` without a statement."""
        self.report(
            legacy_codes.EMPTY_STATEMENT,
            span,
            "superfluous `;`",
            fix=self.replace_fix("delete it", span),
        )

    def doc(self, span: Span) -> str:
        """The doc comment before the start of `span`."""
        return self.docs.get(span.start, "")

    def report(
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
        """Add a diagnostic."""
        self.findings.add(
            code, span.start, span.end, message, label=label, notes=notes, help=help, fix=fix
        )

    def replace_fix(self, title: str, span: Span, text: str = "") -> Fix:
        """A fix that replaces `span` by `text`."""
        return self.findings.fix(title, (span.start, span.end, text))

    def without_trailing_comma(self, children: Iterable[Any]) -> list[Any]:
        """The items of a list; a comma after the last one is reported and dropped."""
        items = [child for child in children if child is not None]
        if items and isinstance(items[-1], Name) and items[-1].text == ",":
            span = items.pop().span
            self.report(
                legacy_codes.TRAILING_COMMA,
                span,
                "superfluous comma after the last item",
                fix=self.replace_fix("delete it", span),
            )
        return items

    def literal_list(self, span: Span, *values: Any) -> LiteralList:
        """`{1.0, 2.0}`."""
        return LiteralList(span, tuple(map(literal, self.without_trailing_comma(values))))

    def duration(self, span: Span, value: Number, unit: Name) -> Duration:
        """`10 s`."""
        known = self.check_choice(unit, TIME_UNITS, "unit of time")
        return Duration(span, value.value * (TIME_UNITS[unit.text.lower()] if known else 1.0))

    def check_choice(self, word: Name, choices: Iterable[str], noun: str) -> bool:
        """Whether `word` is one of the `choices`, ignoring case; reports it otherwise."""
        choices = tuple(choices)
        if word.text.lower() in {choice.lower() for choice in choices}:
            return True
        match = nearest(word.text, choices)
        self.report(
            syntax_codes.UNKNOWN_CHOICE,
            word.span,
            f"there is no {noun} `{word.text}`",
            label=did_you_mean(word.text, choices),
            help="" if match else f"one of {', '.join(choices)}",
            fix=self.replace_fix(f"write `{match}`", word.span, match) if match else None,
        )
        return False

    def first_of(self, first: NodeT | None, again: NodeT, noun: str) -> NodeT:
        """The first of two nodes that a block may contain once; reports the second."""
        if first is None:
            return again
        self.report(
            syntax_codes.DUPLICATE,
            again.span,
            f"{noun} is written twice",
            label="this one is ignored",
            notes=(Note(first.span, "first written here"),),
            fix=self.replace_fix("delete the second", again.span),
        )
        return first

    def settings(self, items: Iterable[Any]) -> dict[str, Any]:
        """Field to value of the settings among `items`; the first one if a field is repeated."""
        settings: dict[str, BlockSetting] = {}
        for setting in of_kind(BlockSetting, items):
            keyword = setting.field.rstrip("_").replace("_", " ")
            settings[setting.field] = self.first_of(
                settings.get(setting.field), setting, f"`{keyword}`"
            )
        return {field: setting.value for field, setting in settings.items()}

    def is_complete(self, noun: str) -> bool:
        """Whether the file has no syntax errors; reports a missing top-level block (`noun`)."""
        source = self.findings.source
        if not self.has_block and not self.findings.errors:
            blank = not source.text.strip()
            message = "the file is empty" if blank else f"there is no {noun} in this file"
            self.findings.add(file_codes.NO_DECLARATION, 0, 0, message)
        return not self.findings.errors


def parse_number(text: str) -> int | float:
    """The value of a number literal."""
    if text[:2] in ("0x", "0X"):
        return int(text, 16)
    try:
        return int(text)
    except ValueError:
        return float(text)


def literal(value: Name | Text | Number) -> Literal:
    """A value; the words `true` and `false`, in any case, are a `Bool`."""
    if isinstance(value, Name) and value.text.lower() in ("true", "false"):
        return Bool(value.span, value.text.lower() == "true")
    return value


def of_kind(kind: type[NodeT], children: Iterable[Any]) -> tuple[NodeT, ...]:
    """The children of one class, in order."""
    return tuple([child for child in children if isinstance(child, kind)])


def _unescape(match: re.Match[str]) -> str:
    return _ESCAPED.get(match[1], match[0])
