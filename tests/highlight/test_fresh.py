"""What is made from the grammars is what the grammars say."""

from __future__ import annotations

import json

import pytest

from editors.highlight.files import ROOT, files, table_file
from robocomp_dsl.highlight.table import LANGUAGES, words
from robocomp_dsl.syntax.tables import load

STALE = "run `make highlight` and commit what it changes"


def test_the_table_of_words_is_fresh() -> None:
    (path, text), *_ = table_file().items()
    assert json.loads((ROOT / path).read_text(encoding="utf-8")) == json.loads(text), STALE


@pytest.mark.parametrize("path", files())
def test_the_files_of_the_editors_are_fresh(path: str) -> None:
    assert (ROOT / path).read_text(encoding="utf-8") == files()[path], STALE


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_keyword_has_a_place(language: str) -> None:
    of = words(language)
    placed = {*of.plain, *of.types}
    for one in of.statements:
        placed |= {one.word, *one.inner}
    fold = str.lower if of.any_case else str
    assert {fold(word) for word in placed} >= set(load(language).keywords)


def test_every_file_knows_every_keyword() -> None:
    for path, text in files().items():
        language = next((one for one in LANGUAGES if f"/{one}." in path), None)
        for word in words(language).keywords if language else ():
            assert word in text, f"{path} lacks {word}"
