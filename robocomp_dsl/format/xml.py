"""Lays out the tags of an InnerModel or SCXML file in lines.

In: the tokens of a text. Out: lines with one tag each. If a tag is too long, each attribute gets a
line. Text and all XML besides tags stay unchanged.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.format.lines import Line, reindent
from robocomp_dsl.format.style import INDENT, WIDTH
from robocomp_dsl.format.tokens import FormatToken

_TAG_ENDS = ("ENDED", "EMPTY")


def lay_out_xml(tokens: Sequence[FormatToken]) -> list[Line]:
    """The lines of a whole text."""
    result = _Tags(tokens)
    while result.at < len(tokens):
        result.place()
    return result.lines


class _Tags:
    """Lays out the tokens from number `at`; `depth` elements are open."""

    def __init__(self, tokens: Sequence[FormatToken]) -> None:
        self.tokens = tokens
        self.at = 0
        self.depth = 0
        self.lines: list[Line] = []
        self.blank = False  # whether an empty line may come next

    def place(self) -> None:
        """Lay out one tag, comment or text."""
        token = self.tokens[self.at]
        if token.kind == "CLOSE":
            self.depth = max(self.depth - 1, 0)
        elif self.blank and token.breaks > 1:
            self.lines.append(Line())
        indent = INDENT * self.depth
        if token.kind == "OPEN":
            self._tag(indent)
            return
        previous_end = self.at > 0 and self.tokens[self.at - 1].kind in (*_TAG_ENDS, "CLOSE")
        self.at += 1
        if token.is_comment and previous_end and not token.breaks:
            self.lines[-1].note = token.text
            return
        if token.is_comment:
            self.lines.append(Line(indent + reindent(token, indent)))
        elif "\n" in token.text and token.margin is not None:
            self.lines.append(Line(token.margin + token.text))  # its lines may be aligned
        else:
            self.lines.append(Line(indent + token.text))
        self.blank = True

    def _tag(self, indent: str) -> None:
        parts = []
        while self.at < len(self.tokens) and self.tokens[self.at].kind not in _TAG_ENDS:
            parts.append(self.tokens[self.at])
            self.at += 1
        end = self.tokens[self.at].text if self.at < len(self.tokens) else ""
        self.at += 1
        inline = self._inline() if end == ">" else []
        content = "".join(token.text for token in inline)
        flat = f"{indent}{' '.join(part.text for part in parts)}{end}{content}"
        if len(inline) > 1 and len(flat) > WIDTH:
            inline, content = [], ""
            flat = f"{indent}{' '.join(part.text for part in parts)}{end}"
        self.at += len(inline)
        if len(flat) > WIDTH or "\n" in flat:
            aligned = f"\n{indent}{' ' * (len(parts[0].text) + 1)}"
            attributes = aligned.join(part.text for part in parts[1:])
            flat = f"{indent}{parts[0].text} {attributes}{end}{content}"
        self.lines.append(Line(flat))
        self.blank = end != ">" or bool(inline)
        self.depth += not self.blank

    def _inline(self) -> list[FormatToken]:
        """The tokens on the same line after a tag: its closing tag, or a short text and that."""
        following = self.tokens[self.at : self.at + 2]
        if following and following[0].kind == "CLOSE":
            return list(following[:1])
        kinds = [token.kind for token in following]
        if kinds in (["TEXT", "CLOSE"], ["CDATA", "CLOSE"]):
            lines = following[0].breaks + following[1].breaks + following[0].text.count("\n")
            return [] if lines else list(following)
        return []
