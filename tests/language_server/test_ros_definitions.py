"""ROS definitions in an editor: definition, hover, completion, findings, rename, outline."""

from __future__ import annotations

from pathlib import Path

import pytest
from lsprotocol import types as lsp
from pygls.uris import to_fs_path

from tests.language_server.editor_client import Editor

pytestmark = pytest.mark.asyncio

READING = """# One reading of a sensor.

uint8 OK=0  # Valid.

std_msgs/Header header
uint32[<=4] values  # [m]
"""
DEMO = """import "demo_msgs/msg/Reading.msg";
import "std_srvs/srv/SetBool.srv";
module Demo
{
    struct Pair { demo_msgs::Reading first; };
    interface Lamp { std_srvs::SetBool_Response set(std_srvs::SetBool_Request request); };
};
"""


def write_package(editor: Editor) -> None:
    (editor.folder / "demo_msgs" / "msg").mkdir(parents=True)
    editor.write("demo_msgs/msg/Reading.msg", READING)
    editor.open("Demo.idsl", DEMO)


def place(editor: Editor, text: str, number: int = 0) -> dict[str, object]:
    """The document and the position of `text` in Demo.idsl."""
    line = [i for i, row in enumerate(DEMO.splitlines()) if text in row][number]
    column = DEMO.splitlines()[line].index(text) + 1
    document = lsp.TextDocumentIdentifier(editor.uri("Demo.idsl"))
    return {"text_document": document, "position": lsp.Position(line, column)}


async def definition_of(editor: Editor, text: str) -> tuple[Path, int]:
    params = lsp.DefinitionParams(**place(editor, text))  # type: ignore[arg-type]
    found = await editor.client.text_document_definition_async(params)
    assert isinstance(found, list)
    (location,) = found
    return Path(to_fs_path(location.uri) or ""), location.range.start.line


async def test_definition_opens_ros_definition(editor: Editor) -> None:
    write_package(editor)
    reading = editor.folder / "demo_msgs" / "msg" / "Reading.msg"
    assert await definition_of(editor, "demo_msgs/msg/Reading.msg") == (reading, 0)
    assert await definition_of(editor, "Reading first") == (reading, 0)
    path, line = await definition_of(editor, "SetBool_Response set")
    assert path.parts[-3:] == ("std_srvs", "srv", "SetBool.srv")
    assert path.read_text().splitlines()[line] == "---"


async def test_definition_of_rosbags_is_a_file(editor: Editor) -> None:
    write_package(editor)
    editor.open("demo_msgs/msg/Reading.msg", READING)
    document = lsp.TextDocumentIdentifier(editor.uri("demo_msgs/msg/Reading.msg"))
    line = READING.splitlines().index("std_msgs/Header header")
    params = lsp.DefinitionParams(document, lsp.Position(line, 3))
    found = await editor.client.text_document_definition_async(params)
    assert isinstance(found, list)
    path = Path(to_fs_path(found[0].uri) or "")
    assert path.name == "Header.msg"
    assert path.read_text() == "builtin_interfaces/Time stamp\nstring frame_id\n"


async def test_hover_shows_ros_message(editor: Editor) -> None:
    write_package(editor)
    params = lsp.HoverParams(**place(editor, "Reading first"))  # type: ignore[arg-type]
    found = await editor.client.text_document_hover_async(params)
    assert found
    assert isinstance(found.contents, lsp.MarkupContent)
    for text in ("struct demo_msgs::Reading", "const byte OK = 0;", "unsigned int[<=4] values [m];",
                 "std_msgs::Header header;", "One reading of a sensor."):  # fmt: skip
        assert text in found.contents.value


async def test_completion_offers_ros_definitions_and_types(editor: Editor) -> None:
    write_package(editor)
    for text, expected, other in (
        ('import "|', {"demo_msgs/msg/Reading.msg", "sensor_msgs/msg/LaserScan.msg",
                       "std_srvs/srv/SetBool.srv"}, "demo_msgs/msg/Header.msg"),
        ('import "demo_msgs/msg/Reading.msg";\nmodule M { struct S { demo_msgs::| }; };\n',
         {"Reading"}, "Header"),
    ):  # fmt: skip
        params = lsp.CompletionParams(**editor.at(f"other{len(text)}.idsl", text))
        found = await editor.client.text_document_completion_async(params)
        assert isinstance(found, list)
        labels = {item.label for item in found}
        assert expected <= labels
        assert other not in labels


async def test_ros_symbol_is_not_renamed(editor: Editor) -> None:
    write_package(editor)
    params = lsp.PrepareRenameParams(**place(editor, "Reading first"))  # type: ignore[arg-type]
    with pytest.raises(Exception, match=r"declared in the ROS definition `Reading\.msg`"):
        await editor.client.text_document_prepare_rename_async(params)


async def test_outline_of_ros_definition(editor: Editor) -> None:
    write_package(editor)
    editor.open("demo_msgs/msg/Reading.msg", READING)
    document = lsp.TextDocumentIdentifier(editor.uri("demo_msgs/msg/Reading.msg"))
    found = await editor.client.text_document_document_symbol_async(
        lsp.DocumentSymbolParams(document)
    )
    assert found
    (module,) = found
    assert isinstance(module, lsp.DocumentSymbol)
    (message,) = module.children or ()
    assert [child.name for child in message.children or ()] == ["OK", "header", "values"]
    for symbol in (module, message, *(message.children or ())):
        assert symbol.range.start <= symbol.selection_range.start
        assert symbol.selection_range.end <= symbol.range.end


async def test_finding_of_edited_ros_definition(editor: Editor) -> None:
    write_package(editor)
    editor.open("demo_msgs/msg/Reading.msg", READING + "uint8\n")
    found = await editor.until("demo_msgs/msg/Reading.msg", bool)
    assert [finding.code for finding in found] == ["RC121"]


async def test_every_feature_answers_in_ros_definition(editor: Editor) -> None:
    write_package(editor)
    uri = editor.open("demo_msgs/msg/Reading.msg", READING)
    document = lsp.TextDocumentIdentifier(uri)
    client, top = editor.client, lsp.Range(lsp.Position(0, 0), lsp.Position(6, 0))
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
    assert [link.range.start.line for link in links or ()] == [4]
    for line in range(len(READING.splitlines())):
        position = lsp.Position(line, 1)
        await client.text_document_hover_async(lsp.HoverParams(document, position))
        await client.text_document_completion_async(lsp.CompletionParams(document, position))
        references = lsp.ReferenceContext(include_declaration=True)
        await client.text_document_references_async(
            lsp.ReferenceParams(references, document, position)
        )
