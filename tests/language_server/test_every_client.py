"""Every feature with the capabilities of VS Code, Neovim and Emacs."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

import pytest
from lsprotocol import types as lsp

from tests.language_server import project
from tests.language_server.editor_client import Editor
from tests.language_server.project import FILES, marked

pytestmark = pytest.mark.asyncio

CLIENTS = ("visual-studio-code", "neovim", "emacs")

Check = Callable[[Editor], Awaitable[object]]
CHECKS: dict[str, Check] = {}
"""Method of the protocol to what asks for it; the answer must be true."""


def feature(method: str) -> Callable[[Check], Check]:
    def register(check: Check) -> Check:
        CHECKS[method] = check
        return check

    return register


def document(editor: Editor, name: str) -> lsp.TextDocumentIdentifier:
    return lsp.TextDocumentIdentifier(editor.uri(name))


def at(editor: Editor, name: str, word: str) -> dict[str, Any]:
    return editor.place(name, marked(name, word))


WHOLE_RANGE = lsp.Range(lsp.Position(0, 0), lsp.Position(8, 0))


@feature(lsp.TEXT_DOCUMENT_HOVER)
async def hover(editor: Editor) -> object:
    params = lsp.HoverParams(**at(editor, "app.ddsl", "eye"))
    found = await editor.client.text_document_hover_async(params)
    assert found is not None
    assert isinstance(found.contents, lsp.MarkupContent)
    assert "component eye : reader" in found.contents.value
    text = 'import "Laser.idsl"; Component m { Communications { requires Laser(z|enoh); }; };'
    params = lsp.HoverParams(**editor.at("marked.cdsl", text))
    found = await editor.client.text_document_hover_async(params)
    editor.close("marked.cdsl")
    assert found is not None
    assert isinstance(found.contents, lsp.MarkupContent)
    return "**zenoh**: " in found.contents.value


@feature(lsp.TEXT_DOCUMENT_COMPLETION)
async def completion(editor: Editor) -> object:
    params = lsp.CompletionParams(**at(editor, "app.ddsl", "base.Laser"))
    found = await editor.client.text_document_completion_async(params)
    assert isinstance(found, list | tuple)
    assert {entry.label for entry in found} == {"base", "eye"}
    text = 'import "Laser.idsl"; Component m { Communications { requires Laser(|'
    params = lsp.CompletionParams(**editor.at("marked.cdsl", text))
    middlewares = await editor.client.text_document_completion_async(params)
    editor.close("marked.cdsl")
    assert isinstance(middlewares, list | tuple)
    assert "zenoh" in {entry.label for entry in middlewares if entry.detail}
    return not any(
        entry.insert_text_format == lsp.InsertTextFormat.Snippet for entry in (*found, *middlewares)
    )


@feature(lsp.TEXT_DOCUMENT_SIGNATURE_HELP)
async def signature_help(editor: Editor) -> object:
    text = "Bridge b { function half(double x [m]) -> double [m]; hub h = half(|1); };"
    params = lsp.SignatureHelpParams(**editor.at("half.bdsl", text))
    found = await editor.client.text_document_signature_help_async(params)
    editor.close("half.bdsl")
    assert found is not None
    return found.signatures[0].label == "function half(double x [m]) -> double [m];"


@feature(lsp.TEXT_DOCUMENT_DEFINITION)
async def definition(editor: Editor) -> object:
    params = lsp.DefinitionParams(**at(editor, "app.ddsl", "reader {"))
    (found,) = await editor.client.text_document_definition_async(params) or ()
    return isinstance(found, lsp.Location) and found.uri == editor.uri("reader.cdsl")


@feature(lsp.TEXT_DOCUMENT_TYPE_DEFINITION)
async def type_definition(editor: Editor) -> object:
    params = lsp.TypeDefinitionParams(**at(editor, "Laser.idsl", "mode"))
    (found,) = await editor.client.text_document_type_definition_async(params) or ()
    return isinstance(found, lsp.Location) and found.range.start.line == 3


@feature(lsp.TEXT_DOCUMENT_REFERENCES)
async def references(editor: Editor) -> object:
    context = lsp.ReferenceContext(include_declaration=True)
    params = lsp.ReferenceParams(context, **at(editor, "Laser.idsl", "Laser"))
    return len(await editor.client.text_document_references_async(params) or ()) == 5


@feature(lsp.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT)
async def highlights(editor: Editor) -> object:
    params = lsp.DocumentHighlightParams(**at(editor, "app.ddsl", "eye"))
    return len(await editor.client.text_document_document_highlight_async(params) or ()) == 2


@feature(lsp.TEXT_DOCUMENT_PREPARE_RENAME)
async def prepare_rename(editor: Editor) -> object:
    params = lsp.PrepareRenameParams(**at(editor, "app.ddsl", "eye"))
    found = await editor.client.text_document_prepare_rename_async(params)
    return isinstance(found, lsp.PrepareRenamePlaceholder) and found.placeholder == "eye"


@feature(lsp.TEXT_DOCUMENT_RENAME)
async def rename(editor: Editor) -> object:
    params = lsp.RenameParams(new_name="Lidar", **at(editor, "Laser.idsl", "Laser"))
    found = await editor.client.text_document_rename_async(params)
    assert found is not None
    return len(found.changes or {}) == 4


@feature(lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
async def document_symbols(editor: Editor) -> object:
    params = lsp.DocumentSymbolParams(document(editor, "app.ddsl"))
    (found,) = await editor.client.text_document_document_symbol_async(params) or ()
    return isinstance(found, lsp.DocumentSymbol) and len(found.children or ()) == 3


@feature(lsp.WORKSPACE_SYMBOL)
async def workspace_symbols(editor: Editor) -> object:
    found = await editor.client.workspace_symbol_async(lsp.WorkspaceSymbolParams("Beam"))
    return [entry.name for entry in found or ()] == ["Beam"]


@feature(lsp.TEXT_DOCUMENT_FORMATTING)
async def formatting(editor: Editor) -> object:
    editor.open("wild.pdsl", "ComponentParams wild {\nrate   float 1;\n};\n")
    options = lsp.FormattingOptions(tab_size=4, insert_spaces=True)
    params = lsp.DocumentFormattingParams(document(editor, "wild.pdsl"), options)
    found = await editor.client.text_document_formatting_async(params)
    editor.close("wild.pdsl")
    return found


@feature(lsp.TEXT_DOCUMENT_CODE_ACTION)
async def code_actions(editor: Editor) -> object:
    text = FILES["base.cdsl"].replace("implements Laser", "implements Lasr")
    editor.replace("base.cdsl", text)
    (wrong,) = await editor.until("base.cdsl", bool)
    context = lsp.CodeActionContext([wrong], only=[lsp.CodeActionKind.QuickFix])
    params = lsp.CodeActionParams(document(editor, "base.cdsl"), wrong.range, context)
    found = await editor.client.text_document_code_action_async(params)
    editor.replace("base.cdsl", FILES["base.cdsl"])
    await editor.until("base.cdsl", lambda found: not found)
    return [entry.title for entry in found or ()] == ["Change to `Laser`"]


@feature(lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL)
async def semantic_tokens(editor: Editor) -> object:
    params = lsp.SemanticTokensParams(document(editor, "app.ddsl"))
    found = await editor.client.text_document_semantic_tokens_full_async(params)
    return found is not None and len(found.data) == 12 * 5


@feature(lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_RANGE)
async def tokens_in_range(editor: Editor) -> object:
    params = lsp.SemanticTokensRangeParams(
        document(editor, "app.ddsl"), lsp.Range(lsp.Position(6, 0), lsp.Position(7, 0))
    )
    found = await editor.client.text_document_semantic_tokens_range_async(params)
    return found is not None and len(found.data) == 4 * 5


@feature(lsp.TEXT_DOCUMENT_FOLDING_RANGE)
async def folding(editor: Editor) -> object:
    params = lsp.FoldingRangeParams(document(editor, "app.ddsl"))
    found = await editor.client.text_document_folding_range_async(params)
    return {(entry.start_line, entry.end_line) for entry in found or ()} == {(0, 1), (3, 6)}


@feature(lsp.TEXT_DOCUMENT_DOCUMENT_LINK)
async def links(editor: Editor) -> object:
    params = lsp.DocumentLinkParams(document(editor, "app.ddsl"))
    found = await editor.client.text_document_document_link_async(params)
    targets = [entry.target for entry in found or ()]
    return targets == [editor.uri("reader.cdsl"), editor.uri("base.cdsl")]


@feature(lsp.TEXT_DOCUMENT_INLAY_HINT)
async def inlay_hints(editor: Editor) -> object:
    whole = lsp.Range(lsp.Position(0, 0), lsp.Position(16, 0))
    params = lsp.InlayHintParams(document(editor, "Laser.idsl"), whole)
    found = await editor.client.text_document_inlay_hint_async(params)
    return [entry.label for entry in found or ()] == ["[query]", "[query | publish]"]


@feature(lsp.TEXT_DOCUMENT_CODE_LENS)
async def code_lens(editor: Editor) -> object:
    params = lsp.CodeLensParams(document(editor, "base.cdsl"))
    (found,) = await editor.client.text_document_code_lens_async(params) or ()
    return found.command is not None and found.command.command == "rcgen.generate"


@feature(lsp.WORKSPACE_EXECUTE_COMMAND)
async def command(editor: Editor) -> object:
    params = lsp.ExecuteCommandParams("rcgen.generate", [editor.uri("base.cdsl")])
    done = await editor.client.workspace_execute_command_async(params)
    return done is True and "`base.cdsl`" in editor.client.messages[-1].message


@feature(lsp.TEXT_DOCUMENT_PREPARE_CALL_HIERARCHY)
async def call_hierarchy(editor: Editor) -> object:
    params = lsp.CallHierarchyPrepareParams(**at(editor, "app.ddsl", "eye"))
    (item,) = await editor.client.text_document_prepare_call_hierarchy_async(params) or ()
    outgoing = await editor.client.call_hierarchy_outgoing_calls_async(
        lsp.CallHierarchyOutgoingCallsParams(item)
    )
    (base,) = [entry.to for entry in outgoing or ()]
    incoming = await editor.client.call_hierarchy_incoming_calls_async(
        lsp.CallHierarchyIncomingCallsParams(base)
    )
    return [entry.from_.name for entry in incoming or ()] == ["eye"]


@pytest.mark.parametrize("client", CLIENTS)
async def test_server_features_work_with_every_client(
    start: Any, tmp_path: Path, client: str
) -> None:
    editor: Editor = await start(tmp_path, client)
    project.write(editor)
    for name, text in FILES.items():
        editor.open(name, text)
        assert await editor.until(name, lambda found: not found) == []
    for method, check in CHECKS.items():
        assert await check(editor), method


async def test_server_features_all_have_a_check() -> None:
    from robocomp_dsl.language_server.server import FEATURES  # noqa: PLC0415 - the table itself

    tested_elsewhere = {
        lsp.CALL_HIERARCHY_INCOMING_CALLS,
        lsp.CALL_HIERARCHY_OUTGOING_CALLS,
        lsp.TEXT_DOCUMENT_RANGE_FORMATTING,
    }
    assert FEATURES.keys() - tested_elsewhere == CHECKS.keys() - {lsp.WORKSPACE_EXECUTE_COMMAND}
