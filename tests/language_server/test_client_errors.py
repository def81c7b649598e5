"""Wrong positions, invalid edits, huge files: the server responds and continues."""

from __future__ import annotations

import asyncio
import json
import re
import subprocess
import sys

import pytest
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException, JsonRpcInvalidParams

from tests.language_server import project
from tests.language_server.editor_client import DEADLINE_S, SERVER, Editor
from tests.language_server.project import FILES

pytestmark = pytest.mark.asyncio


async def is_alive(editor: Editor) -> None:
    name = "alive.pdsl"
    editor.open(name, "ComponentParams a\n{\n    rate flaot 1;\n};\n")
    await editor.until(name, bool)


async def test_request_with_missing_line_is_invalid(editor: Editor) -> None:
    document = lsp.TextDocumentIdentifier(editor.open("app.ddsl", FILES["app.ddsl"]))
    place = lsp.Position(999, 0)
    with pytest.raises(JsonRpcInvalidParams, match="there is no line 999"):
        await editor.client.text_document_hover_async(lsp.HoverParams(document, place))
    with pytest.raises(JsonRpcInvalidParams, match="there is no line 999"):
        await editor.client.text_document_completion_async(lsp.CompletionParams(document, place))
    await is_alive(editor)


async def test_column_after_line_end_means_line_end(editor: Editor) -> None:
    document = lsp.TextDocumentIdentifier(editor.open("app.ddsl", FILES["app.ddsl"]))
    params = lsp.HoverParams(document, lsp.Position(2, 5000))
    found = await editor.client.text_document_hover_async(params)
    assert found is not None  # the name of the deployment ends the line


async def test_unsupported_documents_are_rejected(editor: Editor) -> None:
    editor.open("notes.txt", "hello")
    with pytest.raises(JsonRpcInvalidParams, match="is not a file of a supported language"):
        await editor.client.text_document_hover_async(
            lsp.HoverParams(lsp.TextDocumentIdentifier(editor.uri("notes.txt")), lsp.Position(0, 0))
        )
    with pytest.raises(JsonRpcInvalidParams, match="cannot read"):
        await editor.client.text_document_hover_async(
            lsp.HoverParams(lsp.TextDocumentIdentifier(editor.uri("no.idsl")), lsp.Position(0, 0))
        )
    editor.client.text_document_did_open(
        lsp.DidOpenTextDocumentParams(lsp.TextDocumentItem("untitled:a.idsl", "idsl", 0, "module"))
    )
    await is_alive(editor)


async def test_synchronize_applies_reversed_and_outside_edits(editor: Editor) -> None:
    editor.open("a.pdsl", "ComponentParams a\n{\n    rate flaot 1;\n};\n")
    await editor.until("a.pdsl", bool)
    turned = lsp.Range(lsp.Position(2, 14), lsp.Position(2, 9))
    behind = lsp.Range(lsp.Position(400, 3), lsp.Position(500, 9))
    partial = lsp.TextDocumentContentChangePartial
    editor.change("a.pdsl", partial(turned, "float"), partial(behind, "// the end\n"))
    await editor.until("a.pdsl", lambda found: not found)
    params = lsp.FoldingRangeParams(lsp.TextDocumentIdentifier(editor.uri("a.pdsl")))
    found = await editor.client.text_document_folding_range_async(params)
    assert [(entry.start_line, entry.end_line) for entry in found or ()] == [(1, 2)]


async def test_synchronize_ignores_change_of_closed_document(editor: Editor) -> None:
    editor.versions[editor.uri("a.pdsl")] = 0
    editor.replace("a.pdsl", "x")
    await is_alive(editor)


async def test_large_document_of_fifty_thousand_lines(editor: Editor) -> None:
    lines = "".join(f"    rate{number} float 1;\n" for number in range(50_000))
    text = f"ComponentParams a\n{{\n{lines}    last flaot 1;\n}};\n"
    editor.open("big.pdsl", text)
    (found,) = await editor.until("big.pdsl", bool)
    assert found.range.start == lsp.Position(50_002, 9)
    await is_alive(editor)


def many_lines(number: int) -> str:
    lines = "".join(f"    rate{each} float 1;\n" for each in range(number))
    return f"ComponentParams a\n{{\n{lines}    last flaot 1;\n}};\n"


BLOCKED_SERVER = """
import sys
from pathlib import Path
from robocomp_dsl.language_server import server
from robocomp_dsl.language_server.documents import background_check
from tests.support.waiting import wait_until
check, gate = background_check._check, Path(sys.argv[1])
def blocked(*arguments):
    wait_until(gate.exists, "the gate", 600)
    return check(*arguments)
background_check._check = blocked
server.serve_stdio()
"""


