"""Call hierarchy: through interfaces and through the connections of a deployment."""

from __future__ import annotations

import pytest
from lsprotocol import types as lsp

from tests.language_server import project
from tests.language_server.editor_client import Editor
from tests.language_server.project import FILES, marked

pytestmark = pytest.mark.asyncio

TOPIC = "module T\n{\n    interface Ticks { void tick(int n); };\n};\n"
CLOCK = """import "T.idsl";
Component clock
{
    Communications { publishes Ticks; };
    language Python;
};
"""
LISTENER = CLOCK.replace("clock", "listener").replace("publishes", "subscribesTo")


async def prepared(editor: Editor, name: str, text: str) -> lsp.CallHierarchyItem:
    params = lsp.CallHierarchyPrepareParams(**editor.at(name, text))
    (item,) = await editor.client.text_document_prepare_call_hierarchy_async(params) or ()
    return item


async def incoming_calls(
    editor: Editor, item: lsp.CallHierarchyItem
) -> list[tuple[str, str, list[int]]]:
    """Name, file and lines (from 1) of the incoming calls."""
    params = lsp.CallHierarchyIncomingCallsParams(item)
    found = await editor.client.call_hierarchy_incoming_calls_async(params)
    return [describe(entry.from_, entry.from_ranges) for entry in found or ()]


async def outgoing_calls(
    editor: Editor, item: lsp.CallHierarchyItem
) -> list[tuple[str, str, list[int]]]:
    params = lsp.CallHierarchyOutgoingCallsParams(item)
    found = await editor.client.call_hierarchy_outgoing_calls_async(params)
    return [describe(entry.to, entry.from_ranges) for entry in found or ()]


def describe(item: lsp.CallHierarchyItem, ranges: object) -> tuple[str, str, list[int]]:
    assert isinstance(ranges, list | tuple)
    return item.name, item.uri.rpartition("/")[2], [entry.start.line + 1 for entry in ranges]


async def test_call_hierarchy_of_components(editor: Editor) -> None:
    project.write(editor)
    base = await prepared(editor, "base.cdsl", marked("base.cdsl", "base"))
    assert (base.name, base.detail) == ("base", "implements Laser")
    assert await incoming_calls(editor, base) == [("reader", "reader.cdsl", [5])]
    assert await outgoing_calls(editor, base) == []
    reader = await prepared(editor, "reader.cdsl", marked("reader.cdsl", "reader\n"))
    assert await incoming_calls(editor, reader) == []
    assert await outgoing_calls(editor, reader) == [("base", "base.cdsl", [5])]


async def test_call_hierarchy_of_topics(editor: Editor) -> None:
    for name, text in (("T.idsl", TOPIC), ("clock.cdsl", CLOCK), ("listener.cdsl", LISTENER)):
        editor.write(name, text)
    clock = await prepared(editor, "clock.cdsl", CLOCK.replace("clock", "cl|ock"))
    assert await incoming_calls(editor, clock) == [("listener", "listener.cdsl", [4])]
    listener = await prepared(editor, "listener.cdsl", LISTENER.replace("listener", "li|stener"))
    assert await outgoing_calls(editor, listener) == [("clock", "clock.cdsl", [4])]


async def test_call_hierarchy_of_interface(editor: Editor) -> None:
    project.write(editor)
    item = await prepared(editor, "Laser.idsl", marked("Laser.idsl", "Laser"))
    assert (item.kind, item.detail) == (lsp.SymbolKind.Interface, "Scans::Laser")
    assert await incoming_calls(editor, item) == [("reader", "reader.cdsl", [5])]
    assert await outgoing_calls(editor, item) == [("base", "base.cdsl", [10])]


async def test_call_hierarchy_of_deployment_instances(editor: Editor) -> None:
    project.write(editor)
    text = FILES["app.ddsl"].replace(
        "    component base;", "    component base;\n    component b2 : base;"
    )
    eye = await prepared(editor, "app.ddsl", text.replace("eye :", "e|ye :"))
    assert (eye.name, eye.detail) == ("eye", ": reader")
    assert await outgoing_calls(editor, eye) == [("base", "app.ddsl", [8])]
    base = await prepared(editor, "app.ddsl", text.replace("base;", "ba|se;", 1))
    assert base.kind == lsp.SymbolKind.Object
    assert await incoming_calls(editor, base) == [("eye", "app.ddsl", [8])]
    second = await prepared(editor, "app.ddsl", text.replace("b2", "b|2"))
    assert await incoming_calls(editor, second) == []


async def test_call_hierarchy_includes_implicit_connection(editor: Editor) -> None:
    project.write(editor)
    text = FILES["app.ddsl"].replace("    connect eye.Laser -> base.Laser;\n", "")
    eye = await prepared(editor, "app.ddsl", text.replace("eye :", "e|ye :"))
    assert await outgoing_calls(editor, eye) == [("base", "app.ddsl", [6])]


async def test_call_hierarchy_includes_unsaved_port(editor: Editor) -> None:
    project.write(editor)
    editor.open("base.cdsl", FILES["base.cdsl"].replace("implements", "requires"))
    reader = await prepared(editor, "reader.cdsl", marked("reader.cdsl", "reader\n"))
    assert await outgoing_calls(editor, reader) == []


async def test_call_hierarchy_is_empty_at_keyword(editor: Editor) -> None:
    project.write(editor)
    place = editor.at("app.ddsl", marked("app.ddsl", "connect"))
    params = lsp.CallHierarchyPrepareParams(**place)
    assert await editor.client.text_document_prepare_call_hierarchy_async(params) is None
