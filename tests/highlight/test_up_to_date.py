"""Files generated from the grammars are up to date."""

from __future__ import annotations

import json

import pytest

from editors.highlight.files import ROOT, files, table_file
from robocomp_dsl.highlight.table import LANGUAGES, words
from robocomp_dsl.syntax.grammar.tables import load

STALE = "run `make highlight` and commit what it changes"


def test_word_table_is_up_to_date() -> None:
    (path, text), *_ = table_file().items()
    assert json.loads((ROOT / path).read_text(encoding="utf-8")) == json.loads(text), STALE


@pytest.mark.parametrize("path", files())
def test_editor_files_are_up_to_date(path: str) -> None:
    assert (ROOT / path).read_text(encoding="utf-8") == files()[path], STALE


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_keyword_has_a_context(language: str) -> None:
    of = words(language)
    placed = {*of.plain, *of.types}
    for statement in of.statements:
        placed |= {statement.word, *statement.inner}
    fold = str.lower if of.any_case else str
    assert {fold(word) for word in placed} >= set(load(language).keywords)


def test_every_editor_file_has_every_keyword() -> None:
    for path, text in files().items():
        language = next((name for name in LANGUAGES if f"/{name}." in path), None)
        for word in words(language).keywords if language else ():
            assert word in text, f"{path} lacks {word}"
