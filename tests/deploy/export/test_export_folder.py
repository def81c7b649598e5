"""An export is the same each time, keeps foreign files, and has no secrets."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.deploy.export.folder import (
    MANIFEST,
    ExportFile,
    ForeignFiles,
    write_folder,
)
from robocomp_dsl.deploy.export.names import service_names
from tests.deploy.export.conftest import Export

TARGETS = ("systemd", "compose", "kubernetes")


def contents(folder: Path) -> dict[str, bytes]:
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file()
    }


@pytest.mark.parametrize("target", TARGETS)
def test_export_is_deterministic_and_has_no_secrets(
    export: Export, tmp_path: Path, target: str
) -> None:
    result = export(target, "--keys")
    assert result.exit_code == 0, result.output
    first = contents(tmp_path / "build")
    again = export(target)
    assert ", 0 changed" in again.output
    assert contents(tmp_path / "build") == first
    keys = [path.read_bytes() for path in (tmp_path / "config").rglob("*.key")]
    assert bool(keys) == (target != "systemd")
    for name, data in first.items():
        assert b"PRIVATE KEY" not in data, name
        assert b"t0ps3cret" not in data or target == "systemd", name


def test_export_keeps_foreign_and_changed_files(export: Export, tmp_path: Path) -> None:
    assert export("compose").exit_code == 0
    changed = tmp_path / "build/compose.yaml"
    changed.write_text("mine\n")
    refused = export("compose")
    assert refused.exit_code == 1
    assert "RC860" in refused.output
    assert "compose.yaml" in refused.output
    assert changed.read_text() == "mine\n"


def test_export_to_another_system_replaces_own_files(export: Export, tmp_path: Path) -> None:
    export("compose")
    (tmp_path / "build/notes.txt").write_text("mine\n")
    assert export("kubernetes").exit_code == 0
    assert not (tmp_path / "build/compose.yaml").exists()
    assert not (tmp_path / "build/network").exists()
    assert (tmp_path / "build/notes.txt").read_text() == "mine\n"


def test_write_folder_refuses_links_and_paths_of_a_forged_manifest(tmp_path: Path) -> None:
    folder, outside = tmp_path / "out", tmp_path / "outside"
    outside.mkdir()
    folder.mkdir()
    (folder / "sub").symlink_to(outside)
    with pytest.raises(ForeignFiles, match="sub/file"):
        write_folder(folder, "x", {"sub/file": ExportFile("text")})
    assert not list(outside.iterdir())
    victim = outside / "victim"
    victim.write_text("kept")
    (folder / MANIFEST).write_text('{"files": {"../outside/victim": "", "/etc/x": ""}}')
    write_folder(folder, "x", {"file": ExportFile("text")})
    assert victim.read_text() == "kept"


def test_service_names_are_distinct_labels() -> None:
    names = ["left/arm", "left-arm", "Left_Arm", "9", "router", "x" * 80, "é"]
    found = service_names(names, reserved=("router",))
    assert len(set(found.values())) == len(names)
    assert "router" not in found.values()
    assert all(len(name) <= 40 and name[0].isalpha() for name in found.values())
    assert all(name.replace("-", "").isalnum() and name == name.lower() for name in found.values())
