"""Symbols, semantic tokens, folding, inlay hints and code lenses of a file."""

from __future__ import annotations

import pytest
from lsprotocol import types as lsp

from tests.language_server import project
from tests.language_server.editor_client import Editor
from tests.language_server.project import FILES

pytestmark = pytest.mark.asyncio


def opened(editor: Editor, name: str, text: str | None = None) -> lsp.TextDocumentIdentifier:
    return lsp.TextDocumentIdentifier(editor.open(name, FILES[name] if text is None else text))


def tree(symbols: object, depth: int = 0) -> list[str]:
    assert isinstance(symbols, list | tuple)
    lines = []
    for symbol in symbols:
        lines.append(f"{'  ' * depth}{symbol.name} {symbol.kind.name} {symbol.detail}".rstrip())
        lines += tree(symbol.children or [], depth + 1)
    return lines


async def test_document_symbols(editor: Editor) -> None:
    project.write(editor)
    params = lsp.DocumentSymbolParams(opened(editor, "app.ddsl"))
    found = await editor.client.text_document_document_symbol_async(params)
    assert tree(found) == [
        "app Package",
        "  base Object",
        "  eye Object reader",
        "  eye.Laser → base.Laser Event",
    ]
    params = lsp.DocumentSymbolParams(opened(editor, "Laser.idsl"))
    lines = tree(await editor.client.text_document_document_symbol_async(params))
    assert lines[0] == "Scans Module"
    assert "    dist Field float" in lines
    assert lines[-4:] == [
        "  Laser Interface",
        "    scan Method Scan",
        "    stop Method void",
        "    hint Method void",
    ]


async def test_document_symbols_of_incomplete_file(editor: Editor) -> None:
    text = FILES["Laser.idsl"].replace("Mode mode = Fast; };", "Mode mo")
    params = lsp.DocumentSymbolParams(opened(editor, "Laser.idsl", text))
    lines = tree(await editor.client.text_document_document_symbol_async(params))
    assert "  Mode Enum" in lines
    assert "  Beam Struct" in lines


async def test_workspace_symbols(editor: Editor) -> None:
    project.write(editor)
    for query, expected in (("lsr", ["Laser"]), ("eye", ["eye"]), ("zzz", [])):
        found = await editor.client.workspace_symbol_async(lsp.WorkspaceSymbolParams(query))
        assert [symbol.name for symbol in found or ()] == expected


async def test_semantic_tokens(editor: Editor) -> None:
    project.write(editor)
    text = FILES["app.ddsl"].replace("    connect", "    /* 🤖 */ connect")
    params = lsp.SemanticTokensParams(opened(editor, "app.ddsl", text))
    found = await editor.client.text_document_semantic_tokens_full_async(params)
    assert found is not None
    provider = editor.legend
    line = column = 0
    seen = []
    for at in range(0, len(found.data), 5):
        down, right, length, kind, declared = found.data[at : at + 5]
        line, column = line + down, right + (0 if down else column)
        units = text.splitlines()[line].encode("utf-16-le")
        word = units[2 * column : 2 * (column + length)].decode("utf-16-le")
        seen.append((word, provider[kind], declared))
    assert seen == [
        ("app", "class", 1),
        ("base", "variable", 1),
        ("eye", "variable", 1),
        ("reader", "class", 0),
        ("base", "variable", 0),
        ("rate", "parameter", 0),
        ("pid", "parameter", 0),
        ("gain", "parameter", 0),
        ("eye", "variable", 0),
        ("Laser", "interface", 0),
        ("base", "variable", 0),
        ("Laser", "interface", 0),
    ]


async def test_semantic_tokens_in_range(editor: Editor) -> None:
    project.write(editor)
    document = opened(editor, "app.ddsl")
    lines = lsp.Range(lsp.Position(6, 0), lsp.Position(7, 0))
    params = lsp.SemanticTokensRangeParams(document, lines)
    found = await editor.client.text_document_semantic_tokens_range_async(params)
    assert found is not None
    assert list(found.data[:3]) == [6, 12, 3]  # `eye` of `connect eye.Laser -> base.Laser`
    assert len(found.data) == 5 * 4


async def test_folding(editor: Editor) -> None:
    text = FILES["app.ddsl"].replace("Deployment", "/* one\n   two */\nDeployment")
    params = lsp.FoldingRangeParams(opened(editor, "app.ddsl", text))
    found = await editor.client.text_document_folding_range_async(params)
    assert sorted((f.start_line, f.end_line, f.kind) for f in found or ()) == [
        (0, 1, lsp.FoldingRangeKind.Imports),
        (2, 3, lsp.FoldingRangeKind.Comment),
        (5, 8, None),
    ]


def labels(hints: object) -> list[tuple[int, object]]:
    assert isinstance(hints, list | tuple)
    return [(hint.position.line, hint.label) for hint in hints]


async def test_inlay_hints(editor: Editor) -> None:
    project.write(editor)
    everything = lsp.Range(lsp.Position(0, 0), lsp.Position(8, 0))
    text = FILES["app.ddsl"].replace("    connect eye.Laser -> base.Laser;\n", "\n")
    params = lsp.InlayHintParams(opened(editor, "app.ddsl", text), everything)
    found = await editor.client.text_document_inlay_hint_async(params)
    assert labels(found) == [(5, "Laser → base.Laser")]
    document = opened(editor, "Laser.idsl")
    whole = lsp.Range(lsp.Position(0, 0), lsp.Position(16, 0))
    found = await editor.client.text_document_inlay_hint_async(lsp.InlayHintParams(document, whole))
    assert labels(found) == [(12, "[query]"), (14, "[query | publish]")]


async def test_code_lens(editor: Editor) -> None:
    project.write(editor)
    params = lsp.CodeLensParams(opened(editor, "Laser.idsl"))
    (found,) = await editor.client.text_document_code_lens_async(params) or ()
    assert found.command is not None
    assert found.command.title == "1 component implements this, 1 component requires this"
    assert found.range.start.line == 9
    assert found.command.command == "rcgen.showReferences"
    uri, _, places = found.command.arguments or ()
    assert uri == editor.uri("Laser.idsl")
    names = {place["uri"].rpartition("/")[2] for place in places}
    assert names == {"base.cdsl", "reader.cdsl"}
