"""After any edits a document has the findings, symbols and positions of a newly opened one."""

from __future__ import annotations

import random
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from lsprotocol import types as lsp

from robocomp_dsl.language_server.diagnostics import diagnostics_of
from robocomp_dsl.language_server.documents import synchronize
from robocomp_dsl.language_server.features.document_symbols import document_symbols
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.parse import LANGUAGES
from tests.syntax.test_edits import next_text
from tests.syntax.test_mutated import REAL, ROOT

FILES = {
    suffix: [p for p in REAL[suffix] if p.relative_to(ROOT).parts[0] != "tests"] or REAL[suffix]
    for suffix in LANGUAGES
}
"""Shipped files, whose imports are found; of BDSL only test cases exist."""


def shown(session: Session, path: Path) -> tuple[Any, ...]:
    """The diagnostics, the symbols at each name, and the outline."""
    checked = session.check(path)
    index = session.index(path)
    names = [
        (
            place.span.start,
            place.span.end,
            place.declares,
            place.symbol.name,
            place.symbol.kind,
            place.symbol.key,
            place.symbol.container,
        )
        for place in index.occurrences
    ]
    params = lsp.DocumentSymbolParams(lsp.TextDocumentIdentifier(path.as_uri()))
    outline = document_symbols(session, params)
    return diagnostics_of(session, checked), names, index.complete, outline


def change(session: Session, path: Path, version: int, old: str, new: str) -> None:
    """Send the difference of two texts as one edit, as an editor does."""
    start = next((i for i, (a, b) in enumerate(zip(old, new, strict=False)) if a != b), 0)
    end = len(old)
    put = new[start:]
    while put and end > start and put[-1] == old[end - 1]:
        put, end = put[:-1], end - 1
    places = (session.positions.position_at(Source(path, old), at) for at in (start, end))
    edit = lsp.TextDocumentContentChangePartial(lsp.Range(*places), put)
    document = lsp.VersionedTextDocumentIdentifier(version, path.as_uri())
    synchronize.did_change(session, lsp.DidChangeTextDocumentParams(document, [edit]))
    assert session.source(path.as_uri()).text == new


@pytest.mark.parametrize("suffix", sorted(LANGUAGES))
@settings(max_examples=12, deadline=None, suppress_health_check=list(HealthCheck))
@given(seed=st.integers(0, 2**32))
def test_session_checks_an_edited_document_as_a_new_one(suffix: str, seed: int) -> None:
    rng = random.Random(seed)
    path = rng.choice(FILES[suffix])
    texts = [path.read_text("utf-8", "replace").replace("\r", "")]
    session = Session(environ={})
    session.open(path.as_uri(), texts[0], 0)
    shown(session, path)
    for version in range(rng.randint(2, 6)):
        texts.append(next_text(texts, rng).replace("\r", ""))
        change(session, path, version, texts[-2], texts[-1])
        fresh = Session(environ={})
        fresh.open(path.as_uri(), texts[-1], 0)
        assert shown(session, path) == shown(fresh, path), "\n=====\n".join(texts)
