"""Rename: across files, with qualified names where needed, and errors."""

from __future__ import annotations

import pytest
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams

from tests.language_server import project
from tests.language_server.editor_client import Editor, edited
from tests.language_server.project import FILES, marked

pytestmark = pytest.mark.asyncio


async def rename(editor: Editor, name: str, text: str, new: str) -> dict[str, str]:
    params = lsp.RenameParams(new_name=new, **editor.at(name, text))
    found = await editor.client.text_document_rename_async(params)
    assert found is not None
    changed = {}
    for uri, edits in (found.changes or {}).items():
        file = uri.rpartition("/")[2]
        changed[file] = edited(list(edits), FILES[file])
    return changed


CASES = [
    ("Laser.idsl", "Laser", "Lidar", {
        "Laser.idsl": ["interface Lidar"],
        "reader.cdsl": ['import "Laser.idsl";', "requires Lidar;"],
        "base.cdsl": ["implements Lidar;"],
        "app.ddsl": ["connect eye.Lidar -> base.Lidar;"],
    }),
    ("Laser.idsl", "Beam", "Ray", {"Laser.idsl": ["struct Ray", "sequence<Ray> Scan;"]}),
    ("Laser.idsl", "Fast }", "Quick", {"Laser.idsl": ["Slow, Quick", "Mode mode = Quick;"]}),
    ("reader.cdsl", "reader\n", "watcher", {
        "reader.cdsl": ["Component watcher", 'parameters "reader.pdsl";'],
        "app.ddsl": ["component eye : watcher {"],
    }),
    ("base.cdsl", "base", "chassis", {
        "base.cdsl": ["Component chassis"],
        "app.ddsl": ["component base : chassis;", "after base;", "-> base.Laser"],
    }),
    ("app.ddsl", "base;", "body", {
        "app.ddsl": ["component body : base;", "after body;", "-> body.Laser", '"base.cdsl"'],
    }),
    ("reader.pdsl", "gain", "factor", {
        "reader.pdsl": ["factor float 1;"], "app.ddsl": ["set pid.factor = 2;"],
    }),
]  # fmt: skip


async def test_rename(editor: Editor) -> None:
    project.write(editor)
    for name, word, new, expected in CASES:
        changed = await rename(editor, name, marked(name, word), new)
        assert changed.keys() == expected.keys(), (name, word)
        for file, parts in expected.items():
            for part in parts:
                assert part in changed[file], (file, changed[file])


REFUSED = [
    ("Beam", "Mode", "another enum is named `Mode`"),
    ("Beam", "struct", "`struct` is a keyword of this language"),
    ("Beam", "2beams", "`2beams` is not a valid name"),
]


async def test_rename_errors_give_reasons(editor: Editor) -> None:
    project.write(editor)
    for word, new, message in REFUSED:
        place = editor.at("Laser.idsl", marked("Laser.idsl", word))
        with pytest.raises(JsonRpcInvalidParams, match=message.replace("(", r"\(")):
            await editor.client.text_document_rename_async(lsp.RenameParams(new_name=new, **place))


async def test_rename_rejects_shipped_declarations(editor: Editor) -> None:
    text = 'import "IMU.idsl";\nComponent a\n{\n    Communications { requires I|MU; };\n};\n'
    with pytest.raises(JsonRpcInvalidParams, match="ships with rcgen"):
        await editor.client.text_document_prepare_rename_async(
            lsp.PrepareRenameParams(**editor.at("a.cdsl", text))
        )


async def test_prepare_rename(editor: Editor) -> None:
    project.write(editor)
    place = editor.at("app.ddsl", marked("app.ddsl", "eye"))
    found = await editor.client.text_document_prepare_rename_async(lsp.PrepareRenameParams(**place))
    assert isinstance(found, lsp.PrepareRenamePlaceholder)
    assert found.placeholder == "eye"
    keyword = editor.place("app.ddsl", marked("app.ddsl", "connect"))
    params = lsp.PrepareRenameParams(**keyword)
    assert await editor.client.text_document_prepare_rename_async(params) is None
