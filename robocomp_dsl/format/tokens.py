"""Tokens and comments of a text, in order.

In: a text. Out: `FormatToken` values. Formatting changes only the whitespace between them:
`same_content` verifies that, `changes` computes the difference.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

Change = tuple[int, int, str]
"""Replace the characters [start, end) by the text."""

COMMENTS = frozenset(("LINE", "BLOCK"))


@dataclass(slots=True)
class FormatToken:
    """A token or comment at [start, end) of its text; line ends in it are line feeds.

    `kind` is `LINE` for a comment up to the end of its line, `BLOCK` for any other comment, else
    the name of the terminal. `breaks` is the number of line ends before it; `margin` is the
    whitespace before it if it is the first on its line, else None.
    """

    kind: str
    text: str
    start: int
    end: int
    breaks: int
    margin: str | None = None

    @property
    def is_comment(self) -> bool:
        """Whether the token is a comment."""
        return self.kind in COMMENTS

    @property
    def symbol(self) -> str:
        """The identifier in style rules: the text of punctuation, else the kind."""
        return self.text if self.kind == "SIGN" else self.kind

    @property
    def significant_content(self) -> tuple[str, str]:
        """The content that formatting keeps: all but the indentation of comment lines."""
        if self.is_comment and "\n" in self.text:
            return self.kind, "\n".join(line.strip() for line in self.text.split("\n"))
        return self.kind, self.text


def make(kind: str, text: str, start: int, end: int, previous_end: int) -> FormatToken:
    """The token at [start, end) of `text`; the previous token ends at `previous_end`."""
    gap = text[previous_end:start]
    breaks = gap.count("\n")
    margin = gap[gap.rfind("\n") + 1 :] if breaks or not previous_end else None
    written = text[start:end]
    if "\r" in written:
        written = written.replace("\r\n", "\n")
    if kind in COMMENTS:
        written = "\n".join(line.rstrip() for line in written.split("\n"))
    return FormatToken(kind, written, start, end, breaks, margin)


def same_content(old: Sequence[FormatToken], new: Sequence[FormatToken]) -> bool:
    """Whether two token lists have the same content."""
    return [token.significant_content for token in old] == [
        token.significant_content for token in new
    ]


def changes(
    old: str, new: str, old_tokens: Sequence[FormatToken], new_tokens: Sequence[FormatToken]
) -> Iterator[Change]:
    """The minimal changes from `old` to `new`, in order; their tokens must have `same_content`."""
    at_old = at_new = 0
    for piece, other in zip(old_tokens, new_tokens, strict=True):
        yield from _change(old, new, (at_old, piece.start), (at_new, other.start))
        yield from _change(old, new, (piece.start, piece.end), (other.start, other.end))
        at_old, at_new = piece.end, other.end
    yield from _change(old, new, (at_old, len(old)), (at_new, len(new)))


def _change(old: str, new: str, there: tuple[int, int], here: tuple[int, int]) -> Iterator[Change]:
    before, after = old[slice(*there)], new[slice(*here)]
    if before == after:
        return
    start, end = there
    if "\r" not in before + after:  # CR LF must not be split
        same_start = _common(before, after)
        before, after = before[same_start:], after[same_start:]
        same_end = _common(before[::-1], after[::-1])
        start, end = start + same_start, end - same_end
        after = after[: len(after) - same_end]
    yield start, end, after


def _common(token: str, other: str) -> int:
    """How many characters both begin with."""
    pairs = zip(token, other, strict=False)
    return next((i for i, (a, b) in enumerate(pairs) if a != b), min(len(token), len(other)))
