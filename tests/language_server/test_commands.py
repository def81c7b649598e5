"""Commands: generation, and references."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams

from tests.language_server import project
from tests.language_server.editor_client import DEADLINE_S, Editor
from tests.language_server.project import FILES

pytestmark = pytest.mark.asyncio


async def execute(editor: Editor, command: str, *arguments: Any) -> Any:
    params = lsp.ExecuteCommandParams(command, list(arguments) or None)
    async with asyncio.timeout(DEADLINE_S):
        return await editor.client.workspace_execute_command_async(params)


async def lens(editor: Editor, name: str) -> lsp.Command:
    document = lsp.TextDocumentIdentifier(editor.open(name, FILES[name]))
    (lens_,) = await editor.client.text_document_code_lens_async(lsp.CodeLensParams(document)) or ()
    assert lens_.command is not None
    return lens_.command


async def test_generate_command(editor: Editor) -> None:
    project.write(editor)
    command = await lens(editor, "reader.cdsl")
    assert command.title == "generate component"
    assert (
        command.command
        in (editor.offered.execute_command_provider or lsp.ExecuteCommandOptions([])).commands
    )
    assert await execute(editor, command.command, *command.arguments or ()) is True
    assert (editor.folder / "main.py").is_file()
    assert "class SpecificWorker" in (editor.folder / "specificworker.py").read_text()
    (message,) = editor.client.messages
    assert message.type == lsp.MessageType.Info
    assert message.message.startswith("`reader.cdsl`: ")
    assert "specificworker.py" in message.message


async def test_generate_command_does_not_block_other_requests(editor: Editor) -> None:
    project.write(editor)
    command = await lens(editor, "reader.cdsl")
    generating = asyncio.ensure_future(execute(editor, command.command, *command.arguments or ()))
    document = lsp.TextDocumentIdentifier(editor.uri("reader.cdsl"))
    found = await editor.client.text_document_hover_async(
        lsp.HoverParams(document, lsp.Position(2, 12))
    )
    assert found is not None
    assert not generating.done()
    assert await generating is True


async def test_generate_command_reports_errors_with_location(editor: Editor) -> None:
    project.write(editor)
    broken = FILES["reader.cdsl"].replace("requires Laser", "requires Lasr")
    editor.write("reader.cdsl", broken)
    uri = editor.open("reader.cdsl", broken)
    assert await execute(editor, "rcgen.generate", uri) is False
    (message,) = editor.client.messages
    assert message.type == lsp.MessageType.Error
    assert "reader.cdsl:5:31: error[RC204]" in message.message
    assert not (editor.folder / "main.py").exists()


async def test_generate_command_requires_saved_files(editor: Editor) -> None:
    project.write(editor)
    uri = editor.open("reader.cdsl", FILES["reader.cdsl"])
    editor.open("Laser.idsl", FILES["Laser.idsl"] + "// more\n")
    assert await execute(editor, "rcgen.generate", uri) is False
    (message,) = editor.client.messages
    assert message.message == "nothing was generated: save `Laser.idsl` first"


@pytest.mark.parametrize(
    ("command", "arguments", "why"),
    [
        ("rcgen.generate", [], "takes the URI of a CDSL or BDSL file"),
        ("rcgen.generate", [7], "takes the URI of a CDSL or BDSL file"),
        ("rcgen.generate", ["file:///a.idsl"], "is not a component"),
        ("rcgen.generate", ["file:///nowhere/a.cdsl"], "cannot read `a.cdsl`"),
        ("rcgen.generate", ["untitled:a.cdsl"], "is not a file of a supported language"),
        ("rcgen.showReferences", ["file:///a.idsl"], "a list of locations"),
        ("rcgen.showReferences", ["a", 1, [{"uri": 3}]], "a list of locations"),
    ],
)
async def test_commands_reject_wrong_arguments(
    editor: Editor, command: str, arguments: list[Any], why: str
) -> None:
    with pytest.raises(JsonRpcInvalidParams, match=why):
        await execute(editor, command, *arguments)
    with pytest.raises(JsonRpcInvalidParams, match="not defined"):
        await execute(editor, "rcgen.nothing")


async def test_show_references_lists_locations(editor: Editor) -> None:
    project.write(editor)
    command = await lens(editor, "Laser.idsl")
    await execute(editor, command.command, *command.arguments or ())
    (message,) = editor.client.messages
    names = sorted(Path(line).name for line in message.message.splitlines())
    assert names == ["base.cdsl:5", "reader.cdsl:5"]


async def test_show_references_opens_single_location(editor: Editor) -> None:
    project.write(editor)
    command = await lens(editor, "Laser.idsl")
    uri, position, places = command.arguments or ()
    await execute(editor, command.command, uri, position, places[:1])
    async with asyncio.timeout(DEADLINE_S):
        while not editor.client.shown_documents:
            await asyncio.sleep(0)
    (shown,) = editor.client.shown_documents
    assert shown.uri == places[0]["uri"]
