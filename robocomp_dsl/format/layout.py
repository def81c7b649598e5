"""Lays out statements in lines.

In: the statements of a text and the `Style` of its language. Out: lines. A block on one line stays
on one line if it fits, and line breaks after commas are kept; all other line breaks and spaces are
set here.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from robocomp_dsl.format.items import Block, Part, Statement, ends_line, ends_with_line_break
from robocomp_dsl.format.lines import Line, reindent
from robocomp_dsl.format.style import INDENT, WIDTH, Style
from robocomp_dsl.format.tokens import FormatToken


def lay_out(items: Iterable[Statement], style: Style) -> list[Line]:
    """The lines of a whole text."""
    lines: list[Line] = []
    _place(items, 0, style, lines)
    return lines


def _place(items: Iterable[Statement], depth: int, style: Style, lines: list[Line]) -> None:
    for number, item in enumerate(items):
        first = item.parts[0]
        if number and isinstance(first, FormatToken) and first.breaks > 1:
            lines.append(Line())
        _RowLayout(item, depth, style, lines).place()


class _RowLayout:
    """Places one statement. A row is what goes on one line unless that gets too long.

    `row` are its parts: between them, and nowhere else, it may be broken, first of all in front of
    those in `heads`. A statement that is `broken` anyway is broken there as well.
    """

    def __init__(self, item: Statement, depth: int, style: Style, lines: list[Line]) -> None:
        self.parts: Sequence[Part] = item.parts
        self.in_list = item.in_list
        self.depth = depth
        self.style = style
        self.lines = lines
        self.indent = INDENT * depth
        self.further = self.indent if item.in_list else self.indent + INDENT
        self.broken = _broken(item.parts)
        self.row: list[str] = []
        self.heads: set[int] = set()
        self.begun = False  # a row has ended already
        self.left: FormatToken | None = None
        self.tokens = 0

    def place(self) -> None:
        """All of the statement."""
        at = 0
        while at < len(self.parts):
            part = self.parts[at]
            if isinstance(part, Block):
                self._block(part)
            elif part.is_comment:
                at += self._comments(at)
                continue
            else:
                self._token(part)
            at += 1
        self._end_row()

    def _token(self, token: FormatToken) -> None:
        behind_comma = self.left is not None and self.left.text == ","
        if behind_comma and token.breaks:
            self._end_row()
            self._blank(token)
        # A comment at the end of a line would be one about that line.
        commented = self.left is not None and self.left.is_comment
        head = token.text in self.style.breaks and not commented
        if head:
            self.heads.add(len(self.row))
        wraps = not commented and token.text.lower() in self.style.wraps and token.kind != "UNARY"
        self._append(token, may_break=behind_comma or head or wraps)
        self.tokens += 1

    def _append(self, token: FormatToken, *, may_break: bool = False) -> None:
        gap = self.style.separator(self.left, token, self.tokens) if self.left else ""
        if self.row and not (may_break and gap):
            self.row[-1] += gap + token.text
        else:
            self.row.append(token.text)
        self.left = token

    def _comments(self, at: int) -> int:
        """Place the adjacent comments from part `at` on; returns their number."""
        group = _together(self.parts, at)
        previous_end = at + len(group)
        following = self.parts[previous_end] if previous_end < len(self.parts) else None
        if group[0].breaks and at:
            self._end_row()
            self._blank(group[0])
        if not isinstance(following, Block | None) and not ends_line(group[-1], following):
            for token in group:
                self._append(token)
        elif self.row:
            self._end_row(" ".join(token.text for token in group))
        else:
            first = reindent(group[0], self.indent)
            self.row = [" ".join((first, *(token.text for token in group[1:])))]
            self._end_row()
        return len(group)

    def _block(self, block: Block) -> None:
        flat = None if self.begun else flat_block(block, self.style)
        whole = " ".join((*self.row, flat or ""))
        if flat and len(self.indent) + len(whole) < WIDTH:  # and there is room for the `;`
            self.row = [whole]
        else:
            self._end_row()
            self.indent = INDENT * self.depth
            note = " ".join(token.text for token in block.opening)
            self.lines.append(Line(self.indent + "{", note))
            _place(block.items, self.depth + 1, self.style, self.lines)
            self.row = [block.close.text]
        self.left = block.close
        self.tokens += 1

    def _end_row(self, note: str = "") -> None:
        if not self.row:
            return
        self.broken = self.broken or len(self.indent) + len(" ".join(self.row)) > WIDTH
        code = self.indent + self.row[0]
        for number, part in enumerate(self.row[1:], 1):
            new = self.broken and number in self.heads
            if new or len(code) + 1 + len(part) > WIDTH:
                self.lines.append(Line(code))
                code = self.further + part
            else:
                code += " " + part
        self.lines.append(Line(code, note))
        self.row = []
        self.heads.clear()
        self.begun = True
        self.indent = self.further

    def _blank(self, token: FormatToken) -> None:
        """Between the items of a list an empty line stays, too."""
        if self.in_list and token.breaks > 1:
            self.lines.append(Line())


def _broken(parts: Sequence[Part]) -> bool:
    """Whether there is a line break after a comma, by the user or for a comment."""
    behind_comma = False
    for part in parts:
        if isinstance(part, Block):
            behind_comma = False
        elif behind_comma and (part.breaks or (part.is_comment and ends_with_line_break(part))):
            return True
        elif not part.is_comment:
            behind_comma = part.text == ","
    return False


def _together(parts: Sequence[Part], at: int) -> list[FormatToken]:
    """The comment that is part `at`, and those that follow it on its line."""
    group: list[FormatToken] = []
    for part in parts[at:]:
        if isinstance(part, Block) or not part.is_comment or (group and part.breaks):
            break
        group.append(part)
    return group


def flat_block(block: Block, style: Style) -> str | None:
    """The block on one line, or None if its user did not write it so."""
    if not block.items and not block.opening:
        return "{}"
    if not block.flat:
        return None
    return f"{{ {' '.join(_flat_statement(item, style) for item in block.items)} }}"


def _flat_statement(item: Statement, style: Style) -> str:
    result = ""
    left: FormatToken | None = None
    tokens = 0
    for part in item.parts:
        if isinstance(part, Block):
            result += f"{' ' if result else ''}{flat_block(part, style)}"
            left = part.close
        else:
            result += (style.separator(left, part, tokens) if left else "") + part.text
            left = part
        tokens += not (isinstance(part, FormatToken) and part.is_comment)
    return result
