"""Definitions of YARP in an editor: definition, hover, completion, findings, rename, outline."""

from __future__ import annotations

from pathlib import Path

import pytest
from lsprotocol import types as lsp
from pygls.uris import to_fs_path

from tests.language_server.editor_client import Editor

pytestmark = pytest.mark.asyncio

LIMITS = """struct Limits { 1: double max }
typedef double Speed
"""
MOTOR = """include "idl/limits.thrift"

/** What it measures. */
struct Status {
  1: double angle,  // [deg]
  2: list<limits.Limits> limits
  3: list<limits.Limits> others
}

service Base { limits.Speed speed() }
service Motor extends Base {
  /** Reads it. */
  Status get_status(1: list<double> path);
}
"""
GAZE = "# A gaze.\n\n(float64 angle [deg])\n(target (float64 x [m]))\n"
DEMO = """import "motor.thrift";
import "gaze.bottle";
module Demo
{
    struct Both { motor::Status status; gaze::gaze gaze; Limits limits; };
};
"""


def write_definitions(editor: Editor) -> None:
    editor.write("idl/limits.thrift", LIMITS)
    editor.write("motor.thrift", MOTOR)
    editor.write("gaze.bottle", GAZE)
    editor.open("Demo.idsl", DEMO)


def place(editor: Editor, name: str, text: str, part: str) -> dict[str, object]:
    """The document and the position behind the first character of `part` in a text."""
    index = text.index(part) + 1
    line = text[:index].count("\n")
    column = index - (text[:index].rfind("\n") + 1)
    document = lsp.TextDocumentIdentifier(editor.uri(name))
    return {"text_document": document, "position": lsp.Position(line, column)}


async def definition_of(editor: Editor, name: str, text: str, part: str) -> tuple[str, int]:
    params = lsp.DefinitionParams(**place(editor, name, text, part))  # type: ignore[arg-type]
    found = await editor.client.text_document_definition_async(params)
    assert isinstance(found, list)
    (location,) = found
    return Path(to_fs_path(location.uri) or "").name, location.range.start.line


async def hover_at(editor: Editor, name: str, text: str, part: str) -> str:
    params = lsp.HoverParams(**place(editor, name, text, part))  # type: ignore[arg-type]
    found = await editor.client.text_document_hover_async(params)
    assert found
    assert isinstance(found.contents, lsp.MarkupContent)
    return found.contents.value


async def test_definition_opens_yarp_definition(editor: Editor) -> None:
    write_definitions(editor)
    assert await definition_of(editor, "Demo.idsl", DEMO, "motor.thrift") == ("motor.thrift", 0)
    assert await definition_of(editor, "Demo.idsl", DEMO, "Status status") == ("motor.thrift", 3)
    assert await definition_of(editor, "Demo.idsl", DEMO, "gaze gaze") == ("gaze.bottle", 0)
    assert await definition_of(editor, "Demo.idsl", DEMO, "Limits limits") == ("limits.thrift", 0)


async def test_definition_inside_thrift_file(editor: Editor) -> None:
    write_definitions(editor)
    editor.open("motor.thrift", MOTOR)
    for part, expected in (
        ("idl/limits", ("limits.thrift", 0)),
        ("Limits> limits", ("limits.thrift", 0)),
        ("list<limits.Limits> others", ("motor.thrift", 5)),
        ("Base {\n  /**", ("motor.thrift", 9)),
        ("Speed speed", ("limits.thrift", 1)),
        ("Status get", ("motor.thrift", 3)),
    ):
        assert await definition_of(editor, "motor.thrift", MOTOR, part) == expected, part


async def test_hover_shows_yarp_definition(editor: Editor) -> None:
    write_definitions(editor)
    editor.open("motor.thrift", MOTOR)
    shown = await hover_at(editor, "Demo.idsl", DEMO, "Status status")
    for text in ("struct motor::Status", "double angle [deg];", "What it measures."):
        assert text in shown
    assert "double angle [deg];" in await hover_at(editor, "Demo.idsl", DEMO, "gaze gaze")
    assert "typedef double Speed;" in await hover_at(editor, "motor.thrift", MOTOR, "Speed speed")
    shown = await hover_at(editor, "motor.thrift", MOTOR, "Motor extends")
    assert "double speed();" in shown
    assert "motor::Status get_status(motor::ListOfDouble path);" in shown
    shown = await hover_at(editor, "motor.thrift", MOTOR, "list<limits.Limits> others")
    assert "sequence<limits::Limits> motor::ListOfLimits;" in shown


