"""Diagnostics as the user types, also those of other open files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from lsprotocol import types as lsp
from pytest_lsp import LanguageClient

from tests.language_server.editor_client import Editor

LASER = "module Scans\n{\n    interface Laser\n    {\n        float range();\n    };\n};\n"
COMPONENT = """import "Laser.idsl";
Component reader
{
    Communications { requires Laser; };
    language Python;
};
"""
pytestmark = pytest.mark.asyncio


def codes(found: list[lsp.Diagnostic]) -> list[object]:
    return [item.code for item in found]


async def test_diagnostic_appears_at_error_and_disappears(editor: Editor) -> None:
    editor.write("Laser.idsl", LASER)
    editor.open("reader.cdsl", COMPONENT.replace("requires Laser", "requires Lasr"))
    (found,) = await editor.until("reader.cdsl", bool)
    assert found.code == "RC204"
    assert found.severity == lsp.DiagnosticSeverity.Error
    assert found.source == "rcgen"
    assert "did you mean `Laser`?" in found.message
    assert found.range == lsp.Range(lsp.Position(3, 30), lsp.Position(3, 34))
    editor.replace("reader.cdsl", COMPONENT)
    assert await editor.until("reader.cdsl", lambda found: not found) == []


async def test_diagnostic_columns_count_utf16_units(editor: Editor) -> None:
    editor.write("Laser.idsl", LASER)
    line = "    Communications { /* 🤖🤖 */ requires Lasr; };"
    editor.open("reader.cdsl", COMPONENT.replace("    Communications { requires Laser; };", line))
    (found,) = await editor.until("reader.cdsl", bool)
    assert found.range.start.character == line.index("Lasr") + 2


async def test_scheduler_rechecks_dependants_of_unsaved_interface(editor: Editor) -> None:
    editor.write("Laser.idsl", LASER)
    editor.open("reader.cdsl", COMPONENT)
    await editor.until("reader.cdsl", lambda found: not found)
    editor.open("Laser.idsl", LASER)
    editor.replace("Laser.idsl", LASER.replace("interface Laser", "interface Lidar"))
    assert codes(await editor.until("reader.cdsl", bool)) == ["RC204"]
    editor.close("Laser.idsl")
    await editor.until("reader.cdsl", lambda found: not found)


async def test_unsaved_new_file_resolves_import(editor: Editor) -> None:
    editor.open("reader.cdsl", COMPONENT.replace("Laser", "Mine"))
    assert "RC201" in codes(await editor.until("reader.cdsl", bool))
    editor.open("Mine.idsl", LASER.replace("Laser", "Mine"))
    await editor.until("reader.cdsl", lambda found: not found)


async def test_errors_in_imported_file_are_reported_at_import(editor: Editor) -> None:
    editor.write("Laser.idsl", LASER.replace("float range", "floot range"))
    editor.open("reader.cdsl", COMPONENT)
    (found,) = await editor.until("reader.cdsl", bool)
    assert found.range.start.line == 0
    assert found.message.startswith("`Laser.idsl` has errors: unknown type `floot`")
    (related,) = found.related_information or ()
    assert related.location.uri == editor.uri("Laser.idsl")


async def test_synchronize_applies_incremental_changes_in_order(editor: Editor) -> None:
    editor.write("Laser.idsl", LASER)
    editor.open("reader.cdsl", COMPONENT)
    await editor.until("reader.cdsl", lambda found: not found)
    cut = lsp.Range(lsp.Position(3, 30), lsp.Position(3, 35))
    put = lsp.Range(lsp.Position(3, 30), lsp.Position(3, 30))
    editor.change(
        "reader.cdsl",
        lsp.TextDocumentContentChangePartial(cut, ""),
        lsp.TextDocumentContentChangePartial(put, "Lase"),
    )
    (found,) = await editor.until("reader.cdsl", bool)
    assert "`Lase`" in found.message


@pytest.mark.parametrize("capabilities", ["visual-studio-code", "neovim", "emacs"])
async def test_diagnostics_for_every_client(start, tmp_path, capabilities) -> None:  # type: ignore[no-untyped-def]
    editor = await start(tmp_path, capabilities)
    editor.open("a.pdsl", "ComponentParams a\n{\n    rate flaot 1;\n};\n")
    (found,) = await editor.until("a.pdsl", bool)
    assert found.range.start == lsp.Position(2, 9)


async def test_diagnostics_of_innermodel(editor: Editor) -> None:
    editor.open("robot.xml", '<innerModel>\n  <transform id="a" id="b"/>\n</innerModel>\n')
    found = await editor.until("robot.xml", bool)
    assert any(item.range.start.line == 1 for item in found)


async def test_scheduler_rechecks_after_change_on_disk(editor: Editor) -> None:
    editor.write("Laser.idsl", LASER)
    editor.open("reader.cdsl", COMPONENT)
    await editor.until("reader.cdsl", lambda found: not found)
    change = lsp.FileChangeType
    for kind, text in ((change.Changed, LASER.replace("interface Laser", "interface Lidar")),
                       (change.Created, LASER)):  # fmt: skip
        editor.write("Laser.idsl", text)
        event = lsp.FileEvent(editor.uri("Laser.idsl"), kind)
        editor.client.workspace_did_change_watched_files(lsp.DidChangeWatchedFilesParams([event]))
        await editor.until("reader.cdsl", lambda found, text=text: bool(found) is (text != LASER))


async def test_scheduler_rechecks_after_delete_and_rename(editor: Editor) -> None:
    editor.write("Mine.idsl", LASER.replace("Laser", "Mine"))
    editor.open("reader.cdsl", COMPONENT.replace("Laser", "Mine"))
    await editor.until("reader.cdsl", lambda found: not found)
    home = editor.folder
    (home / "Mine.idsl").rename(home / "Other.idsl")
    renamed = lsp.FileRename(editor.uri("Mine.idsl"), editor.uri("Other.idsl"))
    editor.client.workspace_did_rename_files(lsp.RenameFilesParams([renamed]))
    assert "RC201" in codes(await editor.until("reader.cdsl", bool))
    (home / "Other.idsl").rename(home / "Mine.idsl")
    editor.client.workspace_did_create_files(
        lsp.CreateFilesParams([lsp.FileCreate(editor.uri("Mine.idsl"))])
    )
    await editor.until("reader.cdsl", lambda found: not found)
    (home / "Mine.idsl").unlink()
    editor.client.workspace_did_delete_files(
        lsp.DeleteFilesParams([lsp.FileDelete(editor.uri("Mine.idsl"))])
    )
    assert "RC201" in codes(await editor.until("reader.cdsl", bool))


@pytest.mark.parametrize(
    ("capabilities", "asked"), [("visual-studio-code", True), ("neovim", False), ("emacs", True)]
)
async def test_file_watching_is_registered_with_capable_clients(
    start: Any, tmp_path: Path, capabilities: str, asked: bool
) -> None:
    registered: list[lsp.Registration] = []

    def listen(client: LanguageClient) -> None:
        @client.feature(lsp.CLIENT_REGISTER_CAPABILITY)
        def register(params: lsp.RegistrationParams) -> None:
            registered.extend(params.registrations)

    editor = await start(tmp_path, capabilities, listen=listen)
    editor.open("a.pdsl", "ComponentParams a\n{\n    rate flaot 1;\n};\n")
    await editor.until("a.pdsl", bool)
    globs = [
        watcher["globPattern"]
        for item in registered
        for watcher in item.register_options["watchers"]
    ]
    assert ("**/*.cdsl" in globs) is asked
