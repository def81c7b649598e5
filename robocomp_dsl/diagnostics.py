"""Findings: data that every stage adds to a report, and only the command line or an editor shows.

In: spans and words. Out: `Diagnostic` values collected in a `Report`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from enum import StrEnum

from robocomp_dsl.record import Value
from robocomp_dsl.source import Span


class Severity(StrEnum):
    """How bad a finding is; only errors stop the stages behind the one that found them."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


class Code(Value):
    """What a kind of finding is: the text that `rcgen explain` prints.

    `explanation` says why it is wrong and shows a wrong and a right example.
    """

    id: str
    severity: Severity
    title: str
    explanation: str


class Note(Value):
    """A second place that explains a finding, often in another file."""

    span: Span
    message: str


class Edit(Value):
    """Put `text` in the place of `span`."""

    span: Span
    text: str


class Fix(Value):
    """Edits that remove a finding; applied together or not at all."""

    title: str
    edits: tuple[Edit, ...]


class Diagnostic(Value):
    """One finding at one place. `label` stands beside the carets, `help` below the excerpt."""

    code: Code
    span: Span
    message: str
    label: str = ""
    notes: tuple[Note, ...] = ()
    help: str = ""
    fix: Fix | None = None

    @property
    def severity(self) -> Severity:
        """That of its code."""
        return self.code.severity


class Report:
    """The findings of a run, in the order they were made; duplicates are dropped."""

    __slots__ = ("_found",)

    def __init__(self) -> None:
        self._found: dict[tuple[str, Span, str], Diagnostic] = {}

    def add(
        self,
        code: Code,
        span: Span,
        message: str,
        *,
        label: str = "",
        notes: Iterable[Note] = (),
        help: str = "",
        fix: Fix | None = None,
    ) -> None:
        """Add one finding."""
        made = Diagnostic(code, span, message, label, tuple(notes), help, fix)
        self._found.setdefault((code.id, span, message), made)

    def extend(self, findings: Iterable[Diagnostic]) -> None:
        """Add findings made elsewhere."""
        for one in findings:
            self._found.setdefault((one.code.id, one.span, one.message), one)

    def __iter__(self) -> Iterator[Diagnostic]:
        return iter(self._found.values())

    def __len__(self) -> int:
        return len(self._found)

    @property
    def failed(self) -> bool:
        """Whether anything in it is an error."""
        return any(one.severity is Severity.ERROR for one in self)

    def sorted(self) -> list[Diagnostic]:
        """By file, place and code: the order in which they are shown."""
        return sorted(
            self, key=lambda d: (str(d.span.source.path), d.span.start, d.span.end, d.code.id)
        )


_NEAR = 0.7
_MOST_COMPARED = 100


def nearest(word: str, known: Iterable[str]) -> str | None:
    """The known name that `word` most likely means, or None; a wrong case always counts as near."""
    by_letters: dict[str, str] = {}
    for name in known:
        by_letters.setdefault(name.lower(), name)
    letters = word.lower()
    if letters in by_letters:
        return by_letters[letters]
    from difflib import get_close_matches  # noqa: PLC0415 - most runs find nothing misspelt

    found = get_close_matches(letters, _plausible(letters, by_letters), 1, _NEAR)
    return by_letters[found[0]] if found else None


def _plausible(word: str, known: Iterable[str]) -> list[str]:
    """Those of `known` that can be near by their lengths; of very many, the most similar."""
    # The measure is 2 * (letters in common) / (letters of both).
    half = _NEAR / 2
    fitting = [k for k in known if min(len(k), len(word)) >= half * (len(k) + len(word))]
    if len(fitting) > _MOST_COMPARED:
        letters = set(word)
        fitting.sort(key=lambda k: len(letters.symmetric_difference(k)))
    return fitting[:_MOST_COMPARED]


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """The label ``did you mean `x`?``, or an empty text."""
    guess = nearest(word, known)
    return f"did you mean `{guess}`?" if guess else ""
