"""Moves errors about unknown names to the declaration that is misspelled.

In: the findings of a file. Out: the same findings, but one error at a misspelled declaration
instead of one at each use.

A declaration is misspelled if uses agree on one unknown name, the declaration is of the right kind,
no other one has a name as similar, and nothing uses it. If there is only one use, either of the two
may be misspelled: `word_plausibility` decides.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import chain

from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import (
    Diagnostic,
    Note,
    Report,
    Severity,
    is_similar,
)
from robocomp_dsl.source import Source, Span

SHORTEST = 3
"""Letters of the shortest name that may be a misspelled one with one other letter."""

MAX_NAMES = 20
"""Number of different unknown names for which a misspelled declaration is looked for."""

MAX_NOTES = 8
"""Uses that a finding shows; more would hide the declaration."""

_WORD = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|(\w+)', re.DOTALL | re.ASCII)


def report_misspelled_declarations(report: Report) -> None:
    """Report unknown names at the declaration, where that is what is misspelled."""
    uses: dict[tuple[Source, str], list[Diagnostic]] = {}
    for diagnostic in report:
        if diagnostic.unknown:
            key = (diagnostic.span.source, diagnostic.unknown.text)
            uses.setdefault(key, []).append(diagnostic)
    found: dict[Span, list[list[Diagnostic]]] = {}
    words: dict[Source, Counter[str]] = {}
    for (source, text), group in [*uses.items()][:MAX_NAMES]:
        if source not in words:
            words[source] = count_words(source.text)
        declaration = _misspelled(text, source, group, words[source], report)
        if declaration:
            found.setdefault(declaration, []).append(group)
    for declaration, groups in found.items():
        if len(groups) == 1:
            _move(declaration, groups[0], report)


def count_words(text: str) -> Counter[str]:
    """How often each word occurs in a text, outside of comments and strings."""
    return Counter(match[1] for match in _WORD.finditer(text) if match[1])


def _misspelled(
    text: str, source: Source, group: Sequence[Diagnostic], words: Counter[str], report: Report
) -> Span | None:
    """The declaration in `source` that the uses of `text` refer to, and no other name."""
    spans = chain.from_iterable(use.unknown.declared for use in group if use.unknown)
    has_several = len({use.span for use in group}) > 1
    alike = _is_similar if has_several else is_similar
    candidates = [
        span
        for span in dict.fromkeys(spans)
        if span.source is source and words[span.text] == 1 and alike(text, span.text)
    ]
    declaration = _most_similar(text, candidates)
    if declaration is None:
        return None
    if has_several or _fixed_at(declaration, text, report):
        return declaration
    from robocomp_dsl.check.names.word_plausibility import is_more_plausible  # noqa: PLC0415

    return declaration if is_more_plausible(text, declaration.text, source) else None


def _move(declaration: Span, group: Sequence[Diagnostic], report: Report) -> None:
    """Replace the errors of a group by one at the declaration; the uses become its notes."""
    first = group[0]
    text = first.unknown.text if first.unknown else ""
    spans = sorted({use.span for use in group}, key=lambda span: span.start)
    notes = tuple(Note(span, f"`{text}` is used here") for span in spans[:MAX_NOTES])
    at_declaration = [d for d in report if d.span == declaration]
    same = _fixed_at(declaration, text, report)
    warnings = [d for d in at_declaration if d.severity is not Severity.ERROR]
    if same is not None:
        moved = same.replace(notes=(*same.notes, *notes))
    else:
        moved = Diagnostic(
            first.code,
            declaration,
            f"`{declaration.text}` is declared, but `{text}` is used",
            label=f"did you mean `{text}`?",
            notes=notes,
            help=_more(spans),
            fix=replace_fix(declaration, text),
        )
    report.replace([*group, *warnings, *([same] if same else [])], moved)


def _most_similar(text: str, candidates: Sequence[Span]) -> Span | None:
    """The name that is most similar to `text`; None if two are equally similar."""
    if len(candidates) < 2:
        return candidates[0] if candidates else None
    from difflib import SequenceMatcher  # noqa: PLC0415 - rarely needed

    ratios = [SequenceMatcher(None, text, span.text).ratio() for span in candidates]
    best = max(ratios)
    return candidates[ratios.index(best)] if ratios.count(best) == 1 else None


def _is_similar(text: str, declared: str) -> bool:
    """Whether one may be a misspelling of the other; short names may differ in one letter."""
    differing = sum(a != b for a, b in zip(text, declared, strict=False))
    return is_similar(text, declared) or (differing == 1 and len(text) == len(declared) >= SHORTEST)


def _fixed_at(declaration: Span, text: str, report: Report) -> Diagnostic | None:
    """The finding at a declaration whose fix changes its name to `text`."""
    fix = replace_fix(declaration, text)
    return next((d for d in report if d.span == declaration and d.fix == fix), None)


def _more(spans: Iterable[Span]) -> str:
    count = len([*spans]) - MAX_NOTES
    return f"{count} more uses are not shown" if count > 0 else ""
