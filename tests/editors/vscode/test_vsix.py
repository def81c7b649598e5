"""What is in the file that a user installs into VS Code."""

from __future__ import annotations

import json
import re
import subprocess
import zipfile
from pathlib import Path
from typing import Any

import pytest
from real_editor import EDITORS, need

pytestmark = pytest.mark.editors

BUILTIN = {"editor.action.showReferences", "workbench.action.openSettings"}


@pytest.fixture(scope="session")
def content(vsix: Path) -> dict[str, str]:
    """The files of the extension by name."""
    with zipfile.ZipFile(vsix) as archive:
        assert archive.testzip() is None
        names = [one for one in archive.namelist() if one.startswith("extension/")]
        return {one.removeprefix("extension/"): archive.read(one).decode() for one in names}


@pytest.fixture(scope="session")
def manifest(content: dict[str, str]) -> dict[str, Any]:
    made: dict[str, Any] = json.loads(content["package.json"])
    return made


def test_everything_that_is_contributed_is_inside(
    content: dict[str, str], manifest: dict[str, Any]
) -> None:
    contributed = manifest["contributes"]
    files = {one["configuration"] for one in contributed["languages"]}
    files |= {one["path"] for kind in ("grammars", "snippets") for one in contributed[kind]}
    files |= {manifest["main"]}
    assert {one.removeprefix("./") for one in files} <= content.keys()


def test_nothing_else_is_inside(content: dict[str, str]) -> None:
    kept = r"package\.json|readme\.md|[\w-]*language-configuration\.json|dist/extension\.js"
    folders = r"(snippets|syntaxes|grammars)/[\w.]+\.json"
    assert [one for one in content if not re.fullmatch(f"{kept}|{folders}", one)] == []


def test_every_language_is_contributed_whole(manifest: dict[str, Any]) -> None:
    contributed = manifest["contributes"]
    languages = {one["id"]: one.get("extensions") for one in contributed["languages"]}
    braces = ["idsl", "cdsl", "pdsl", "ddsl", "smdsl"]
    assert languages == {
        **{one: [f".{one}"] for one in braces},
        "scxml": [".scxml"],
        "innermodel": None,
    }
    assert {one["language"] for one in contributed["grammars"]} == set(languages)
    assert {one["language"] for one in contributed["snippets"]} == set(braces)


def test_grammars_have_the_scope_that_the_manifest_says(
    content: dict[str, str], manifest: dict[str, Any]
) -> None:
    for one in manifest["contributes"]["grammars"]:
        grammar = json.loads(content[one["path"].removeprefix("./")])
        assert grammar["scopeName"] == one["scopeName"]


def test_the_program_is_javascript(content: dict[str, str], tmp_path: Path) -> None:
    program = tmp_path / "extension.js"
    program.write_text(content["dist/extension.js"], encoding="utf-8")
    subprocess.run([need("node"), "--check", program], check=True, timeout=60)
    # Only what VS Code and node bring may be asked for, as no package is inside.
    asked = set(re.findall(r'require\("([^"]+)"\)', program.read_text(encoding="utf-8")))
    builtin = subprocess.run(
        [need("node"), "-p", "JSON.stringify(require('module').builtinModules)"],
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    known = {"vscode", *json.loads(builtin.stdout)}
    assert {one.removeprefix("node:") for one in asked} <= known


def test_all_commands_exist(content: dict[str, str], manifest: dict[str, Any]) -> None:
    commands = {one["command"] for one in manifest["contributes"]["commands"]}
    in_menus = {
        one["command"] for menu in manifest["contributes"]["menus"].values() for one in menu
    }
    assert in_menus <= commands
    for one in commands:
        assert f'"{one}"' in content["dist/extension.js"]


def test_versions_are_one() -> None:
    package = json.loads((EDITORS / "vscode" / "package.json").read_text())
    lock = json.loads((EDITORS / "vscode" / "package-lock.json").read_text())
    assert lock["version"] == lock["packages"][""]["version"] == package["version"]
