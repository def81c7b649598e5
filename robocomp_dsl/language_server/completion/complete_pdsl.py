"""Completion of PDSL files."""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.language_server.completion.candidates import CompletionCandidate, value_candidates
from robocomp_dsl.language_server.completion.context import CompletionContext
from robocomp_dsl.language_server.session import Session


def candidates(session: Session, context: CompletionContext) -> Iterator[CompletionCandidate]:  # noqa: ARG001 - as of all languages
    """The values of a boolean; the user chooses all other names."""
    if context.previous_kind == "BOOL_TYPE":
        yield from value_candidates("true", "false")
