"""Definitions and instances of groups in the editor."""

from __future__ import annotations

import pytest
from lsprotocol import types as lsp

from tests.language_server import project
from tests.language_server.editor_client import Editor, edited
from tests.language_server.test_connections import placed

pytestmark = pytest.mark.asyncio

ARM = """import "reader.cdsl";
import "base.cdsl";
/** An arm that sees. */
group arm
{
    component base;
    component eye : reader { after base; };
    export Laser from base as Scan;
    export Laser from base;
};
"""
APP = """import "arm.ddsl";
import "reader.cdsl";
Deployment app
{
    group left : arm { set eye.pid.gain = 3; };
    group right : arm;
    component other : reader;
    component third : reader { after left; };
    connect other.Laser -> left.Scan;
    connect third.Laser -> right.Laser;
};
"""


@pytest.fixture
def editor_with_groups(editor: Editor) -> Editor:
    project.write(editor)
    editor.write("arm.ddsl", ARM)
    return editor


async def hover(editor: Editor, word: str, number: int = 1) -> str:
    params = lsp.HoverParams(**editor.at("app.ddsl", placed(APP, word, number)))
    found = await editor.client.text_document_hover_async(params)
    assert found is not None
    assert isinstance(found.contents, lsp.MarkupContent)
    return found.contents.value


async def test_hover_shows_group_and_its_definition(editor_with_groups: Editor) -> None:
    text = await hover(editor_with_groups, "arm", 2)
    assert "group arm\n    component base;\n    component eye : reader;" in text
    assert "export Laser from base as Scan;" in text
    assert "An arm that sees." in text
    assert "group left : arm" in await hover(editor_with_groups, "left", 3)
    assert "gain float 1" in await hover(editor_with_groups, "gain")


@pytest.mark.parametrize(
    ("word", "number", "file", "target"),
    [
        ("arm", 2, "arm.ddsl", "arm\n"),
        ("eye", 1, "arm.ddsl", "eye : reader"),
        ("Scan", 1, "arm.ddsl", "Scan;"),
        ("left", 2, "app.ddsl", "left : arm"),
    ],
)
async def test_definition_of_names_in_groups(
    editor_with_groups: Editor, word: str, number: int, file: str, target: str
) -> None:
    editor = editor_with_groups
    params = lsp.DefinitionParams(**editor.at("app.ddsl", placed(APP, word, number)))
    found = await editor.client.text_document_definition_async(params)
    (location,) = found if isinstance(found, list) else [found]
    assert isinstance(location, lsp.Location | lsp.LocationLink)
    is_location = isinstance(location, lsp.Location)
    uri = location.uri if is_location else location.target_uri
    start = location.range.start if is_location else location.target_selection_range.start
    text = ARM if file == "arm.ddsl" else APP
    assert uri.endswith(file)
    assert text.splitlines(keepends=True)[start.line][start.character :].startswith(target)


async def test_rename_of_definition_changes_its_instances(editor_with_groups: Editor) -> None:
    editor = editor_with_groups
    params = lsp.RenameParams(new_name="limb", **editor.at("app.ddsl", placed(APP, "arm", 2)))
    found = await editor.client.text_document_rename_async(params)
    assert found is not None
    changes = {uri.rpartition("/")[2]: edits for uri, edits in (found.changes or {}).items()}
    assert edited(list(changes["arm.ddsl"]), ARM) == ARM.replace("group arm", "group limb")
    assert edited(list(changes["app.ddsl"]), APP) == APP.replace(": arm", ": limb")


@pytest.mark.parametrize(
    ("line", "present", "absent"),
    [
        ("group x : |", {"arm"}, {"left", "reader"}),
        ("connect other.Laser -> left.|", {"Scan", "Laser"}, {"arm"}),
        ("connect other.Laser -> |", {"left", "right", "other"}, set()),
        ("group x : arm { set |", {"base", "eye"}, {"rate"}),
        ("group x : arm { set eye.|", {"rate", "pid"}, {"base"}),
        ("group x : arm { set eye.pid.|", {"gain"}, {"rate"}),
        ("group x : arm { |", {"inprocess", "prefix", "set", "after"}, {"labels"}),
    ],
)
async def test_completion_in_groups(
    editor_with_groups: Editor, line: str, present: set[str], absent: set[str]
) -> None:
    editor = editor_with_groups
    text = APP.replace("    connect other", f"    {line}\n    connect other", 1)
    params = lsp.CompletionParams(**editor.at("app.ddsl", text))
    found = await editor.client.text_document_completion_async(params)
    items = found.items if isinstance(found, lsp.CompletionList) else found or []
    labels = {item.label for item in items}
    assert present <= labels
    assert not absent & labels


async def test_outline_shows_definitions(editor_with_groups: Editor) -> None:
    editor = editor_with_groups
    editor.open("arm.ddsl", ARM)
    identifier = lsp.TextDocumentIdentifier(editor.uri("arm.ddsl"))
    found = await editor.client.text_document_document_symbol_async(
        lsp.DocumentSymbolParams(identifier)
    )
    assert found
    (group,) = found
    assert isinstance(group, lsp.DocumentSymbol)
    assert [group.name, *(child.name for child in group.children or ())][:3] == [
        "arm",
        "base",
        "eye",
    ]
