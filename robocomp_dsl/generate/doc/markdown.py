"""Write pages as GitHub Markdown. In: pages as data. Out: texts.

All special characters of Markdown and HTML are escaped.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from robocomp_dsl.generate.doc.html import relative_url
from robocomp_dsl.generate.doc.nodes import Badge, DocumentationPage, InlineCode, Inlines, PlainText
from robocomp_dsl.generate.doc.target import Target
from robocomp_dsl.generate.templates import render

_SPECIAL_CHARACTERS = re.compile(r"[\\`*_\[\]<>#|~&$@]|:(?=//)")
_BLOCK_START = re.compile(r"[-+=]|\d+(?=[.)])")
"""Text that begins a list or underlines a heading at the start of a line."""


_ENTITIES = {c: f"&#{ord(c)};" for c in "\\`*_[]<>#|~&$@:!^"}


@dataclass(frozen=True, slots=True)
class MarkdownWriter:
    """Writes the parts of one page."""

    page: str

    def url(self, target: Target) -> str:
        """The URL of a target, relative to this page."""
        return relative_url(self.page, target, ".md")

    def figure(self, name: str) -> str:
        """The URL of a drawing's file."""
        return relative_url(self.page, Target(name), ".svg")

    def inlines(self, words: Inlines) -> str:
        """Inline content as Markdown."""
        return "".join(map(self._inline, _merge_adjacent_code(words)))

    def line(self, words: Inlines) -> str:
        """Inline content at the start of a line."""
        return escape_line_start(self.inlines(words))

    def fenced(self, lines: tuple[Inlines, ...]) -> str:
        """A block of code without links."""
        message = "\n".join("".join(word.text for word in words) for words in lines)
        fence = "`" * max(3, 1 + max(map(len, re.findall("`+", message)), default=0))
        return f"{fence}idsl\n{message}\n{fence}"

    def links(self, lines: tuple[Inlines, ...]) -> str:
        """The links of a block of code, each once."""
        linked = [
            word
            for words in lines
            for word in words
            if isinstance(word, InlineCode) and word.target
        ]
        return ", ".join(self._inline(entry) for entry in dict.fromkeys(linked))

    def _inline(self, node: object) -> str:
        match node:
            case Badge(text, _):
                return f"*{escape_text(text)}*"
            case InlineCode(text, None):
                return code_span(text)
            case InlineCode(text, Target() as target):
                return f"[{code_span(text)}]({self.url(target)})"
        return escape_text(getattr(node, "text", ""))


def _merge_adjacent_code(words: Inlines) -> Inlines:
    """Merge adjacent code spans, whose backticks would be read as one."""
    merged: list[PlainText | InlineCode | Badge] = []
    for word in words:
        last = merged[-1] if merged else None
        if (
            isinstance(word, InlineCode)
            and isinstance(last, InlineCode)
            and not (word.target or last.target)
        ):
            merged[-1] = InlineCode(last.text + word.text)
        else:
            merged.append(word)
    return tuple(merged)


def escape_text(text: str) -> str:
    """Text with all special characters escaped."""
    return _SPECIAL_CHARACTERS.sub(r"\\\g<0>", text)


def escape_line_start(line: str) -> str:
    """A line escaped so that it starts no list and underlines no heading."""
    match = _BLOCK_START.match(line)
    if not match:
        return line
    return f"{match[0]}\\{line[match.end() :]}" if match[0].isdigit() else f"\\{line}"


def code_span(text: str) -> str:
    """Code in backticks, or as an HTML element if backticks do not work."""
    if text == text.strip() and "|" not in text and "`" not in text:
        return f"`{text}`"
    blank = not text.strip()
    inner = "".join("&nbsp;" if blank else _ENTITIES.get(c, c) for c in text)
    return f"<code>{inner}</code>"


def render_markdown_page(page: DocumentationPage, title: str) -> str:
    """The text of a page; `title` is the title of the first page."""
    writer = MarkdownWriter(page.path)
    return render(
        "doc/page.md.jinja",
        page=page,
        md=writer,
        escape_text=escape_text,
        title=title,
        index=writer.url(Target("index")),
    )
