"""Hosts, labels and placement in the editor."""

from __future__ import annotations

import pytest
from lsprotocol import types as lsp

from tests.language_server import project
from tests.language_server.editor_client import Editor, edited
from tests.language_server.test_connections import HEAD, placed

pytestmark = pytest.mark.asyncio

APP = (
    HEAD
    + """    host robot { address "10.0.0.2:2222"; user nao; port 7450; labels arm, gpu; };
    host desk { address "10.0.0.3"; labels gpu; };
    component body : base on label gpu { cores 0, 2-3; };
    group g { place by load on robot, desk; component inner : base; };
    program fan on label gpu { executable "fan"; };
    component eye : reader { place by load on label arm; };
};
"""
)


@pytest.mark.parametrize(
    ("word", "number", "text"),
    [
        ("robot", 1, 'address "10.0.0.2:2222"; user nao; port 7450; labels arm, gpu;'),
        ("robot", 2, 'address "10.0.0.2:2222"'),
        ("desk", 2, 'address "10.0.0.3"'),
        ("gpu", 1, "label gpu    // of robot, desk"),
        ("gpu", 3, "label gpu    // of robot, desk"),
        ("arm", 2, "label arm    // of robot"),
        ("body", 1, "component body : base    // placed on label gpu"),
        ("inner", 1, "placed by load on robot, desk"),
        ("fan", 1, "program fan    // fan, placed on label gpu"),
    ],
)
async def test_hover_shows_placement(editor: Editor, word: str, number: int, text: str) -> None:
    project.write(editor)
    params = lsp.HoverParams(**editor.at("app.ddsl", placed(APP, word, number)))
    found = await editor.client.text_document_hover_async(params)
    assert found is not None
    assert isinstance(found.contents, lsp.MarkupContent)
    assert text in found.contents.value


async def test_definition_of_label_is_at_first_host(editor: Editor) -> None:
    project.write(editor)
    params = lsp.DefinitionParams(**editor.at("app.ddsl", placed(APP, "label gpu").replace(
        "l|abel gpu", "label g|pu")))  # fmt: skip
    found = await editor.client.text_document_definition_async(params)
    locations = found if isinstance(found, list) else [found]
    (location,) = locations
    assert isinstance(location, lsp.Location | lsp.LocationLink)
    at = location.range if isinstance(location, lsp.Location) else location.target_range
    assert at.start.line == APP[: APP.index("gpu")].count("\n")


async def test_rename_of_label_changes_all_hosts_and_uses(editor: Editor) -> None:
    project.write(editor)
    params = lsp.RenameParams(new_name="cuda", **editor.at("app.ddsl", placed(APP, "gpu", 2)))
    found = await editor.client.text_document_rename_async(params)
    assert found is not None
    (edits,) = (found.changes or {}).values()
    assert edited(list(edits), APP) == APP.replace("gpu", "cuda")


async def test_rename_of_host_changes_candidates(editor: Editor) -> None:
    project.write(editor)
    params = lsp.RenameParams(new_name="table", **editor.at("app.ddsl", placed(APP, "desk")))
    found = await editor.client.text_document_rename_async(params)
    assert found is not None
    (edits,) = (found.changes or {}).values()
    assert edited(list(edits), APP) == APP.replace("desk", "table")