async def test_completion_offers_yarp_definitions_and_types(editor: Editor) -> None:
    write_definitions(editor)
    for name, text, expected, other in (
        ("a.idsl", 'import "|', {"motor.thrift", "gaze.bottle"}, "limits.thrift"),
        ("a.cdsl", 'import "|', {"motor.thrift"}, "gaze.bottle"),
        ("b.idsl", 'import "motor.thrift";\nmodule M { struct S { motor::| }; };\n',
         {"Status", "ListOfLimits"}, "Limits"),
        ("b.cdsl", 'import "motor.thrift";\nComponent x { Communications { implements | }; };\n',
         {"Motor", "Base"}, "Status"),
    ):  # fmt: skip
        params = lsp.CompletionParams(**editor.at(name, text))
        found = await editor.client.text_document_completion_async(params)
        assert isinstance(found, list)
        labels = {item.label for item in found}
        assert expected <= labels
        assert other not in labels


async def test_yarp_symbol_is_not_renamed(editor: Editor) -> None:
    write_definitions(editor)
    params = lsp.PrepareRenameParams(
        **place(editor, "Demo.idsl", DEMO, "Status status")  # type: ignore[arg-type]
    )
    with pytest.raises(Exception, match=r"declared in the YARP definition `motor\.thrift`"):
        await editor.client.text_document_prepare_rename_async(params)


async def test_outline_of_yarp_definition(editor: Editor) -> None:
    write_definitions(editor)
    outlines = {}
    for name, text in (("motor.thrift", MOTOR), ("gaze.bottle", GAZE)):
        document = lsp.TextDocumentIdentifier(editor.open(name, text))
        found = await editor.client.text_document_document_symbol_async(
            lsp.DocumentSymbolParams(document)
        )
        assert found
        (module,) = found
        assert isinstance(module, lsp.DocumentSymbol)
        children = module.children or ()
        outlines[name] = {c.name: [d.name for d in c.children or ()] for c in children}
        for symbol in (module, *children, *(d for c in children for d in c.children or ())):
            assert symbol.range.start <= symbol.selection_range.start
            assert symbol.selection_range.end <= symbol.range.end
    assert outlines == {
        "motor.thrift": {
            "Status": ["angle", "limits", "others"],
            "Base": ["speed"],
            "Motor": ["get_status"],
        },
        "gaze.bottle": {"gaze": ["angle", "target"], "gaze_target": ["x"]},
    }


async def test_finding_of_edited_yarp_definition(editor: Editor) -> None:
    write_definitions(editor)
    editor.open("motor.thrift", MOTOR + "struct\n")
    found = await editor.until("motor.thrift", bool)
    assert [finding.code for finding in found] == ["RC123"]
    editor.open("gaze.bottle", GAZE + "(float64)\n")
    found = await editor.until("gaze.bottle", bool)
    assert [finding.code for finding in found] == ["RC126"]


@pytest.mark.parametrize(("name", "text"), [("motor.thrift", MOTOR), ("gaze.bottle", GAZE)])
async def test_every_feature_answers_in_yarp_definition(
    editor: Editor, name: str, text: str
) -> None:
    write_definitions(editor)
    document = lsp.TextDocumentIdentifier(editor.open(name, text))
    client, top = editor.client, lsp.Range(lsp.Position(0, 0), lsp.Position(4, 0))
    options = lsp.FormattingOptions(4, insert_spaces=True)
    formatted = lsp.DocumentFormattingParams(document, options)
    assert not await client.text_document_formatting_async(formatted)
    assert await client.text_document_semantic_tokens_full_async(lsp.SemanticTokensParams(document))
    await client.text_document_folding_range_async(lsp.FoldingRangeParams(document))
    await client.text_document_code_lens_async(lsp.CodeLensParams(document))
    await client.text_document_inlay_hint_async(lsp.InlayHintParams(document, top))
    context = lsp.CodeActionContext([])
    await client.text_document_code_action_async(lsp.CodeActionParams(document, top, context))
    links = await client.text_document_document_link_async(lsp.DocumentLinkParams(document))
    assert len(links or ()) == text.count("include")
    await client.workspace_symbol_async(lsp.WorkspaceSymbolParams("Li"))
    for line in range(len(text.splitlines())):
        position = lsp.Position(line, 4)
        await client.text_document_hover_async(lsp.HoverParams(document, position))
        await client.text_document_completion_async(lsp.CompletionParams(document, position))
        references = lsp.ReferenceContext(include_declaration=True)
        await client.text_document_references_async(
            lsp.ReferenceParams(references, document, position)
        )
        await client.text_document_prepare_call_hierarchy_async(
            lsp.CallHierarchyPrepareParams(document, position)
        )
