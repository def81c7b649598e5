"""What a text is made of besides blanks: tokens and comments, in order.

In: a text. Out: `Piece` values. Formatting changes what stands between them and nothing else, so
the pieces before and after are the same; `same` is the proof, `changes` the difference.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

Change = tuple[int, int, str]
"""Put the text in the place [start, end)."""

COMMENTS = frozenset(("LINE", "BLOCK"))


@dataclass(slots=True)
class Piece:
    """A token or a comment at [start, end) of its text, with a line feed for every line end in it.

    `kind` is `LINE` for a comment that reaches to the end of its line, `BLOCK` for any other one,
    else the name of the terminal. `breaks` counts the line ends in front of it, `margin` is what
    stands in front of it on its line if that is blank.
    """

    kind: str
    text: str
    start: int
    end: int
    breaks: int
    margin: str | None = None

    @property
    def comment(self) -> bool:
        """Whether it is one, of whatever kind."""
        return self.kind in COMMENTS

    @property
    def sign(self) -> str:
        """What rules of style know it by: its text if that is a sign, else its kind."""
        return self.text if self.kind == "SIGN" else self.kind

    @property
    def essence(self) -> tuple[str, str]:
        """What must stay: everything but how the lines of a comment are indented."""
        if self.comment and "\n" in self.text:
            return self.kind, "\n".join(line.strip() for line in self.text.split("\n"))
        return self.kind, self.text


def make(kind: str, text: str, start: int, end: int, behind: int) -> Piece:
    """The piece at [start, end) of `text`; the one before it ends at `behind`."""
    gap = text[behind:start]
    breaks = gap.count("\n")
    margin = gap[gap.rfind("\n") + 1 :] if breaks or not behind else None
    written = text[start:end]
    if "\r" in written:
        written = written.replace("\r\n", "\n")
    if kind in COMMENTS:
        written = "\n".join(line.rstrip() for line in written.split("\n"))
    return Piece(kind, written, start, end, breaks, margin)


def same(old: Sequence[Piece], new: Sequence[Piece]) -> bool:
    """Whether two texts say the same."""
    return [one.essence for one in old] == [one.essence for one in new]


def changes(
    old: str, new: str, old_pieces: Sequence[Piece], new_pieces: Sequence[Piece]
) -> Iterator[Change]:
    """The small changes that make `new` of `old`, in order; their pieces must be the `same`."""
    at_old = at_new = 0
    for one, other in zip(old_pieces, new_pieces, strict=True):
        yield from _change(old, new, (at_old, one.start), (at_new, other.start))
        yield from _change(old, new, (one.start, one.end), (other.start, other.end))
        at_old, at_new = one.end, other.end
    yield from _change(old, new, (at_old, len(old)), (at_new, len(new)))


def _change(old: str, new: str, there: tuple[int, int], here: tuple[int, int]) -> Iterator[Change]:
    before, after = old[slice(*there)], new[slice(*here)]
    if before == after:
        return
    start, end = there
    if "\r" not in before + after:  # of a pair of characters none may be left alone
        same_start = _common(before, after)
        before, after = before[same_start:], after[same_start:]
        same_end = _common(before[::-1], after[::-1])
        start, end = start + same_start, end - same_end
        after = after[: len(after) - same_end]
    yield start, end, after


def _common(one: str, other: str) -> int:
    """How many characters both begin with."""
    pairs = zip(one, other, strict=False)
    return next((i for i, (a, b) in enumerate(pairs) if a != b), min(len(one), len(other)))
