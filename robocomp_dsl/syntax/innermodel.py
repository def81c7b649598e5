"""InnerModel and SCXML, from text to tree.

In: a source. Out: its elements, nested. `xml_tokens` cuts the text into tags and pieces of tags;
this module matches the tags, and reports everything that XML forbids where it stands. It takes no
help from an XML library: those stop at the first mistake, and every tenth of the files that people
have repeats an attribute.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.source import Source
from robocomp_dsl.syntax import codes_xml as codes
from robocomp_dsl.syntax.ast_base import Name, Text
from robocomp_dsl.syntax.ast_innermodel import Attribute, Element, File
from robocomp_dsl.syntax.findings import Findings
from robocomp_dsl.syntax.innermodel_attributes import decoded, ends, read_attributes
from robocomp_dsl.syntax.lexer import Token
from robocomp_dsl.syntax.xml_tokens import ENDS, items

_DASHES = re.compile(r"--+")
_CLOSED = re.compile(r"</\s*([^\s<>]*)\s*([^<>]*)(>?)")


def parse(source: Source, report: Report) -> File:
    """The tree of an InnerModel file; what is wrong with its form goes into `report`."""
    return _parse(_Builder(source, Findings(source, report)))


def parse_machine(source: Source, report: Report) -> File:
    """The tree of an SCXML file, with its texts: in `<script>` and `<data>` they mean something."""
    return _parse(_Builder(source, Findings(source, report), "scxml", keeps_text=True))


def _parse(builder: _Builder) -> File:
    for item in items(builder.source.text):
        if builder.findings.full:
            break
        if item[0].kind == "OPEN":
            builder.tag(item)
        else:
            builder.outside(item[0])
    return builder.file()


@dataclass(slots=True)
class _Open:
    """An element whose closing tag has not come yet."""

    start: int
    tag: Name
    attributes: tuple[Attribute, ...]
    told: bool = False  # that its end is missing
    children: list[Element] = field(default_factory=list)
    texts: list[Text] = field(default_factory=list)


@dataclass(slots=True)
class _Builder:
    source: Source
    findings: Findings
    outermost: str = "innerModel"
    keeps_text: bool = False
    roots: list[Element] = field(default_factory=list)
    path: list[_Open] = field(default_factory=list)

    def file(self) -> File:
        """What has been built, when there is nothing more to come."""
        size = len(self.source.text)
        for one in reversed(self.path):
            self._unclosed(one, "the end of the file")
            self._pop(size)
        if not self.roots:
            span = self.source.whole
            self.findings.add(
                codes.XML_ROOT,
                span.start,
                span.end,
                f"the file has no `<{self.outermost}>` element",
            )
        for extra in self.roots[1:]:
            self.findings.add(
                codes.XML_ROOT,
                extra.tag.span.start,
                extra.tag.span.end,
                f"`<{extra.tag.text}>` stands behind the end of the document",
                label="a file has one outermost element",
                notes=(Note(self.roots[0].tag.span, "this one"),),
            )
        root = self.roots[0] if self.roots else None
        return File(self.source.span(0, size), root, complete=not self.findings.errors)

    # -- tags ---------------------------------------------------------------------------------

    def tag(self, parts: list[Token]) -> None:
        """`<name attribute … >` or `… />`, from its tokens."""
        (start, name_end), (_, end) = ends(parts[0]), ends(parts[-1])
        ended = parts[-1].kind in ENDS
        tag = Name(self.source.span(start + 1, name_end), parts[0].text[1:])
        written = parts[1:-1] if ended else parts[1:]
        attributes = read_attributes(written, self.source, self.findings)
        self.path.append(_Open(start, tag, attributes, told=not ended))
        if not ended:
            said = f"the tag `<{tag.text}` has no `>`"
            self.findings.add(
                codes.XML_TAG,
                start,
                end,
                said,
                fix=self.findings.fix("close the tag", (end, end, "/>")),
            )
        if parts[-1].kind == "ENDED_EMPTY":
            self._pop(end)

    def _pop(self, end: int) -> None:
        one = self.path.pop()
        span = self.source.span(one.start, end)
        children, texts = tuple(one.children), tuple(one.texts)
        made = Element(span, one.tag, one.attributes, children, texts)
        (self.path[-1].children if self.path else self.roots).append(made)

    def _close(self, token: Token) -> None:
        found = _CLOSED.match(token.text)
        name, rest, ended = found.groups() if found else ("", "", "")
        start, end = ends(token)
        if rest or not ended:
            self.findings.add(
                codes.XML_TAG, start, end, f"the closing tag `</{name}` must end here with `>`"
            )
        depth = self._depth(name)
        if depth is None and self.path and nearest(name, [self.path[-1].tag.text]):
            depth = len(self.path) - 1
        if depth is None:
            said = f"`</{name}>` closes nothing"
            self.findings.add(codes.XML_NESTING, start, end, said, label="no such tag is open here")
            return
        for one in reversed(self.path[depth + 1 :]):
            self._unclosed(one, f"`</{name}>`", Note(self.source.span(start, end), "closed here"))
            self._pop(start)
        written = self.path[-1].tag
        if written.text != name:
            at = self.source.text.index(name, start)
            self.findings.add(
                codes.XML_NESTING,
                at,
                at + len(name),
                f"`</{name}>` must be written as the tag that it closes, `{written.text}`",
                fix=self.findings.fix(
                    f"write `{written.text}`", (at, at + len(name), written.text)
                ),
            )
        self._pop(end)

    def _depth(self, name: str) -> int | None:
        """Where on the path the innermost element called `name` is, in any case if need be."""
        for wanted in (str, str.lower):
            for i in range(len(self.path) - 1, -1, -1):
                if wanted(self.path[i].tag.text) == wanted(name):
                    return i
        return None

    def _unclosed(self, one: _Open, before: str, *notes: Note) -> None:
        if one.told or self.findings.full:
            return
        span = one.tag.span
        said = f"`<{one.tag.text}>` is not closed before {before}"
        self.findings.add(
            codes.XML_NESTING,
            span.start,
            span.end,
            said,
            notes=notes,
            help=f"write `</{one.tag.text}>` where it ends, or `/>` instead of `>`",
        )

    # -- between tags -------------------------------------------------------------------------

    def outside(self, token: Token) -> None:
        """A closing tag, or something that is no tag at all."""
        start, end = ends(token)
        match token.kind:
            case "CLOSE":
                self._close(token)
            case "LONE":
                said = "`<` begins no tag here; inside a text it is written `&lt;`"
                self.findings.add(codes.XML_TAG, start, end, said)
            case "OPEN_COMMENT":
                said = "the comment is not closed"
                self.findings.add(codes.XML_TAG, start, start + 4, said, help="close it with `-->`")
            case "ODD_COMMENT":
                self._comment(token)
            case "DOCTYPE":
                said = "a document type is not read: there are no entities but those of XML"
                self.findings.add(codes.XML_DOCTYPE, start, end, said)
            case _:
                self._text(token, start)

    def _comment(self, token: Token) -> None:
        """A comment with `--` in it: the beginning of another one, or a line of dashes."""
        inner = token.text.find("<!--", 4)
        if inner >= 0:
            start = token.start + inner
            self.findings.add(
                codes.XML_COMMENT,
                start,
                start + 4,
                "a comment cannot hold another one",
                label="only part of a comment",
                notes=(
                    Note(self.source.span(token.start, token.start + 4), "it begins here"),
                    Note(self.source.span(token.end - 3, token.end), "and has ended here"),
                ),
            )
            return
        # One dash in front of the end makes two with the first of `-->`.
        found = _DASHES.finditer(self.source.text, token.start + 4, token.end - 2)
        dashes = [(one.start(), min(one.end(), token.end - 3)) for one in found]
        self.findings.add(
            codes.XML_COMMENT,
            *dashes[0],
            "`--` may not stand in a comment",
            fix=self.findings.fix(
                "write `=` for each `-`",
                *((start, end, "=" * (end - start)) for start, end in dashes),
            ),
        )

    def _text(self, token: Token, start: int) -> None:
        words = token.text.rstrip()
        end = start + len(words)
        if self.path and self.keeps_text:
            self.path[-1].texts.append(self._kept(token, words, start))
        elif self.path:
            said = "text between the tags means nothing"
            self.findings.add(
                codes.XML_TEXT, start, end, said, help="make it a comment: `<!-- … -->`"
            )
        else:
            said = "this stands outside of the document and is no tag"
            self.findings.add(codes.XML_ROOT, start, end, said)

    def _kept(self, token: Token, words: str, start: int) -> Text:
        """A text, or what stands in a CDATA section, as it is meant."""
        span = self.source.span(start, start + len(words))
        if token.kind == "CDATA":
            return Text(span, words[len("<![CDATA[") : -len("]]>")])
        return Text(span, decoded(words, start, self.findings))
