"""What a scan of a folder takes, leaves out and refuses."""

from __future__ import annotations

import os
import socket
from pathlib import Path

import pytest

from robocomp_dsl.deploy.content import folder_scan
from robocomp_dsl.deploy.content.folder_scan import scan_folder
from tests.deploy.content.workspace_files import write_files


def scan(folder: Path) -> tuple[list[str], dict[str, str]]:
    """Relative paths of the files, and the problems by relative path."""
    found = scan_folder(folder)
    files = [str(Path(path).relative_to(folder)) for path, _ in found.files]
    return files, {str(p.path.relative_to(folder)): p.message for p in found.problems}


def test_folder_scan_leaves_out_caches_and_version_control(workspace: Path) -> None:
    write_files(
        workspace,
        dict.fromkeys(
            [
                "main.py", "etc/config.yaml", ".hidden", "build/arm", "a~", "main.py.swp",
                ".git/HEAD", ".rcgen/methods.json", "__pycache__/main.pyc", "old.pyc",
                ".mypy_cache/x", "env/pyvenv.cfg", "env/bin/python", "node_modules/x/y.js",
            ],
            "x",
        ),
    )  # fmt: skip
    (workspace / ".#main.py").symlink_to("nobody@nowhere:1")  # Emacs locks a file in this way
    assert scan(workspace) == ([".hidden", "build/arm", "etc/config.yaml", "main.py"], {})


def test_folder_scan_skips_sockets_and_fifos(workspace: Path, monkeypatch) -> None:
    monkeypatch.chdir(workspace)
    os.mkfifo("pipe")
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind("listener")
        assert scan(workspace) == ([], {})


def test_folder_scan_follows_links_to_files_and_folders(workspace: Path, tmp_path: Path) -> None:
    write_files(tmp_path / "elsewhere", {"map.yaml": "m", "meshes/arm.stl": "s"})
    (workspace / "map.yaml").symlink_to(tmp_path / "elsewhere/map.yaml")
    (workspace / "meshes").symlink_to("../elsewhere/meshes")
    assert scan(workspace) == (["map.yaml", "meshes/arm.stl"], {})
    statuses = dict(scan_folder(workspace).files)
    assert statuses[str(workspace / "map.yaml")].st_size == 1


def test_folder_scan_refuses_links_that_lead_nowhere(workspace: Path) -> None:
    write_files(workspace, {"a/b/file": "x"})
    (workspace / "gone").symlink_to("missing.yaml")
    (workspace / "a/b/up").symlink_to("../..")
    (workspace / "self").symlink_to("self")
    files, problems = scan(workspace)
    assert files == ["a/b/file"]
    assert problems["gone"] == "is a symbolic link to missing.yaml, which does not exist"
    assert problems["a/b/up"] == "is a symbolic link to its own folder"
    assert problems["self"].startswith("is a symbolic link to self, which cannot be followed")


@pytest.mark.skipif(os.getuid() == 0, reason="root reads every folder")
def test_folder_scan_reports_unreadable_folders(workspace: Path) -> None:
    write_files(workspace, {"locked/file": "x"})
    (workspace / "locked").chmod(0)
    files, problems = scan(workspace)
    (workspace / "locked").chmod(0o755)
    assert not files
    assert problems == {"locked": "cannot be read: Permission denied"}


def test_folder_scan_refuses_huge_files(workspace: Path) -> None:
    with (workspace / "recording.bag").open("wb") as stream:
        stream.truncate(30_000_000_000)  # a sparse file
    files, problems = scan(workspace)
    assert not files
    assert problems == {"recording.bag": "is too large (30.0 GB; at most 1.1 GB)"}


def test_folder_scan_ends_at_the_limit_of_files(workspace: Path, monkeypatch) -> None:
    monkeypatch.setattr(folder_scan, "MAX_FILES", 20)
    write_files(workspace, {f"{n}/{m}": "" for n in range(6) for m in range(6)})
    found = scan_folder(workspace)
    assert len(found.files) == 20
    assert [p.message for p in found.problems] == ["has more than 20 files"]


def test_folder_scan_refuses_names_without_encoding(workspace: Path) -> None:
    Path(os.fsdecode(os.fsencode(workspace) + b"/caf\xe9.txt")).touch()
    (problem,) = scan_folder(workspace).problems
    assert "not encoded in UTF-8" in problem.message
