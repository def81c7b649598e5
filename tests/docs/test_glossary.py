"""The tree answers where things are: the paths of the glossary, and ten questions of a stranger."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.docs.blocks import ROOT

GLOSSARY = ROOT / "docs" / "glossary.md"
PACKAGE = ROOT / "robocomp_dsl"
QUESTIONS = {
    "Where is the restart policy of a supervised process decided?": "deploy/supervisor/restart.py",
    "Where is the list of all passes of the checker?": "check/__init__.py",
    "Where is an import path resolved to a file?": "check/workspace/import_resolver.py",
    "Where does the parser recover from a syntax error?": "syntax/recovery/recovery.py",
    "Where does the language server compute hover texts?": "language_server/features/hover.py",
    "Where does a component find its peers' sockets?": "runtime/presence/domain_session.py",
    "Where is the type hash of an interface computed?": "runtime/data/type_hash.py",
    "Where is the PID controller of a joint?": "hardware/control/regulators/pid.py",
    "Where is the camera simulated with MuJoCo?": "simulation/devices/camera.py",
    "Where is the force-distance law of the reflex?": "tactile/reflex/law.py",
}
"""What a person who has never seen the project finds from the names in the tree alone."""


def _rows() -> list[tuple[str, str]]:
    rows = re.findall(
        r"^\| (?P<term>[^|]+) \| [^|]+ \| `(?P<path>[^`]+)` \|$",
        GLOSSARY.read_text(encoding="utf-8"),
        re.MULTILINE,
    )
    return [(term, path) for term, path in rows if term != "term"]


def _exists(path: str) -> bool:
    return any((base / path).exists() for base in (ROOT, PACKAGE))


@pytest.mark.parametrize(("question", "path"), QUESTIONS.items())
def test_tree_answers_question(question: str, path: str) -> None:
    assert (PACKAGE / path).is_file(), question


@pytest.mark.parametrize(("term", "path"), _rows(), ids=lambda value: value)
def test_place_of_glossary_term_exists(term: str, path: str) -> None:
    assert _exists(path), term


def test_every_line_of_the_glossary_tables_was_read() -> None:
    lines = GLOSSARY.read_text(encoding="utf-8").splitlines()
    tables = [line for line in lines if line.startswith("| ")]
    headers = [line for line in tables if line.startswith("| term ")]
    assert len(tables) - len(headers) == len(_rows())
    assert len(_rows()) > 80


def test_answers_are_in_the_package_and_each_file_is_named_once() -> None:
    assert len(set(QUESTIONS.values())) == len(QUESTIONS) == 10
    assert all(Path(path).suffix == ".py" for path in QUESTIONS.values())
