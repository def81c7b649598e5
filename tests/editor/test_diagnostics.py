"""Diagnostics as the user types, also those of other open files."""

from __future__ import annotations

import pytest
from editor_client import Editor
from lsprotocol import types as lsp

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
    return [one.code for one in found]


async def test_mistake_is_shown_in_place_and_goes_away(editor: Editor) -> None:
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


async def test_columns_count_utf16_units(editor: Editor) -> None:
    editor.write("Laser.idsl", LASER)
    line = "    Communications { /* 🤖🤖 */ requires Lasr; };"
    editor.open("reader.cdsl", COMPONENT.replace("    Communications { requires Laser; };", line))
    (found,) = await editor.until("reader.cdsl", bool)
    assert found.range.start.character == line.index("Lasr") + 2


async def test_unsaved_interface_wins_and_its_users_are_checked_again(editor: Editor) -> None:
    editor.write("Laser.idsl", LASER)
    editor.open("reader.cdsl", COMPONENT)
    await editor.until("reader.cdsl", lambda found: not found)
    editor.open("Laser.idsl", LASER)
    editor.replace("Laser.idsl", LASER.replace("interface Laser", "interface Lidar"))
    assert codes(await editor.until("reader.cdsl", bool)) == ["RC204"]
    editor.close("Laser.idsl")
    await editor.until("reader.cdsl", lambda found: not found)


async def test_file_that_appears_only_in_the_editor(editor: Editor) -> None:
    editor.open("reader.cdsl", COMPONENT.replace("Laser", "Mine"))
    assert "RC201" in codes(await editor.until("reader.cdsl", bool))
    editor.open("Mine.idsl", LASER.replace("Laser", "Mine"))
    await editor.until("reader.cdsl", lambda found: not found)


async def test_errors_behind_an_import_are_told_at_the_import(editor: Editor) -> None:
    editor.write("Laser.idsl", LASER.replace("float range", "floot range"))
    editor.open("reader.cdsl", COMPONENT)
    (found,) = await editor.until("reader.cdsl", bool)
    assert found.range.start.line == 0
    assert found.message.startswith("`Laser.idsl` has errors: there is no type `floot`")
    (related,) = found.related_information or ()
    assert related.location.uri == editor.uri("Laser.idsl")


async def test_incremental_changes_are_applied_in_order(editor: Editor) -> None:
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
async def test_every_client_gets_them(start, tmp_path, capabilities) -> None:  # type: ignore[no-untyped-def]
    editor = await start(tmp_path, capabilities)
    editor.open("a.pdsl", "ComponentParams a\n{\n    rate flaot 1;\n};\n")
    (found,) = await editor.until("a.pdsl", bool)
    assert found.range.start == lsp.Position(2, 9)


async def test_innermodel(editor: Editor) -> None:
    editor.open("robot.xml", '<innerModel>\n  <transform id="a" id="b"/>\n</innerModel>\n')
    found = await editor.until("robot.xml", bool)
    assert any(one.range.start.line == 1 for one in found)
