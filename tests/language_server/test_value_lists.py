"""Lists of plain values in the editor: hover, outline, completion, rename."""

from __future__ import annotations

import pytest
from lsprotocol import types as lsp

from tests.language_server.editor_client import Editor

pytestmark = pytest.mark.asyncio

PDSL = """ComponentParams arm
{
    /** One for each finger. */
    weights[1:8] float 1.0 [kg] 0:10 live;
    names[] string {"left", "right"};
    modes[2] {position, velocity} velocity;
};
"""
CDSL = 'Component arm { Communications { }; language Python; parameters "arm.pdsl"; };\n'
DDSL = """import "arm.cdsl";
Deployment app
{
    component left : arm { set weights = {1, 2}; set weights[1] = 3; };
};
"""


def write(editor: Editor) -> None:
    for name, text in {"arm.pdsl": PDSL, "arm.cdsl": CDSL, "app.ddsl": DDSL}.items():
        editor.write(name, text)


async def test_hover_shows_lists_as_written(editor: Editor) -> None:
    write(editor)
    expected = [
        ("weights", "weights[1:8] float 1.0 [kg] 0:10 live;"),
        ("names", 'names[] string {"left", "right"};'),
        ("modes", "modes[2] {position, velocity} velocity;"),
    ]
    for word, signature in expected:
        place = editor.at("arm.pdsl", PDSL.replace(word, f"{word[0]}|{word[1:]}", 1))
        hover = await editor.client.text_document_hover_async(lsp.HoverParams(**place))
        assert hover
        assert signature in str(hover.contents)
    text = DDSL.replace("weights[1]", "wei|ghts[1]")
    hover = await editor.client.text_document_hover_async(
        lsp.HoverParams(**editor.at("app.ddsl", text))
    )
    assert hover
    assert "One for each finger." in str(hover.contents)


async def test_rename_changes_lists_and_elements(editor: Editor) -> None:
    write(editor)
    place = editor.at("arm.pdsl", PDSL.replace("weights", "w|eights"))
    edit = await editor.client.text_document_rename_async(
        lsp.RenameParams(new_name="masses", **place)
    )
    assert edit
    assert edit.changes
    changes = {uri.rpartition("/")[2]: len(edits) for uri, edits in edit.changes.items()}
    assert changes == {"arm.pdsl": 1, "app.ddsl": 2}


async def test_outline_shows_the_length_of_lists(editor: Editor) -> None:
    uri = editor.open("arm.pdsl", PDSL)
    found = await editor.client.text_document_document_symbol_async(
        lsp.DocumentSymbolParams(lsp.TextDocumentIdentifier(uri))
    )
    assert found
    (symbol,) = found
    assert isinstance(symbol, lsp.DocumentSymbol)
    details = [child.detail for child in symbol.children or ()]
    assert details == ["float[1:8]", "string[]", "{position, velocity}[2]"]


async def test_completion_offers_lists_with_their_length(editor: Editor) -> None:
    write(editor)
    text = DDSL.replace("set weights[1] = 3;", "set |")
    found = await editor.client.text_document_completion_async(
        lsp.CompletionParams(**editor.at("app.ddsl", text))
    )
    items = found.items if isinstance(found, lsp.CompletionList) else found or ()
    details = {item.label: item.detail for item in items}
    assert details["weights"] == "float, 1 to 8 elements"
    assert details["names"] == "string, any number of elements"


async def test_completion_offers_the_values_of_a_list(editor: Editor) -> None:
    cases = {
        "a {x, y} |;": "x",
        "a[2] bool {|};": "true",
        "a[2] {x, y} {|};": "x",
        "a[2] {x, y} {x, |};": "y",
    }
    for written, label in cases.items():
        text = f"ComponentParams p\n{{\n    {written}\n}};\n"
        found = await editor.client.text_document_completion_async(
            lsp.CompletionParams(**editor.at("p.pdsl", text))
        )
        items = found.items if isinstance(found, lsp.CompletionList) else found or ()
        assert label in {item.label for item in items}, written
