"""The lines of a ROS definition with their comments.

In: a source. Out: sections of statements; the documentation of each statement is the comment above
it and behind it, that of a section the comment at its start.
"""

from __future__ import annotations

from robocomp_dsl.record import Record
from robocomp_dsl.source import Source, Span

SEPARATOR = "---"


class DefinitionLine(Record):
    """A field or constant without its comments; `span` covers it."""

    span: Span
    doc: str


class Section(Record):
    """What is between two separators; `span` is its separator, or the start of the file."""

    span: Span
    statements: tuple[DefinitionLine, ...]
    doc: str


def read_sections(source: Source) -> list[Section]:
    """The sections of a definition: one in a message, two in a service, three in an action."""
    reader = _Reader(source.file_span)
    sections = []
    for number in range(1, len(source.line_starts) + 1):
        text = source.line(number)
        end = _comment_start(text)
        code, comment = text[:end], text[end:]
        start = source.line_starts[number - 1]
        if code.strip() == SEPARATOR:
            sections.append(reader.section())
            reader = _Reader(source.span(start, start + len(SEPARATOR)))
        elif code.strip():
            lead = len(code) - len(code.lstrip())
            reader.statement(source.span(start + lead, start + len(code.rstrip())), comment)
        elif comment:
            reader.comment(_plain(comment), is_indented=bool(code))
        else:
            reader.blank()
    return [*sections, reader.section()]


def _comment_start(text: str) -> int:
    """The index of the `#` that is not inside quotes, or the length."""
    quote = ""
    for index, character in enumerate(text):
        if character == "#" and not quote:
            return index
        if character == quote and text[index - 1] != "\\":
            quote = ""
        elif character in "\"'" and not quote:
            quote = character
    first = text.find("#")  # a quote without its partner is an apostrophe
    return first if quote and first >= 0 else len(text)


def _plain(comment: str) -> str:
    return comment.lstrip("#").removeprefix(" ").rstrip()


class _Reader:
    """Collects the statements of one section."""

    def __init__(self, span: Span) -> None:
        self._span = span
        self._spans: list[Span] = []
        self._docs: list[list[str]] = []
        self._above: list[str] = []
        self._head: list[str] = []
        self._continues = False

    def statement(self, span: Span, comment: str) -> None:
        """A field or constant with the comment behind it."""
        behind = [_plain(comment)] if comment else []
        self._spans.append(span)
        self._docs.append([*self._above, *behind])
        self._above = []
        self._continues = bool(behind)

    def comment(self, text: str, *, is_indented: bool) -> None:
        """A line with a comment only: the rest of the comment behind, or one above."""
        if is_indented and self._continues:
            self._docs[-1].append(text)
        else:
            self._above.append(text)
            self._continues = False

    def blank(self) -> None:
        """An empty line ends a comment; before the first statement it belongs to the section."""
        if not self._spans:
            self._head += [*self._above, ""]
        self._above = []
        self._continues = False

    def section(self) -> Section:
        """What was read."""
        if not self._spans:
            self._head += self._above
        statements = zip(self._spans, self._docs, strict=True)
        return Section(
            self._span,
            tuple(DefinitionLine(span, _joined(doc)) for span, doc in statements),
            _joined(self._head),
        )


def _joined(lines: list[str]) -> str:
    return "\n".join(lines).strip()
