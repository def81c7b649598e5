"""Configurations of editors that cannot be run here are well formed, and name what exists."""

from __future__ import annotations

import json
import shutil
import subprocess
import tomllib
from pathlib import Path
from typing import Any

import pytest

from tests.support.real_editor import EDITORS

BRACES = {"idsl", "cdsl", "pdsl", "ddsl", "smdsl", "bdsl"}
COMMAND = ["rcgen", "lsp"]


def toml(path: Path) -> dict[str, Any]:
    return tomllib.loads(path.read_text(encoding="utf-8"))


def test_helix_configuration_names_server_and_languages() -> None:
    read = toml(EDITORS / "helix" / "languages.toml")
    server = read["language-server"]["robocomp"]
    assert [server["command"], *server["args"]] == COMMAND
    languages = {item["name"]: item for item in read["language"]}
    assert set(languages) == {*BRACES, "scxml", "innermodel"}
    for name, language in languages.items():
        assert language["language-servers"] == ["robocomp"]
        if name in BRACES:
            assert language["file-types"] == [name]
            assert language["scope"] == f"source.{name}"


def test_zed_extension_names_server_and_languages() -> None:
    folder = EDITORS / "zed"
    extension = toml(folder / "extension.toml")
    languages = {
        path.parent.name: toml(path) for path in sorted(folder.glob("languages/*/config.toml"))
    }
    assert {name: language["path_suffixes"] for name, language in languages.items()} == {
        name: [name] for name in BRACES
    }
    server = extension["language_servers"]["rcgen"]
    assert set(server["languages"]) == {language["name"] for language in languages.values()}
    assert server["language_ids"] == {
        language["name"]: name for name, language in languages.items()
    }
    assert toml(folder / "Cargo.toml")["package"]["version"] == extension["version"]
    binary = json.loads((folder / "settings.json").read_text())["lsp"]["rcgen"]["binary"]
    assert binary["arguments"] == ["lsp"]


@pytest.mark.editors
def test_zed_extension_is_formatted_rust() -> None:
    rustfmt = shutil.which("rustfmt")
    if rustfmt is None:
        pytest.skip("rustfmt is not installed, and no make target installs it: see rustup.rs")
    source = EDITORS / "zed" / "src" / "lib.rs"
    command = [rustfmt, "--edition", "2021", "--check", source]
    subprocess.run(command, check=True, timeout=60)


def test_kate_configuration_names_server_and_languages() -> None:
    servers = json.loads((EDITORS / "kate" / "lspclient.json").read_text())["servers"]
    assert set(servers) == BRACES
    assert servers["idsl"]["command"] == COMMAND
    assert all(servers[item]["use"] == "idsl" for item in BRACES - {"idsl"})
    for name, server in servers.items():
        assert server["highlightingModeRegex"] == f"^{name.upper()}$"
