"""Definition, type definition, references, highlights, links, hover."""

from __future__ import annotations

import pytest
from lsprotocol import types as lsp

from tests.language_server import project
from tests.language_server.editor_client import Editor
from tests.language_server.project import FILES, marked

pytestmark = pytest.mark.asyncio


def describe(editor: Editor, locations: object) -> list[str]:
    """`file:line text` of each location, line from 1."""
    assert isinstance(locations, list | tuple)
    lines = []
    for location in locations:
        name = location.uri.rpartition("/")[2]
        line = FILES[name].splitlines()[location.range.start.line]
        word = line[location.range.start.character : location.range.end.character]
        lines.append(f"{name}:{location.range.start.line + 1} {word}".strip())
    return sorted(lines)


DEFINITIONS = [
    ("reader.cdsl", "Laser", 2, "Laser.idsl:10 Laser"),
    ("reader.cdsl", "Laser.idsl", 1, "Laser.idsl:1"),
    ("reader.cdsl", "reader.pdsl", 1, "reader.pdsl:1"),
    ("Laser.idsl", "Beam> Scan", 1, "Laser.idsl:6 Beam"),
    ("Laser.idsl", "Fast;", 1, "Laser.idsl:4 Fast"),
    ("Laser.idsl", "Broken;\n        [", 1, "Laser.idsl:8 Broken"),
    ("app.ddsl", "base.cdsl", 1, "base.cdsl:1"),
    ("app.ddsl", "base;", 1, "base.cdsl:3 base"),
    ("app.ddsl", "reader {", 1, "reader.cdsl:3 reader"),
    ("app.ddsl", "base; set", 1, "app.ddsl:5 base"),
    ("app.ddsl", "Laser", 1, "reader.cdsl:5 Laser"),
    ("app.ddsl", "rate", 1, "reader.pdsl:4 rate"),
    ("app.ddsl", "gain", 1, "reader.pdsl:5 gain"),
]


async def test_definition(editor: Editor) -> None:
    project.write(editor)
    for name, word, number, expected in DEFINITIONS:
        params = lsp.DefinitionParams(**editor.at(name, marked(name, word, number)))
        found = await editor.client.text_document_definition_async(params)
        assert describe(editor, found) == [expected], (name, word)


TYPES = [
    ("Laser.idsl", "mode", ["Laser.idsl:4 Mode"]),
    ("Laser.idsl", "scan()", ["Laser.idsl:7 Scan"]),
    ("Laser.idsl", "angle", []),
    ("app.ddsl", "eye :", ["reader.cdsl:3 reader"]),
    ("app.ddsl", "Laser", ["Laser.idsl:10 Laser"]),
]


async def test_type_definition(editor: Editor) -> None:
    project.write(editor)
    for name, word, expected in TYPES:
        params = lsp.TypeDefinitionParams(**editor.at(name, marked(name, word)))
        found = await editor.client.text_document_type_definition_async(params)
        assert describe(editor, found) == expected, (name, word)


async def test_references(editor: Editor) -> None:
    project.write(editor)
    place = editor.at("Laser.idsl", marked("Laser.idsl", "Laser"))
    everything = [
        "Laser.idsl:10 Laser",
        "app.ddsl:7 Laser",
        "app.ddsl:7 Laser",
        "base.cdsl:5 Laser",
        "reader.cdsl:5 Laser",
    ]
    for declared in (True, False):
        context = lsp.ReferenceContext(include_declaration=declared)
        params = lsp.ReferenceParams(context, **place)
        found = await editor.client.text_document_references_async(params)
        assert describe(editor, found) == everything[0 if declared else 1 :]


async def test_highlights(editor: Editor) -> None:
    project.write(editor)
    params = lsp.DocumentHighlightParams(**editor.at("app.ddsl", marked("app.ddsl", "eye")))
    found = await editor.client.text_document_document_highlight_async(params)
    assert [(entry.range.start.line, entry.kind) for entry in found or ()] == [
        (5, lsp.DocumentHighlightKind.Write),
        (6, lsp.DocumentHighlightKind.Read),
    ]


async def test_document_links(editor: Editor) -> None:
    project.write(editor)
    for name, targets in (
        ("reader.cdsl", ["Laser.idsl", "reader.pdsl"]),
        ("app.ddsl", ["reader.cdsl", "base.cdsl"]),
    ):
        document = lsp.TextDocumentIdentifier(editor.open(name, FILES[name]))
        params = lsp.DocumentLinkParams(document)
        found = await editor.client.text_document_document_link_async(params)
        assert [entry.target for entry in found or ()] == [editor.uri(target) for target in targets]


HOVERS = [
    ("reader.cdsl", "Laser", 2, ["interface Scans::Laser", "[query] Scans::Scan scan() throws",
     "[command] void stop();", "[query | publish] void hint(int level);", "A planar laser."]),
    ("Laser.idsl", "Scan scan", 1, ["sequence<Scans::Beam> Scans::Scan;", "float dist [mm];",
     'Scans::Mode mode = "Fast";']),
    ("Laser.idsl", "dist", 1, ["float dist [mm]"]),
    ("app.ddsl", "rate", 1, ["rate float 50.0 [Hz] 1:1000 live;", "How often."]),
    ("app.ddsl", "eye :", 1, ["component eye : reader", "requires Scans::Laser;", "Reads."]),
    ("app.ddsl", "app", 1, ["connect eye.Laser -> base.Laser;"]),
    ("app.ddsl", "Laser", 1, ["requires Scans::Laser;", "A planar laser."]),
]  # fmt: skip


async def test_hover(editor: Editor) -> None:
    project.write(editor)
    for name, word, number, parts in HOVERS:
        params = lsp.HoverParams(**editor.at(name, marked(name, word, number)))
        found = await editor.client.text_document_hover_async(params)
        assert found is not None, (name, word)
        assert isinstance(found.contents, lsp.MarkupContent)
        for part in parts:
            assert part in found.contents.value, (name, word, found.contents.value)


async def test_hover_is_empty_at_keyword(editor: Editor) -> None:
    project.write(editor)
    params = lsp.HoverParams(**editor.at("app.ddsl", marked("app.ddsl", "connect")))
    assert await editor.client.text_document_hover_async(params) is None
