"""Diagnostics: every stage adds them to a report; the command line and the editor show them.

In: spans and messages. Out: `Diagnostic` values collected in a `Report`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from enum import StrEnum

from robocomp_dsl.finding import Finding
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.source import Source, Span


class Severity(StrEnum):
    """How severe a diagnostic is; only errors stop the later stages."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


class Code(ValueRecord):
    """A kind of diagnostic and the text that `rcgen explain` prints.

    `explanation` says why the input is wrong and shows a wrong and a correct example.
    """

    id: str
    severity: Severity
    title: str
    explanation: str


class Note(ValueRecord):
    """A second location that explains a diagnostic, often in another file."""

    span: Span
    message: str


class Edit(ValueRecord):
    """Replace `span` by `text`."""

    span: Span
    text: str


class Fix(ValueRecord):
    """Edits that remove the cause of a diagnostic; applied together or not at all."""

    title: str
    edits: tuple[Edit, ...]


class UncertainText(ValueRecord):
    """What a syntax error leaves uncertain: findings that follow from it are not reported.

    `span` is the statement whose meaning is a guess. `names` are the names in text that was
    skipped. `declares`: a declaration has no name, so any unknown name may be its name.
    """

    span: Span
    names: frozenset[str] = frozenset()
    declares: bool = False


class UnknownName(ValueRecord):
    """The name that a finding reports as not declared.

    `declared` are the names of the declarations in the same file that it could refer to: one of
    them may be the misspelled name.
    """

    text: str
    declared: tuple[Span, ...]


class Diagnostic(ValueRecord):
    """One finding at one location. `label` is printed beside the carets, `help` below.

    `uncertain` is what a syntax error leaves uncertain, None for other findings. `unknown` is the
    name that is not declared, if the finding reports one.
    """

    code: Code
    span: Span
    message: str
    label: str = ""
    notes: tuple[Note, ...] = ()
    help: str = ""
    fix: Fix | None = None
    uncertain: UncertainText | None = None
    unknown: UnknownName | None = None

    @property
    def severity(self) -> Severity:
        """The severity of the code."""
        return self.code.severity


class Report:
    """The diagnostics of a run, in the order they were reported; duplicates are dropped."""

    __slots__ = ("_diagnostics",)

    def __init__(self) -> None:
        self._diagnostics: dict[tuple[str, Span, str], Diagnostic] = {}

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
        uncertain: UncertainText | None = None,
        unknown: UnknownName | None = None,
    ) -> None:
        """Add one diagnostic."""
        diagnostic = Diagnostic(
            code, span, message, label, tuple(notes), help, fix, uncertain, unknown
        )
        self._diagnostics.setdefault((code.id, span, message), diagnostic)

    def add_finding(self, code: Code, finding: Finding, source: Source) -> None:
        """Add a finding about `source`."""
        at = finding.location
        span = source.span_at(at.line, at.column, at.width)
        self.add(code, span, finding.message, label=finding.label, help=finding.help)

    def extend(self, diagnostics: Iterable[Diagnostic]) -> None:
        """Add diagnostics of another report."""
        for new in diagnostics:
            self._diagnostics.setdefault((new.code.id, new.span, new.message), new)

    def discard(self, diagnostics: Iterable[Diagnostic]) -> None:
        """Remove diagnostics of this report."""
        for old in diagnostics:
            self._diagnostics.pop((old.code.id, old.span, old.message), None)

    def replace(self, removed: Iterable[Diagnostic], added: Diagnostic) -> None:
        """Put one diagnostic in the place of others."""
        self.discard(removed)
        self.extend((added,))

    def __iter__(self) -> Iterator[Diagnostic]:
        return iter(self._diagnostics.values())

    def __len__(self) -> int:
        return len(self._diagnostics)

    @property
    def has_errors(self) -> bool:
        """Whether the report contains an error."""
        return any(diagnostic.severity is Severity.ERROR for diagnostic in self)

    def sorted(self) -> list[Diagnostic]:
        """The diagnostics sorted by file, position and code, as they are shown."""
        return sorted(
            self, key=lambda d: (str(d.span.source.path), d.span.start, d.span.end, d.code.id)
        )


_NEAR = 0.7
_MOST_COMPARED = 100


def is_similar(word: str, other: str) -> bool:
    """Whether one word may be a misspelling of the other, as for `nearest`."""
    return nearest(word, (other,)) is not None


def nearest(word: str, known: Iterable[str]) -> str | None:
    """The known name closest to `word`, or None; a difference in case only always matches."""
    by_letters: dict[str, str] = {}
    for name in known:
        by_letters.setdefault(name.lower(), name)
    letters = word.lower()
    if letters in by_letters:
        return by_letters[letters]
    fitting = _similar_length(letters, by_letters)
    if not fitting:
        return None
    from difflib import get_close_matches  # noqa: PLC0415 - rarely needed

    if matches := get_close_matches(letters, fitting, 1, _NEAR):
        return by_letters[matches[0]]
    swapped = (name for name in fitting if len(name) > 2 and sorted(name) == sorted(letters))
    return by_letters[found] if (found := next(swapped, "")) else None


def _similar_length(word: str, known: Iterable[str]) -> list[str]:
    """The names whose length allows a match; if there are very many, the most similar ones."""
    # The similarity ratio is 2 * (letters in common) / (letters of both).
    half = _NEAR / 2
    fitting = [k for k in known if min(len(k), len(word)) >= half * (len(k) + len(word))]
    if len(fitting) > _MOST_COMPARED:
        letters = set(word)
        fitting.sort(key=lambda k: len(letters.symmetric_difference(k)))
    return fitting[:_MOST_COMPARED]


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """The label ``did you mean `x`?``, or an empty string."""
    guess = nearest(word, known)
    return f"did you mean `{guess}`?" if guess else ""
