"""Every example on the page of the languages is right."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from robocomp_dsl.check import check_syntax
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report

PAGE = Path(__file__).parents[2] / "docs" / "languages.md"
SUFFIXES = {"InnerModel": ".xml"}


def _examples() -> list[tuple[str, str]]:
    made = []
    for section in PAGE.read_text(encoding="utf-8").split("\n## ")[1:]:
        language = section.split(":")[0]
        suffix = SUFFIXES.get(language, f".{language.lower()}")
        made += [
            (suffix, text) for text in re.findall(r"```(?:xml)?\n(.*?)```", section, re.DOTALL)
        ]
    return made


@pytest.mark.parametrize(("suffix", "text"), _examples())
def test_it_is_read_without_a_word(tmp_path: Path, suffix: str, text: str) -> None:
    path = tmp_path / f"example{suffix}"
    path.write_text(text)
    report = Report()
    check_syntax(path, Workspace(environ={}), report)
    assert [d.message for d in report] == []


def test_every_language_has_one() -> None:
    known = {".idsl", ".cdsl", ".pdsl", ".ddsl", ".smdsl", ".scxml", ".xml"}
    assert {suffix for suffix, _ in _examples()} == known
