"""A real Emacs, in batch mode, with eglot and the modes that we ship."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from lsprotocol import types as lsp

from robocomp_dsl.language_server.server import FEATURES
from tests.support.real_editor import EDITORS, Project, missing, need, run
from tests.support.samples import FILES, MISTAKES, Mistake

pytestmark = pytest.mark.editors

DRIVE = Path(__file__).with_name("drive.el")


@pytest.fixture(scope="module")
def emacs(home: Path) -> list[str | Path]:
    """The command of an Emacs that has eglot and finds our modes."""
    command: list[str | Path] = [need("emacs"), "--batch", "-L", EDITORS / "emacs"]
    library = run([*command, "--eval", '(princ (locate-library "eglot"))'], home, home)
    return missing("eglot") if "nil" in library.splitlines()[-1] else command


@pytest.fixture(scope="module")
def seen(emacs: list[str | Path], project: Project, home: Path) -> dict[str, Any]:
    """What a user of Emacs sees in the project."""
    result = project.path("result.json")
    run([*emacs, "-l", DRIVE], project.folder, home, {"RESULT": str(result)})
    report: dict[str, Any] = json.loads(result.read_text())
    return report


@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda case: case.file)
def test_emacs_shows_findings_at_position(seen: dict[str, Any], mistake: Mistake) -> None:
    ((line, column, message),) = seen["findings"][mistake.file]
    assert (line, column) == (mistake.line, mistake.column)
    assert mistake.message in message


def test_emacs_hover_shows_interface(seen: dict[str, Any]) -> None:
    assert "interface Scans::Laser" in seen["hover"]


def test_emacs_completion_offers_interfaces(seen: dict[str, Any]) -> None:
    assert "Laser" in seen["completion"]


def test_emacs_definition_jumps_to_interface(seen: dict[str, Any]) -> None:
    assert seen["definition"] == ["Laser.idsl", 6, 14]


def test_emacs_rename_changes_all_files(seen: dict[str, Any]) -> None:
    assert "    interface Lidar\n" in seen["renamed"]["Laser.idsl"]
    assert "    Communications { requires Lidar; };\n" in seen["renamed"]["reader.cdsl"]


@pytest.mark.skipif(
    lsp.TEXT_DOCUMENT_FORMATTING not in FEATURES, reason="the server does not format"
)
def test_emacs_formats_file(seen: dict[str, Any]) -> None:
    assert seen["formatted"] == FILES["reader.cdsl"]


def test_emacs_highlights_keywords_and_comments(seen: dict[str, Any]) -> None:
    assert seen["faces"] == ["font-lock-keyword-face", "font-lock-comment-face", "nil"]


def test_emacs_indentation_keeps_formatted_file(seen: dict[str, Any]) -> None:
    assert seen["indented"] is True


@pytest.mark.parametrize("file", ["robocomp.el", "robocomp-words.el"])
def test_emacs_modes_compile_without_warnings(
    emacs: list[str | Path], file: str, home: Path, tmp_path: Path
) -> None:
    source = tmp_path / file
    source.write_text((EDITORS / "emacs" / file).read_text(encoding="utf-8"), encoding="utf-8")
    strict = "(setq byte-compile-error-on-warn t)"
    run([*emacs, "--eval", strict, "-f", "batch-byte-compile", source], tmp_path, home)


def test_emacs_without_server_shows_install_command(
    emacs: list[str | Path], home: Path, tmp_path: Path
) -> None:
    expression = "(condition-case err (robocomp--contact) (error (princ (cadr err))))"
    command = [*emacs, "-l", "robocomp", "--eval", expression]
    output = run(command, tmp_path, home, {"PATH": str(tmp_path)})
    assert "pip install 'robocomp_dsl[editor]'" in output
