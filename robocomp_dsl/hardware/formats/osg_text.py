"""The text formats of OpenSceneGraph, `.osg` and `.osgt`, as a tree of blocks.

In: text. Out: blocks, each with the words before its brace and, in order, its lines and blocks.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np

from robocomp_dsl.hardware.formats.surface import Points

_WORD = re.compile(r'"(?:[^"\\]|\\.)*"|[{}]|[^\s{}"]+')
_DEEPEST = 200


Line: TypeAlias = list[str]


@dataclass(slots=True)
class OsgBlock:
    """`head { items }`; a line of items is a list of words."""

    head: Line
    items: list[Line | OsgBlock] = field(default_factory=list)

    @property
    def name(self) -> str:
        """The kind of the block, without its library: `osg::Geode` is `Geode`."""
        return self.head[0].rpartition("::")[2] if self.head else ""

    @property
    def blocks(self) -> list[OsgBlock]:
        """The blocks directly in it."""
        return [item for item in self.items if isinstance(item, OsgBlock)]

    def block(self, name: str) -> OsgBlock | None:
        """The first block `name` in it."""
        return next((block for block in self.blocks if block.name == name), None)

    def words(self, name: str) -> Line:
        """The words after the first word `name` of a line; none if there is no such line."""
        lines = (item for item in self.items if isinstance(item, list))
        return next((line[1:] for line in lines if line[0] == name), [])

    def numbers(self) -> Points:
        """All words as numbers, shape (n,). Raises `ValueError`."""
        return np.array(
            [word for item in self.items if isinstance(item, list) for word in item], float
        )


def parse_blocks(text: str) -> OsgBlock:
    """The file as one block without a name. Raises `ValueError` for wrong nesting."""
    root = OsgBlock([])
    nested = [root]
    for written in text.splitlines():
        words: Line = []
        for word in _WORD.findall(written):
            if word == "{":
                block = OsgBlock(words or _last_line(nested[-1]))
                nested[-1].items.append(block)
                nested.append(block)
                words = []
            elif word == "}":
                _end_line(nested.pop(), words)
                words = []
            else:
                words.append(word)
            if not nested:
                raise ValueError("its braces do not match")
            if len(nested) > _DEEPEST:
                raise ValueError("it is nested too deep")
        _end_line(nested[-1], words)
    if len(nested) > 1:
        raise ValueError("its end is missing")
    return root


def _last_line(block: OsgBlock) -> Line:
    """Take the last line of a block: the head of a brace on a line of its own."""
    if block.items and isinstance(block.items[-1], list):
        line = block.items.pop()
        return line if isinstance(line, list) else []
    return []


def _end_line(block: OsgBlock, words: Line) -> None:
    if words:
        block.items.append(words)
