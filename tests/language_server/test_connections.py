"""Middlewares, external programs, monitors and arbitration in the editor."""

from __future__ import annotations

import pytest
from lsprotocol import types as lsp

from tests.language_server import project
from tests.language_server.editor_client import Editor, edited
from tests.language_server.test_outline import tree

pytestmark = pytest.mark.asyncio

HEAD = 'import "reader.cdsl";\nimport "base.cdsl";\nDeployment app\n{\n'
APP = (
    HEAD
    + """    middleware zenoh;
    component base { port Laser over zenoh; };
    component eye : reader { middleware zenoh; };
    /// The old robot.
    extern old over ice at "laser:tcp -p 1" implements Laser;
    group g { component inner : reader; connect inner.Laser -> old.Laser over zenoh; };
    connect eye.Laser -> old.Laser { monitor "limits.py" Limit; };
    arbitrate base.Laser { from old.Laser when seen; };
};
"""
)


def placed(text: str, word: str, number: int = 1) -> str:
    """`text` with a `|` behind the first letter of the n-th `word`."""
    at = -1
    for _ in range(number):
        at = text.index(word, at + 1)
    return f"{text[: at + 1]}|{text[at + 1 :]}"


@pytest.mark.parametrize(
    ("word", "number"), [("zenoh", 1), ("zenoh", 2), ("zenoh", 3), ("zenoh", 4), ("ice", 1)]
)
async def test_hover_describes_middleware(editor: Editor, word: str, number: int) -> None:
    project.write(editor)
    text = APP.replace("over ice", "over inproc").replace("ice", "inproc")
    params = lsp.HoverParams(
        **editor.at("app.ddsl", placed(text, word.replace("ice", "inproc"), number))
    )
    found = await editor.client.text_document_hover_async(params)
    assert found is not None
    assert isinstance(found.contents, lsp.MarkupContent)
    assert found.contents.value.startswith(f"**{word.replace('ice', 'inproc')}**: ")


async def test_outline_and_links_of_connections(editor: Editor) -> None:
    project.write(editor)
    editor.write("limits.py", "class Limit: ...\n")
    document = lsp.TextDocumentIdentifier(editor.open("app.ddsl", APP))
    found = await editor.client.text_document_document_symbol_async(
        lsp.DocumentSymbolParams(document)
    )
    lines = tree(found)
    assert "  old Object" in lines
    assert "  base.Laser Event" in lines
    links = await editor.client.text_document_document_link_async(lsp.DocumentLinkParams(document))
    assert editor.uri("limits.py") in [link.target for link in links or ()]


async def test_definition_of_own_port_is_port_of_component(editor: Editor) -> None:
    project.write(editor)
    params = lsp.DefinitionParams(**editor.at("app.ddsl", placed(APP, "Laser", 1)))
    (found,) = await editor.client.text_document_definition_async(params) or ()
    assert isinstance(found, lsp.Location)
    assert found.uri == editor.uri("base.cdsl")


async def test_errors_of_monitor_class_are_shown_at_the_monitor(editor: Editor) -> None:
    project.write(editor)
    editor.write("limits.py", "class Limit(Monitor):\n    def accept(self, x):\n        return 1\n")
    text = HEAD + (
        "    component eye : reader;\n    component base;\n"
        '    connect eye.Laser -> base.Laser { monitor "limits.py" Limit; };\n};\n'
    )
    editor.open("app.ddsl", text)
    (finding,) = await editor.until("app.ddsl", bool)
    assert finding.code == "RC557"
    assert "limits.py" in finding.message
    assert finding.range.start.line == 6
    assert finding.related_information is not None
    assert finding.related_information[0].location.uri == editor.uri("limits.py")


async def test_type_of_external_program_is_its_interface(editor: Editor) -> None:
    project.write(editor)
    params = lsp.TypeDefinitionParams(**editor.at("app.ddsl", placed(APP, "old over")))
    (found,) = await editor.client.text_document_type_definition_async(params) or ()
    assert isinstance(found, lsp.Location)
    assert found.uri == editor.uri("Laser.idsl")


async def test_rename_of_external_program_changes_all_references(editor: Editor) -> None:
    project.write(editor)
    params = lsp.RenameParams(new_name="robot", **editor.at("app.ddsl", placed(APP, "old over")))
    found = await editor.client.text_document_rename_async(params)
    assert found is not None
    (edits,) = (found.changes or {}).values()
    assert len(edits) == 4
    after = edited(list(edits), APP)
    assert "extern robot over ice" in after
    assert "-> robot.Laser over zenoh" in after
    assert "from robot.Laser when seen" in after


async def test_call_hierarchy_includes_external_program(editor: Editor) -> None:
    project.write(editor)
    text = HEAD + (
        "    component eye : reader;\n"
        '    extern old over ice at "laser:tcp -p 1" implements Laser;\n'
        "    connect eye.Laser -> old.Laser;\n};\n"
    )
    params = lsp.CallHierarchyPrepareParams(**editor.at("app.ddsl", placed(text, "eye")))
    (item,) = await editor.client.text_document_prepare_call_hierarchy_async(params) or ()
    calls = lsp.CallHierarchyOutgoingCallsParams(item)
    found = await editor.client.call_hierarchy_outgoing_calls_async(calls)
    assert [(entry.to.name, entry.to.detail) for entry in found or ()] == [("old", "over ice")]
