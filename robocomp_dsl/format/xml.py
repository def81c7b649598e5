"""Where everything goes in an InnerModel or SCXML file: tags to lines.

In: the pieces of a text. Out: lines, with one tag on each. The attributes of a tag that is too long
stand below each other. Texts and what XML has besides tags are kept to the letter.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.format.lines import Line, reindented
from robocomp_dsl.format.pieces import Piece
from robocomp_dsl.format.style import INDENT, WIDTH

_TAG_ENDS = ("ENDED", "EMPTY")


def lay_out_xml(pieces: Sequence[Piece]) -> list[Line]:
    """The lines of a whole text."""
    made = _Tags(pieces)
    while made.at < len(pieces):
        made.place()
    return made.lines


class _Tags:
    """Places the pieces from number `at` on; `depth` elements are open."""

    def __init__(self, pieces: Sequence[Piece]) -> None:
        self.pieces = pieces
        self.at = 0
        self.depth = 0
        self.lines: list[Line] = []
        self.blank = False  # whether an empty line may come next

    def place(self) -> None:
        """One tag, comment or text."""
        one = self.pieces[self.at]
        if one.kind == "CLOSE":
            self.depth = max(self.depth - 1, 0)
        elif self.blank and one.breaks > 1:
            self.lines.append(Line())
        indent = INDENT * self.depth
        if one.kind == "OPEN":
            self._tag(indent)
            return
        behind = self.at > 0 and self.pieces[self.at - 1].kind in (*_TAG_ENDS, "CLOSE")
        self.at += 1
        if one.comment and behind and not one.breaks:
            self.lines[-1].note = one.text
            return
        if one.comment:
            self.lines.append(Line(indent + reindented(one, indent)))
        elif "\n" in one.text and one.margin is not None:
            self.lines.append(Line(one.margin + one.text))  # its lines may be aligned
        else:
            self.lines.append(Line(indent + one.text))
        self.blank = True

    def _tag(self, indent: str) -> None:
        parts = []
        while self.at < len(self.pieces) and self.pieces[self.at].kind not in _TAG_ENDS:
            parts.append(self.pieces[self.at])
            self.at += 1
        end = self.pieces[self.at].text if self.at < len(self.pieces) else ""
        self.at += 1
        inline = self._inline() if end == ">" else []
        content = "".join(one.text for one in inline)
        flat = f"{indent}{' '.join(one.text for one in parts)}{end}{content}"
        if len(inline) > 1 and len(flat) > WIDTH:
            inline, content = [], ""
            flat = f"{indent}{' '.join(one.text for one in parts)}{end}"
        self.at += len(inline)
        if len(flat) > WIDTH or "\n" in flat:
            aligned = f"\n{indent}{' ' * (len(parts[0].text) + 1)}"
            attributes = aligned.join(one.text for one in parts[1:])
            flat = f"{indent}{parts[0].text} {attributes}{end}{content}"
        self.lines.append(Line(flat))
        self.blank = end != ">" or bool(inline)
        self.depth += not self.blank

    def _inline(self) -> list[Piece]:
        """What follows on the line of a tag: its end, or a single short text and its end."""
        following = self.pieces[self.at : self.at + 2]
        if following and following[0].kind == "CLOSE":
            return list(following[:1])
        kinds = [one.kind for one in following]
        if kinds in (["TEXT", "CLOSE"], ["CDATA", "CLOSE"]):
            lines = following[0].breaks + following[1].breaks + following[0].text.count("\n")
            return [] if lines else list(following)
        return []
