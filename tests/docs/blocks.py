"""The fenced blocks of a Markdown page, and what the page says about them.

In: a Markdown file. Out: its blocks in order. An HTML comment on the line before a block, as in
`<!-- file: app.ddsl -->`, is a directive that readers do not see:

    file: PATH      the block is the content of this file
    method: PATH    the block's functions replace or extend the class in this file
    background      the command keeps running; later blocks use another terminal
    exit: N         the command ends with this exit code
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGES = (ROOT / "README.md", *sorted((ROOT / "docs" / "tutorials").glob("*.md")))
_BLOCK = re.compile(
    r"(?:<!-- (?P<verb>file|method|background|exit)(?:: (?P<argument>[^>]+?))? -->\n)?"
    r"^```(?P<language>[\w{}-]*)\n(?P<text>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)


@dataclass(frozen=True, slots=True)
class Block:
    """One fenced block; `line` is that of its first line of text."""

    page: Path
    line: int
    language: str
    verb: str
    argument: str
    text: str


@dataclass(frozen=True, slots=True)
class Command:
    """One command of a console block and the output that the page shows below it."""

    line: str
    output: tuple[str, ...]

    @property
    def interrupted(self) -> bool:
        """Whether the reader presses Ctrl-C."""
        return self.output[-1:] == ("^C",)


def blocks(page: Path) -> list[Block]:
    """All fenced blocks of `page`."""
    text = page.read_text(encoding="utf-8")
    return [
        Block(
            page,
            text.count("\n", 0, match.start("text")) + 1,
            match["language"],
            match["verb"] or "",
            (match["argument"] or "").strip(),
            match["text"],
        )
        for match in _BLOCK.finditer(text)
    ]


def commands(block: Block) -> list[Command]:
    """The commands of a console block: each line behind `$ `, with the lines below it."""
    parts = re.split(r"^\$ ", block.text, flags=re.MULTILINE)
    return [_command(part) for part in parts if part.strip()]


def _command(part: str) -> Command:
    line, *output = part.rstrip("\n").split("\n")
    return Command(line, tuple(output))