async def test_background_checker_does_not_block_other_requests(  # type: ignore[no-untyped-def]
    start, tmp_path, monkeypatch
) -> None:
    gate = tmp_path / "gate"
    monkeypatch.setitem(
        start.__globals__, "SERVER", [sys.executable, "-c", BLOCKED_SERVER, str(gate)]
    )
    editor = await start(tmp_path)
    project.write(editor)
    big = lsp.TextDocumentIdentifier(editor.open("big.pdsl", many_lines(50_000)))
    place = editor.at("app.ddsl", project.marked("app.ddsl", "eye"))
    assert await editor.client.text_document_hover_async(lsp.HoverParams(**place)) is not None
    assert editor.uri("big.pdsl") not in editor.client.diagnostics
    with pytest.raises(JsonRpcException, match=r"`big.pdsl` is still being checked") as refused:
        await editor.client.text_document_folding_range_async(lsp.FoldingRangeParams(big))
    assert refused.value.code == lsp.LSPErrorCodes.ContentModified
    symbols = await editor.client.workspace_symbol_async(lsp.WorkspaceSymbolParams("eye"))
    assert [symbol.name for symbol in symbols or ()] == ["eye"]
    gate.touch()
    await editor.until("big.pdsl", bool)
    at = lsp.HoverParams(big, lsp.Position(2, 6))
    hover = await editor.client.text_document_hover_async(at)
    assert hover is not None
    assert "rate0 float" in str(hover.contents)


async def test_background_checker_drops_results_of_changed_and_closed_documents(
    editor: Editor,
) -> None:
    editor.open("big.pdsl", many_lines(20_000))
    word = lsp.Range(lsp.Position(20_002, 9), lsp.Position(20_002, 14))
    editor.change("big.pdsl", lsp.TextDocumentContentChangePartial(word, "intt"))
    (found,) = await editor.until("big.pdsl", bool)
    assert "intt" in found.message
    editor.replace("big.pdsl", many_lines(20_001))
    editor.replace("big.pdsl", many_lines(1))
    (found,) = await editor.until("big.pdsl", lambda found: found and found[0].range.start.line < 9)
    editor.replace("big.pdsl", many_lines(20_002))
    editor.close("big.pdsl")
    await is_alive(editor)
    editor.open("big.pdsl", many_lines(20_003))
    await editor.until("big.pdsl", lambda found: found and found[0].range.start.line == 20_005)


async def test_crashing_feature_returns_internal_error(start, tmp_path, monkeypatch) -> None:  # type: ignore[no-untyped-def]
    crash = (
        "from robocomp_dsl.language_server import server as s\n"
        "from lsprotocol import types as lsp\n"
        "def crash(session, params): raise KeyError('oh')\n"
        "s.FEATURES[lsp.TEXT_DOCUMENT_HOVER] = (crash, None)\n"
        "s.serve_stdio()\n"
    )
    monkeypatch.setitem(start.__globals__, "SERVER", [sys.executable, "-c", crash])
    editor = await start(tmp_path)
    document = lsp.TextDocumentIdentifier(editor.open("app.ddsl", FILES["app.ddsl"]))
    with pytest.raises(JsonRpcException, match="internal error in textDocument/hover: KeyError"):
        await editor.client.text_document_hover_async(lsp.HoverParams(document, lsp.Position(0, 0)))
    await is_alive(editor)


async def test_requests_at_every_position_get_a_response(editor: Editor) -> None:
    project.write(editor)
    for name, text in FILES.items():
        document = lsp.TextDocumentIdentifier(editor.open(name, text[: len(text) * 2 // 3]))
        for line in range(text[: len(text) * 2 // 3].count("\n") + 1):
            place = {"text_document": document, "position": lsp.Position(line, 12)}
            await editor.client.text_document_hover_async(lsp.HoverParams(**place))
            await editor.client.text_document_completion_async(lsp.CompletionParams(**place))
            await editor.client.text_document_definition_async(lsp.DefinitionParams(**place))


async def test_server_exit_code_after_shutdown_is_0(start, tmp_path) -> None:  # type: ignore[no-untyped-def]
    editor = await start(tmp_path)
    await is_alive(editor)
    await editor.client.shutdown_async(None)
    editor.client.exit(None)
    async with asyncio.timeout(DEADLINE_S):
        assert await editor.client._server.wait() == 0


def frame(message: dict[str, object]) -> bytes:
    body = json.dumps({"jsonrpc": "2.0", **message}).encode()
    return b"Content-Length: %d\r\n\r\n%b" % (len(body), body)


async def test_tcp_server_serves_one_client_and_exits() -> None:
    command = [*SERVER, "--tcp", "0"]
    process = await asyncio.create_subprocess_exec(*command, stderr=subprocess.PIPE)
    try:
        async with asyncio.timeout(DEADLINE_S):
            assert process.stderr is not None
            line = b""
            while b"Serving on" not in line:
                line = await process.stderr.readline()
                assert line, "the server ended"
            port = int(re.findall(rb"\d+", line)[-1])
            reader, writer = await asyncio.open_connection("127.0.0.1", port)
            writer.write(frame({"id": 1, "method": "initialize", "params": {"capabilities": {}}}))
            header = await reader.readuntil(b"\r\n\r\n")
            size = int(header.lower().split(b"content-length:")[1].split(b"\r\n")[0])
            answer = json.loads(await reader.readexactly(size))
            assert answer["result"]["serverInfo"]["name"] == "rcgen"
            writer.write(frame({"id": 2, "method": "shutdown"}) + frame({"method": "exit"}))
            assert await process.wait() == 0
            writer.close()
    finally:
        if process.returncode is None:
            process.kill()
            await process.wait()
