"""Pages as Markdown (GitHub's). In: pages as data. Out: texts.

Every sign that Markdown or HTML knows is written so that it stands for itself.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from robocomp_dsl.generate.doc.html import address
from robocomp_dsl.generate.doc.words import Badge, Code, Page, Target, Text, Words
from robocomp_dsl.generate.templates import render

_SIGNS = re.compile(r"[\\`*_\[\]<>#|~&$@]|:(?=//)")
_BEGINS = re.compile(r"[-+=]|\d+(?=[.)])")
"""What could begin a list or underline a heading where a line begins."""


_ENTITIES = {c: f"&#{ord(c)};" for c in "\\`*_[]<>#|~&$@:!^"}


@dataclass(frozen=True, slots=True)
class Markdown:
    """Writes the parts of one page."""

    page: str

    def address(self, target: Target) -> str:
        """Where a link leads to, seen from this page."""
        return address(self.page, target, ".md")

    def figure(self, name: str) -> str:
        """Where the file of a drawing is."""
        return address(self.page, Target(name), ".svg")

    def words(self, words: Words) -> str:
        """A line of words."""
        return "".join(map(self._word, _merged(words)))

    def line(self, words: Words) -> str:
        """Words at the beginning of a line."""
        return begin(self.words(words))

    def fenced(self, lines: tuple[Words, ...]) -> str:
        """A block of code, in which there are no links."""
        said = "\n".join("".join(one.text for one in words) for words in lines)
        fence = "`" * max(3, 1 + max(map(len, re.findall("`+", said)), default=0))
        return f"{fence}idsl\n{said}\n{fence}"

    def links(self, lines: tuple[Words, ...]) -> str:
        """The names in a block of code that lead somewhere, each once."""
        found = [one for words in lines for one in words if isinstance(one, Code) and one.target]
        return ", ".join(self._word(one) for one in dict.fromkeys(found))

    def _word(self, one: object) -> str:
        match one:
            case Badge(text, _):
                return f"*{plain(text)}*"
            case Code(text, None):
                return code(text)
            case Code(text, Target() as target):
                return f"[{code(text)}]({self.address(target)})"
        return plain(getattr(one, "text", ""))


def _merged(words: Words) -> Words:
    """Code that follows code as one, because their ticks would be taken together."""
    made: list[Text | Code | Badge] = []
    for one in words:
        last = made[-1] if made else None
        if isinstance(one, Code) and isinstance(last, Code) and not (one.target or last.target):
            made[-1] = Code(last.text + one.text)
        else:
            made.append(one)
    return tuple(made)


def plain(text: str) -> str:
    """Words that stand for themselves."""
    return _SIGNS.sub(r"\\\g<0>", text)


def begin(line: str) -> str:
    """A line that begins no list and underlines no heading."""
    found = _BEGINS.match(line)
    if not found:
        return line
    return f"{found[0]}\\{line[found.end() :]}" if found[0].isdigit() else f"\\{line}"


def code(text: str) -> str:
    """Code between ticks, or as an element of HTML where ticks would not hold it."""
    if text == text.strip() and "|" not in text and "`" not in text:
        return f"`{text}`"
    blank = not text.strip()
    inner = "".join("&nbsp;" if blank else _ENTITIES.get(c, c) for c in text)
    return f"<code>{inner}</code>"


def markdown_page(page: Page, title: str) -> str:
    """The whole text of a page; `title` is that of the first one."""
    made = Markdown(page.path)
    return render(
        "doc/page.md.jinja",
        page=page,
        md=made,
        plain=plain,
        title=title,
        index=made.address(Target("index")),
    )
