"""Columns in the units that the client asks for, with wide characters in front of names."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from lsprotocol import types as lsp

from tests.language_server.editor_client import Editor

pytestmark = pytest.mark.asyncio

LASER = "module M { /* 🤖é */ interface Laser { void stop(); }; };\n"
SIZES = {"utf-8": (6, "utf-8"), "utf-16": (3, "utf-16-le"), "utf-32": (2, "utf-32-le")}
"""Units that `🤖é` takes, and Python's name of the encoding."""
WIDTH = {"utf-8": 1, "utf-16": 2, "utf-32": 4}


def columns(encoding: str, text: str) -> int:
    return len(text.encode(SIZES[encoding][1])) // WIDTH[encoding]


def units(*encodings: str) -> Any:
    def change(capabilities: lsp.ClientCapabilities) -> None:
        capabilities.general = lsp.GeneralClientCapabilities(position_encodings=list(encodings))

    return change


@pytest.mark.parametrize("encoding", SIZES)
async def test_position_encoding_in_both_directions(
    start: Any, tmp_path: Path, encoding: str
) -> None:
    editor: Editor = await start(tmp_path, change=units(encoding, "utf-16"))
    assert editor.offered.position_encoding == encoding
    editor.write("Laser.idsl", LASER)
    head = 'import "Laser.idsl"; Component c { Communications { /* 🤖é */ requires '
    document = lsp.TextDocumentIdentifier(editor.open("c.cdsl", f"{head}Lasr; }}; }};\n"))
    (found,) = await editor.until("c.cdsl", bool)
    at = columns(encoding, head)
    assert found.range == lsp.Range(lsp.Position(0, at), lsp.Position(0, at + 4))
    insert = lsp.Range(lsp.Position(0, at + 3), lsp.Position(0, at + 3))
    editor.change("c.cdsl", lsp.TextDocumentContentChangePartial(insert, "e"))
    await editor.until("c.cdsl", lambda found: not found)
    place: dict[str, Any] = {"text_document": document, "position": lsp.Position(0, at + 2)}
    (where,) = (
        await editor.client.text_document_definition_async(lsp.DefinitionParams(**place)) or ()
    )
    assert isinstance(where, lsp.Location)
    declared = columns(encoding, LASER[: LASER.index("Laser")])
    assert where.range == lsp.Range(lsp.Position(0, declared), lsp.Position(0, declared + 5))
    edit = await editor.client.text_document_rename_async(
        lsp.RenameParams(new_name="Lidar", **place)
    )
    assert edit is not None
    starts = {
        uri: [edit.range.start.character for edit in e] for uri, e in (edit.changes or {}).items()
    }
    assert starts == {editor.uri("c.cdsl"): [at], editor.uri("Laser.idsl"): [declared]}
    tokens = await editor.client.text_document_semantic_tokens_full_async(
        lsp.SemanticTokensParams(document)
    )
    assert tokens is not None
    assert list(tokens.data[5:8]) == [0, at - columns(encoding, head[: head.index("c {")]), 5]


async def test_unknown_position_encoding_falls_back_to_utf_16(start: Any, tmp_path: Path) -> None:
    editor: Editor = await start(tmp_path, change=units("utf-7"))
    assert editor.offered.position_encoding == "utf-16"


@pytest.mark.parametrize(
    ("capabilities", "encoding"),
    [("visual-studio-code", "utf-16"), ("neovim", "utf-8"), ("emacs", "utf-32")],
)
async def test_position_encoding_of_real_editors(
    start: Any, tmp_path: Path, capabilities: str, encoding: str
) -> None:
    editor: Editor = await start(tmp_path, capabilities)
    assert editor.offered.position_encoding == encoding
