"""Commands with paths that are no regular files: a finding, no wait and no endless read."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from robocomp_dsl import regular_file
from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.runtime.parameters.load import UnreadableFile, read_text
from robocomp_dsl.source import Source, UnreadableSource


@pytest.fixture(params=["FIFO", "device"])
def special(tmp_path: Path, request: pytest.FixtureRequest) -> tuple[Path, str]:
    """A path that is no regular file, and the word that says what it is."""
    path = tmp_path / "special.cdsl"
    if request.param == "FIFO":
        os.mkfifo(path)
    else:
        path.symlink_to("/dev/zero")
    return path, request.param


def test_source_read_refuses_special_files(special: tuple[Path, str]) -> None:
    with pytest.raises(UnreadableSource, match=f"it is a {special[1]}, not a regular file"):
        Source.read(special[0])


def test_check_cdsl_reports_special_files(special: tuple[Path, str]) -> None:
    report = Report()
    assert check_cdsl(special[0], Workspace(), report) is None
    assert [finding.code.id for finding in report] == ["RC001"]


def test_configuration_refuses_special_files(special: tuple[Path, str]) -> None:
    with pytest.raises(UnreadableFile, match=f"it is a {special[1]}, not a regular file"):
        read_text(special[0])


def test_open_regular_refuses_folders(tmp_path: Path) -> None:
    with pytest.raises(IsADirectoryError):
        regular_file.open_regular(tmp_path)


def test_read_text_translates_line_ends(tmp_path: Path) -> None:
    (tmp_path / "text").write_bytes(b"\xef\xbb\xbfa\r\nb\rc\n")
    assert regular_file.read_text(tmp_path / "text", "utf-8-sig") == "a\nb\nc\n"
