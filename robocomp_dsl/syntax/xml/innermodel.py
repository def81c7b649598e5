"""The XML parser for InnerModel and SCXML files.

In: a source. Out: the tree of its elements. `xml_tokens` splits the text into tags; this module
matches opening and closing tags and reports XML errors with their positions. XML libraries stop at
the first error, and one in ten existing InnerModel files repeats an attribute.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.ast.base import Name, Text
from robocomp_dsl.syntax.ast.innermodel import Attribute, Element, File
from robocomp_dsl.syntax.codes import xml as codes
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.xml.innermodel_attributes import (
    decode_entities,
    read_attributes,
    token_range,
)
from robocomp_dsl.syntax.xml.xml_tokens import TAG_ENDS, group_tags

_DASHES = re.compile(r"--+")
_CLOSED = re.compile(r"</\s*([^\s<>]*)\s*([^<>]*)(>?)")


def parse(source: Source, report: Report) -> File:
    """The tree of an InnerModel file; syntax errors are added to `report`."""
    return _parse(_Builder(source, FileDiagnostics(source, report)))


def parse_scxml(source: Source, report: Report) -> File:
    """The tree of an SCXML file, including text content, which `<script>` and `<data>` need."""
    return _parse(_Builder(source, FileDiagnostics(source, report), "scxml", keeps_text=True))


def parse_xml(source: Source, report: Report) -> File:
    """The tree of any XML file, including text content."""
    return _parse(_Builder(source, FileDiagnostics(source, report), "…", keeps_text=True))


def _parse(builder: _Builder) -> File:
    for item in group_tags(builder.source.text):
        if builder.findings.too_many_errors:
            break
        if item[0].kind == "OPEN":
            builder.tag(item)
        else:
            builder.outside(item[0])
    return builder.file()


@dataclass(slots=True)
class _OpenElement:
    """An element whose closing tag has not come yet."""

    start: int
    tag: Name
    attributes: tuple[Attribute, ...]
    end_reported: bool = False  # a missing `>` was reported
    children: list[Element] = field(default_factory=list)
    texts: list[Text] = field(default_factory=list)


@dataclass(slots=True)
class _Builder:
    source: Source
    findings: FileDiagnostics
    root_tag: str = "innerModel"
    keeps_text: bool = False
    roots: list[Element] = field(default_factory=list)
    path: list[_OpenElement] = field(default_factory=list)

    def file(self) -> File:
        """The file node at the end of the text."""
        size = len(self.source.text)
        for element in reversed(self.path):
            self._unclosed(element, "the end of the file")
            self._pop(size)
        if not self.roots:
            span = self.source.file_span
            self.findings.add(
                codes.XML_ROOT,
                span.start,
                span.end,
                f"the file has no `<{self.root_tag}>` element",
            )
        for extra in self.roots[1:]:
            self.findings.add(
                codes.XML_ROOT,
                extra.tag.span.start,
                extra.tag.span.end,
                f"`<{extra.tag.text}>` follows the end of the document",
                label="a file has one root element",
                notes=(Note(self.roots[0].tag.span, "root element"),),
            )
        root = self.roots[0] if self.roots else None
        return File(self.source.span(0, size), root, complete=not self.findings.errors)

    # -- tags ---------------------------------------------------------------------------------

    def tag(self, parts: list[Token]) -> None:
        """`<name attribute … >` or `… />`, from its tokens."""
        (start, name_end), (_, end) = token_range(parts[0]), token_range(parts[-1])
        ended = parts[-1].kind in TAG_ENDS
        tag = Name(self.source.span(start + 1, name_end), parts[0].text[1:])
        written = parts[1:-1] if ended else parts[1:]
        attributes = read_attributes(written, self.source, self.findings)
        self.path.append(_OpenElement(start, tag, attributes, end_reported=not ended))
        if not ended:
            message = f"the tag `<{tag.text}` has no `>`"
            self.findings.add(
                codes.XML_TAG,
                start,
                end,
                message,
                fix=self.findings.fix("close the tag", (end, end, "/>")),
            )
        if parts[-1].kind == "ENDED_EMPTY":
            self._pop(end)

    def _pop(self, end: int) -> None:
        opened = self.path.pop()
        span = self.source.span(opened.start, end)
        children, texts = tuple(opened.children), tuple(opened.texts)
        element = Element(span, opened.tag, opened.attributes, children, texts)
        (self.path[-1].children if self.path else self.roots).append(element)

    def _close(self, token: Token) -> None:
        match = _CLOSED.match(token.text)
        name, rest, ended = match.groups() if match else ("", "", "")
        start, end = token_range(token)
        if rest or not ended:
            self.findings.add(
                codes.XML_TAG, start, end, f"the closing tag `</{name}` must end with `>` here"
            )
        depth = self._depth(name)
        if depth is None and self.path and nearest(name, [self.path[-1].tag.text]):
            depth = len(self.path) - 1
        if depth is None:
            message = f"`</{name}>` closes nothing"
            self.findings.add(codes.XML_NESTING, start, end, message, label="no such tag is open")
            return
        for inner in reversed(self.path[depth + 1 :]):
            self._unclosed(inner, f"`</{name}>`", Note(self.source.span(start, end), "closed here"))
            self._pop(start)
        written = self.path[-1].tag
        if written.text != name:
            offset = self.source.text.index(name, start)
            self.findings.add(
                codes.XML_NESTING,
                offset,
                offset + len(name),
                f"`</{name}>` must match the tag that it closes, `{written.text}`",
                fix=self.findings.fix(
                    f"write `{written.text}`", (offset, offset + len(name), written.text)
                ),
            )
        self._pop(end)

    def _depth(self, name: str) -> int | None:
        """Index of the innermost open element `name`; ignores case without an exact match."""
        for normalize in (str, str.lower):
            for i in range(len(self.path) - 1, -1, -1):
                if normalize(self.path[i].tag.text) == normalize(name):
                    return i
        return None

    def _unclosed(self, element: _OpenElement, before: str, *notes: Note) -> None:
        if element.end_reported or self.findings.too_many_errors:
            return
        span = element.tag.span
        message = f"`<{element.tag.text}>` is not closed before {before}"
        self.findings.add(
            codes.XML_NESTING,
            span.start,
            span.end,
            message,
            notes=notes,
            help=f"write `</{element.tag.text}>` where it ends, or `/>` instead of `>`",
        )

    # -- between tags -------------------------------------------------------------------------

    def outside(self, token: Token) -> None:
        """A closing tag, a comment or text."""
        start, end = token_range(token)
        match token.kind:
            case "CLOSE":
                self._close(token)
            case "LONE":
                message = "`<` does not begin a tag here; write `&lt;` in text"
                self.findings.add(codes.XML_TAG, start, end, message)
            case "OPEN_COMMENT":
                message = "the comment is not closed"
                self.findings.add(
                    codes.XML_TAG, start, start + 4, message, help="close it with `-->`"
                )
            case "ODD_COMMENT":
                self._comment(token)
            case "DOCTYPE":
                message = "the document type is ignored; only the entities of XML are supported"
                self.findings.add(codes.XML_DOCTYPE, start, end, message)
            case _:
                self._text(token, start)

    def _comment(self, token: Token) -> None:
        """A comment that contains `--`: a nested comment, or a line of dashes."""
        inner = token.text.find("<!--", 4)
        if inner >= 0:
            start = token.start + inner
            self.findings.add(
                codes.XML_COMMENT,
                start,
                start + 4,
                "comments cannot be nested",
                label="ignored inside the comment",
                notes=(
                    Note(self.source.span(token.start, token.start + 4), "the comment begins here"),
                    Note(self.source.span(token.end - 3, token.end), "and ends here"),
                ),
            )
            return
        # A dash before the end forms `--` with the first dash of `-->`.
        matches = _DASHES.finditer(self.source.text, token.start + 4, token.end - 2)
        dashes = [(run.start(), min(run.end(), token.end - 3)) for run in matches]
        self.findings.add(
            codes.XML_COMMENT,
            *dashes[0],
            "`--` is not allowed in a comment",
            fix=self.findings.fix(
                "write `=` for each `-`",
                *((start, end, "=" * (end - start)) for start, end in dashes),
            ),
        )

    def _text(self, token: Token, start: int) -> None:
        words = token.text.rstrip()
        end = start + len(words)
        if self.path and self.keeps_text:
            self.path[-1].texts.append(self._content_text(token, words, start))
        elif self.path:
            message = "text between tags is ignored"
            self.findings.add(
                codes.XML_TEXT, start, end, message, help="make it a comment: `<!-- … -->`"
            )
        else:
            message = "text outside the root element is not allowed"
            self.findings.add(codes.XML_ROOT, start, end, message)

    def _content_text(self, token: Token, words: str, start: int) -> Text:
        """Text content with entities replaced, or the content of a CDATA section."""
        span = self.source.span(start, start + len(words))
        if token.kind == "CDATA":
            return Text(span, words[len("<![CDATA[") : -len("]]>")])
        return Text(span, decode_entities(words, start, self.findings))
