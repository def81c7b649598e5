"""State machines in an editor: every feature, on one machine with states inside states."""

from __future__ import annotations

import pytest
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams

from tests.language_server.editor_client import Editor, edited

pytestmark = pytest.mark.asyncio

GAME = """/** A game for two. */
game
{
    initial_state waiting;
    states playing, /** Somebody has left. */ paused;
    end_state over;
    transitions
    {
        waiting => playing on start;
        playing => paused, over;
        paused => playing on start after 30 s;
    };
};

:playing parallel
{
    states music, moves;
};

:moves
{
    initial_state white;
    states black;
    transitions { white => black; black => white; };
};
"""


def marked(word: str, number: int = 1) -> str:
    at = -1
    for _ in range(number):
        at = GAME.index(word, at + 1)
    return GAME[: at + 1] + "|" + GAME[at + 1 :]


def words(locations: object) -> list[tuple[int, str]]:
    """Line (from 1) and the word there."""
    assert isinstance(locations, list | tuple)
    found = []
    for location in locations:
        line = GAME.splitlines()[location.range.start.line]
        found.append(
            (
                location.range.start.line + 1,
                line[location.range.start.character : location.range.end.character],
            )
        )
    return sorted(found)


COMPLETIONS: list[tuple[str, set[str], set[str]]] = [
    ("game { | };", {"states", "initial_state", "end_state", "transitions"}, {"on", "transition"}),
    ("game { states a, b; transitions { | }; };", {"a", "b"}, {"states", "on"}),
    ("game { states a, b; transitions { a | }; };", set(), {"a", "states", "on"}),
    ("game { states a, b; transitions { a => | }; };", {"a", "b"}, {"states"}),
    ("game { states a, b; transitions { a => b, | }; };", {"a", "b"}, {"on"}),
    ("game { states a, b; transitions { a => b | }; };", {"on", "after"}, {"a", "states"}),
    ("game { states a; transitions { a => a on go; a => a on | }; };", {"go"}, {"a", "after"}),
    ("game { states a; transitions { a => a after 2 | }; };", {"s", "ms", "min"}, {"a"}),
    ("game { states a, b; };\n:|", {"a", "b"}, {"states"}),
    ("game { states a, b; };\n:a { states c; };\n:|", {"b", "c"}, {"a"}),
    ("game { states a; };\n:a | { };", {"parallel"}, {"states"}),
    ("game { states a; };\n:a { states c; transitions { | }; };", {"c"}, {"a"}),
    ("game { states a; };\n:a { states c; transitions { c => | }; };", {"a", "c"}, set()),
    ("game { initial_state |; transitions { here => there; }; };", {"here", "there"}, set()),
    ("game { states a, |; transitions { a => there; }; };", {"there"}, {"a"}),
]  # fmt: skip


async def test_completion_of_smdsl(editor: Editor) -> None:
    for text, expected_labels, unwanted in COMPLETIONS:
        params = lsp.CompletionParams(**editor.at("a.smdsl", text))
        found = await editor.client.text_document_completion_async(params)
        assert isinstance(found, list | tuple)
        labels = {entry.label for entry in found}
        assert expected_labels <= labels, (text, sorted(labels))
        assert not unwanted & labels, (text, unwanted & labels)


HOVERS = [
    ("paused", 2, ["states paused;", "playing => paused;", "paused => playing on start after 30 s;",
     "Somebody has left."]),
    ("playing", 3, [":playing parallel", "states music, moves;", "waiting => playing on start;"]),
    ("start", 1, ["// event start", "waiting => playing on start;", "paused => playing"]),
    ("game", 2, ["initial_state waiting;", "states playing, paused;", "A game for two."]),
]  # fmt: skip


async def test_hover_of_smdsl(editor: Editor) -> None:
    for word, number, parts in HOVERS:
        params = lsp.HoverParams(**editor.at("game.smdsl", marked(word, number)))
        found = await editor.client.text_document_hover_async(params)
        assert found is not None, word
        assert isinstance(found.contents, lsp.MarkupContent)
        for part in parts:
            assert part in found.contents.value, (word, found.contents.value)


async def test_definition_and_references_in_smdsl(editor: Editor) -> None:
    params = lsp.DefinitionParams(**editor.at("game.smdsl", marked("playing", 5)))
    found = await editor.client.text_document_definition_async(params)
    assert words(found) == [(5, "playing")]
    place = editor.place("game.smdsl", marked("start", 2))
    for declared, expected in ((True, [9, 11]), (False, [11])):
        context = lsp.ReferenceContext(include_declaration=declared)
        found = await editor.client.text_document_references_async(
            lsp.ReferenceParams(context, **place)
        )
        assert words(found) == [(line, "start") for line in expected]


async def rename(editor: Editor, word: str, new: str) -> str:
    params = lsp.RenameParams(new_name=new, **editor.at("game.smdsl", marked(word)))
    found = await editor.client.text_document_rename_async(params)
    assert found is not None
    ((uri, edits),) = (found.changes or {}).items()
    assert uri == editor.uri("game.smdsl")
    return edited(list(edits), GAME)


async def test_rename_in_smdsl(editor: Editor) -> None:
    assert await rename(editor, "moves", "turns") == GAME.replace("moves", "turns")
    assert await rename(editor, "start", "begin") == GAME.replace("on start", "on begin")
    # An event may have the name of a state.
    assert "on paused" in await rename(editor, "start", "paused")


@pytest.mark.parametrize(
    ("new", "why"),
    [
        ("black", "another state is named `black`"),
        ("after", "`after` is a keyword of this language"),
        ("Transitions", "`Transitions` is a keyword of this language"),
        ("a b", "`a b` is not a valid name"),
    ],
)
async def test_rename_rejects_invalid_state_names(editor: Editor, new: str, why: str) -> None:
    with pytest.raises(JsonRpcInvalidParams, match=why):
        await rename(editor, "white", new)


async def test_document_symbols_of_smdsl(editor: Editor) -> None:
    document = lsp.TextDocumentIdentifier(editor.open("game.smdsl", GAME))
    found = await editor.client.text_document_document_symbol_async(
        lsp.DocumentSymbolParams(document)
    )
    assert [
        (entry.name, entry.detail, [(child.name, child.detail) for child in entry.children or ()])
        for entry in found or ()
        if isinstance(entry, lsp.DocumentSymbol)
    ] == [
        ("game", "", [("waiting", "initial"), ("playing", ""), ("paused", ""), ("over", "end")]),
        ("playing", "parallel", [("music", ""), ("moves", "")]),
        ("moves", "", [("white", "initial"), ("black", "")]),
    ]


async def test_tokens_folding_and_symbols_of_smdsl(editor: Editor) -> None:
    editor.write("game.smdsl", GAME)
    document = lsp.TextDocumentIdentifier(editor.open("game.smdsl", GAME))
    found = await editor.client.text_document_semantic_tokens_full_async(
        lsp.SemanticTokensParams(document)
    )
    assert found is not None
    kinds = [editor.legend[kind] for kind in found.data[3::5]]
    assert kinds[:5] == ["class", *["enumMember"] * 4]
    assert kinds.count("event") == 2
    folds = await editor.client.text_document_folding_range_async(lsp.FoldingRangeParams(document))
    assert {(fold.start_line, fold.end_line) for fold in folds or ()} == {
        (2, 11), (7, 10), (15, 16), (20, 23)
    }  # fmt: skip
    symbols = await editor.client.workspace_symbol_async(lsp.WorkspaceSymbolParams("whit"))
    assert [symbol.name for symbol in symbols or ()] == ["white"]
