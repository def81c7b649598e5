"""State machines of SCXML in an editor."""

from __future__ import annotations

import pytest
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams

from tests.language_server.editor_client import Editor, edited

pytestmark = pytest.mark.asyncio

DOOR = """<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" initial="shut">
  <state id="shut">
    <transition event="door.open" target="open"/>
  </state>
  <state id="open">
    <onentry><raise event="door.open"/></onentry>
    <transition event="door.close" target="shut"/>
  </state>
</scxml>
"""


def marked(word: str) -> str:
    at = DOOR.index(word)
    return DOOR[: at + 1] + "|" + DOOR[at + 1 :]


IN = '<scxml initial="a"><state id="a">{}</state><state id="b"/></scxml>'
COMPLETIONS: list[tuple[str, set[str], set[str]]] = [
    ("<|", {"scxml"}, {"state"}),
    (IN.format("<|"), {"transition", "state", "/state>"}, {"scxml"}),
    (IN.format("<transition |/>"), {"event", "target", "cond"}, {"id"}),
    (IN.format('<transition target="|"/>'), {"a", "b"}, {"event"}),
    (IN.format('<transition target="a |"/>'), {"a b"}, {"b"}),
    ('<scxml initial="|"><state id="c"/></scxml>', {"c"}, set()),
]


async def test_completion_of_scxml(editor: Editor) -> None:
    for text, expected_labels, unwanted in COMPLETIONS:
        params = lsp.CompletionParams(**editor.at("a.scxml", text))
        found = await editor.client.text_document_completion_async(params)
        assert isinstance(found, list | tuple)
        labels = {entry.label for entry in found}
        assert expected_labels <= labels, (text, sorted(labels))
        assert not unwanted & labels, (text, unwanted & labels)


async def test_definition_and_references_in_scxml(editor: Editor) -> None:
    place = editor.at("door.scxml", marked('open"/>\n  </state>'))
    (found,) = (
        await editor.client.text_document_definition_async(lsp.DefinitionParams(**place)) or ()
    )
    assert isinstance(found, lsp.Location)
    assert found.range == lsp.Range(lsp.Position(4, 13), lsp.Position(4, 17))
    hover = await editor.client.text_document_hover_async(lsp.HoverParams(**place))
    assert hover is not None
    assert "shut => open on door.open;" in str(hover.contents)
    event = editor.place("door.scxml", marked("door.open"))
    context = lsp.ReferenceContext(include_declaration=True)
    places = await editor.client.text_document_references_async(
        lsp.ReferenceParams(context, **event)
    )
    assert [entry.range.start.line for entry in places or ()] == [2, 5]


async def rename(editor: Editor, word: str, new: str) -> str:
    params = lsp.RenameParams(new_name=new, **editor.at("door.scxml", marked(word)))
    found = await editor.client.text_document_rename_async(params)
    assert found is not None
    (edits,) = (found.changes or {}).values()
    return edited(list(edits), DOOR)


async def test_rename_in_scxml(editor: Editor) -> None:
    assert await rename(editor, "shut", "closed") == DOOR.replace("shut", "closed")
    for new, why in (("open", "another state"), ("a b", "is not a valid name")):
        with pytest.raises(JsonRpcInvalidParams, match=why):
            await rename(editor, "shut", new)


async def test_outline_folding_and_tokens_of_scxml(editor: Editor) -> None:
    document = lsp.TextDocumentIdentifier(editor.open("door.scxml", DOOR))
    (root,) = (
        await editor.client.text_document_document_symbol_async(lsp.DocumentSymbolParams(document))
        or ()
    )
    assert isinstance(root, lsp.DocumentSymbol)
    assert [child.name for child in root.children or ()] == ["shut", "open"]
    folds = await editor.client.text_document_folding_range_async(lsp.FoldingRangeParams(document))
    assert {(fold.start_line, fold.end_line) for fold in folds or ()} == {(0, 7), (1, 2), (4, 6)}
    tokens = await editor.client.text_document_semantic_tokens_full_async(
        lsp.SemanticTokensParams(document)
    )
    assert tokens is not None
    assert len(tokens.data) == 5 * 8
