"""Completion of PDSL files."""

from __future__ import annotations

import re
from collections.abc import Iterator

from robocomp_dsl.language_server.completion.candidates import CompletionCandidate, value_candidates
from robocomp_dsl.language_server.completion.context import CompletionContext
from robocomp_dsl.language_server.session import Session

_DEFAULT = r"\s*(?:\{[^{};]*)?\Z"
"""Up to the cursor: the place of a default, also in the braces of a list."""
_CHOICES = re.compile(r"\{(\s*\w+(?:\s*,\s*\w+)*)\s*\}" + _DEFAULT)
_BOOL = re.compile(r"\bbool\b" + _DEFAULT, re.IGNORECASE)


def candidates(session: Session, context: CompletionContext) -> Iterator[CompletionCandidate]:  # noqa: ARG001 - as of all languages
    """The values of a boolean or of an enumeration; the user chooses all other names."""
    before = context.source.text[: context.start]
    if _BOOL.search(before):
        yield from value_candidates("true", "false")
    elif choices := _CHOICES.search(before):
        yield from value_candidates(*choices[1].replace(",", " ").split())
