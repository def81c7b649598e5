"""What is in the file that a user installs into VS Code."""

from __future__ import annotations

import json
import re
import subprocess
import zipfile
from pathlib import Path
from typing import Any

import pytest

from tests.support.real_editor import EDITORS, need

pytestmark = pytest.mark.editors

BUILTIN = {"editor.action.showReferences", "workbench.action.openSettings"}


@pytest.fixture(scope="session")
def content(vsix: Path) -> dict[str, str]:
    """The files of the extension by name."""
    with zipfile.ZipFile(vsix) as archive:
        assert archive.testzip() is None
        names = [item for item in archive.namelist() if item.startswith("extension/")]
        return {name.removeprefix("extension/"): archive.read(name).decode() for name in names}


@pytest.fixture(scope="session")
def manifest(content: dict[str, str]) -> dict[str, Any]:
    package: dict[str, Any] = json.loads(content["package.json"])
    return package


def test_vsix_contains_all_contributed_files(
    content: dict[str, str], manifest: dict[str, Any]
) -> None:
    contributed = manifest["contributes"]
    files = {item["configuration"] for item in contributed["languages"]}
    files |= {item["path"] for kind in ("grammars", "snippets") for item in contributed[kind]}
    files |= {manifest["main"]}
    assert {file.removeprefix("./") for file in files} <= content.keys()


def test_vsix_contains_no_other_files(content: dict[str, str]) -> None:
    allowed = r"package\.json|readme\.md|[\w-]*language-configuration\.json|dist/extension\.js"
    folders = r"(snippets|syntaxes|grammars)/[\w.]+\.json"
    assert [item for item in content if not re.fullmatch(f"{allowed}|{folders}", item)] == []


def test_vsix_contributes_all_languages(manifest: dict[str, Any]) -> None:
    contributed = manifest["contributes"]
    languages = {item["id"]: item.get("extensions") for item in contributed["languages"]}
    braces = ["idsl", "cdsl", "pdsl", "ddsl", "smdsl", "bdsl"]
    assert languages == {
        **{brace: [f".{brace}"] for brace in braces},
        "scxml": [".scxml"],
        "innermodel": None,
    }
    assert {item["language"] for item in contributed["grammars"]} == set(languages)
    assert {item["language"] for item in contributed["snippets"]} == set(braces)


def test_vsix_grammars_have_scope_of_manifest(
    content: dict[str, str], manifest: dict[str, Any]
) -> None:
    for item in manifest["contributes"]["grammars"]:
        grammar = json.loads(content[item["path"].removeprefix("./")])
        assert grammar["scopeName"] == item["scopeName"]


def test_vsix_program_is_valid_javascript(content: dict[str, str], tmp_path: Path) -> None:
    program = tmp_path / "extension.js"
    program.write_text(content["dist/extension.js"], encoding="utf-8")
    subprocess.run([need("node"), "--check", program], check=True, timeout=60)
    # The archive contains no packages: only modules of VS Code and node may be required.
    required = set(re.findall(r'require\("([^"]+)"\)', program.read_text(encoding="utf-8")))
    builtin = subprocess.run(
        [need("node"), "-p", "JSON.stringify(require('module').builtinModules)"],
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    known = {"vscode", *json.loads(builtin.stdout)}
    assert {item.removeprefix("node:") for item in required} <= known


def test_vsix_program_defines_all_commands(
    content: dict[str, str], manifest: dict[str, Any]
) -> None:
    commands = {item["command"] for item in manifest["contributes"]["commands"]}
    in_menus = {
        item["command"] for menu in manifest["contributes"]["menus"].values() for item in menu
    }
    assert in_menus <= commands
    for command in commands:
        assert f'"{command}"' in content["dist/extension.js"]


def test_vsix_versions_are_equal() -> None:
    package = json.loads((EDITORS / "vscode" / "package.json").read_text())
    lock = json.loads((EDITORS / "vscode" / "package-lock.json").read_text())
    assert lock["version"] == lock["packages"][""]["version"] == package["version"]
