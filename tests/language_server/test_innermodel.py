"""InnerModel in an editor: every feature, on an arm that includes its hand."""

from __future__ import annotations

import pytest
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams

from robocomp_dsl.check.innermodel.tags import TAGS
from robocomp_dsl.language_server.completion.innermodel_reference import (
    ATTRIBUTE_MEANINGS,
    describe_attribute,
    describe_tag,
)
from tests.language_server.editor_client import Editor, edited

pytestmark = pytest.mark.asyncio

ARM = """<innerModel>
  <transform id="base" tz="100">
    <joint id="shoulder" axis="x" min="-1.5" max="1.5">
      <motor id="drive" force="12"/>
      <mesh id="shell" file="meshes/shell.obj"/>
      <include path="hand.xml"/>
    </joint>
  </transform>
</innerModel>
"""
HAND = '<innerModel>\n  <transform id="palm" ty="300"/>\n</innerModel>\n'
TEXTS = {"arm.xml": ARM, "hand.xml": HAND}


def write(editor: Editor) -> None:
    for name, text in TEXTS.items():
        editor.write(name, text)
    editor.write("meshes/shell.obj", "v 0 0 0\n")


def marked(word: str) -> str:
    at = ARM.index(word)
    return ARM[: at + 1] + "|" + ARM[at + 1 :]


IN = "<innerModel>{}</innerModel>"
COMPLETIONS: list[tuple[str, set[str], set[str]]] = [
    ("|", {"<innerModel"}, {"<joint"}),
    ("<|", {"innerModel"}, {"joint"}),
    (IN.format("<|"), {"transform", "joint", "mesh", "include"}, {"innerModel", "tx"}),
    (IN.format("<tra|"), {"transform", "joint"}, {"<transform"}),
    (IN.format("|"), {"<transform", "</innerModel>"}, {"transform"}),
    (IN.format('<mesh id="a">|'), {"</mesh>"}, {"<transform", "<mesh"}),
    (IN.format('<transform id="a"></|'), {"transform>"}, {"innerModel>"}),
    (IN.format('<transform id="a"><joint/><|'), {"/transform>", "joint"}, {"/joint>"}),
    (IN.format('<joint id="a" |/>'), {"axis", "min", "tx"}, {"id", "file"}),
    (IN.format('<joint id="a" a|/>'), {"axis"}, {"id"}),
    (IN.format('<joint | id="a"/>'), {"axis"}, {"id"}),
    (IN.format('<joint axis="|"/>'), {"x", "y", "z"}, {"axis"}),
    (IN.format("<joint axis='|'/>"), {"x", "y", "z"}, {"axis"}),
    (IN.format('<joint max="|"/>'), {"inf"}, {"x"}),
    (IN.format('<transform tx="|"/>'), {"0"}, {"inf"}),
    (IN.format('<transform tx="2.5|"/>'), {"2.5 m", "2.5 mm"}, {"0"}),
    (IN.format('<transform rx="90 |"/>'), {"90 deg"}, {"90 mm"}),
    (IN.format('<mesh collide="|"/>'), {"0", "1"}, {"true"}),
    (IN.format('<mesh file="|"/>'), {"meshes/"}, {"hand.xml"}),
    (IN.format('<mesh file="meshes/|"/>'), {"meshes/shell.obj"}, {"meshes/"}),
    (IN.format('<include path="|"/>'), {"hand.xml"}, {"meshes/shell.obj"}),
    (IN.format('<transform id="a"|'), set(), {"tx", "<joint"}),
    (IN.format("<!-- <| -->"), set(), {"transform"}),
    (IN.format("<!-- <joint> --><|"), {"transform", "/innerModel>"}, {"/joint>"}),
]  # fmt: skip


async def test_completion_of_innermodel(editor: Editor) -> None:
    write(editor)
    for text, expected_labels, unwanted in COMPLETIONS:
        params = lsp.CompletionParams(**editor.at("a.xml", text))
        found = await editor.client.text_document_completion_async(params)
        assert isinstance(found, list | tuple)
        labels = {entry.label for entry in found}
        assert expected_labels <= labels, (text, sorted(labels))
        assert not unwanted & labels, (text, unwanted & labels)


async def test_completion_edits_of_innermodel(editor: Editor) -> None:
    text = IN.format('<joint id="a" ax|="x"/>')
    params = lsp.CompletionParams(**editor.at("a.xml", text))
    found = await editor.client.text_document_completion_async(params)
    assert isinstance(found, list | tuple)
    (item,) = [entry for entry in found if entry.label == "offset"] or [None]
    assert item is None  # a slide has it, a joint does not
    (item,) = [entry for entry in found if entry.label == "home"]
    assert isinstance(item.text_edit, lsp.TextEdit)
    assert edited([item.text_edit], text.replace("|", "")) == IN.format('<joint id="a" home="x"/>')
    assert isinstance(item.documentation, lsp.MarkupContent)
    assert "default: its angle about `axis`" in item.documentation.value


HOVERS = [
    ("joint", ["A hinge about `axis`"]),
    ("innerModel", ["the root of all nodes"]),
    ("tz=", ["translation along z, ahead", "a length: a number of mm", "Default: `0`"]),
    ("axis", ["Takes one of `x`, `y`, `z`.", "Default: `z`"]),
    ("min=", ["lower end of the range", "Default: `-inf`"]),
    ("path=", ["the file whose nodes are inserted here"]),
    ("shoulder", ['<joint id="shoulder" axis="x" min="-1.5" max="1.5">', '<motor id="drive"/>',
     '<transform id="palm"/>']),
    ("base", ['<transform id="base" tz="100">']),
]  # fmt: skip


async def test_hover_of_innermodel(editor: Editor) -> None:
    write(editor)
    for word, parts in HOVERS:
        params = lsp.HoverParams(**editor.at("arm.xml", marked(word)))
        found = await editor.client.text_document_hover_async(params)
        assert found is not None, word
        assert isinstance(found.contents, lsp.MarkupContent)
        for part in parts:
            assert part in found.contents.value, (word, found.contents.value)


async def test_innermodel_reference_describes_every_tag_and_attribute() -> None:
    for tag, known in TAGS.items():
        assert describe_tag(tag), tag
        for name in known.attributes:
            unused = tag == "joint" and name in ("lx", "ly", "lz", "hx", "hy", "hz")
            unused |= tag == "axes" and name not in ("id", "length", "width")
            assert unused or name in ATTRIBUTE_MEANINGS, (tag, name)
            assert name in describe_attribute(tag, name)


async def test_definition_of_ids_and_files(editor: Editor) -> None:
    write(editor)
    for word, uri, line in (
        ("shoulder", "arm.xml", 2),
        ("hand.xml", "hand.xml", 0),
        ("meshes/shell.obj", "meshes/shell.obj", 0),
    ):
        params = lsp.DefinitionParams(**editor.at("arm.xml", marked(word)))
        (found,) = await editor.client.text_document_definition_async(params) or ()
        assert isinstance(found, lsp.Location)
        assert (found.uri, found.range.start.line) == (editor.uri(uri), line)


async def test_document_links_of_innermodel(editor: Editor) -> None:
    write(editor)
    text = ARM.replace('path="hand.xml"', 'path="/home/robocomp/old/hand.xml"')
    document = lsp.TextDocumentIdentifier(editor.open("arm.xml", text))
    found = await editor.client.text_document_document_link_async(lsp.DocumentLinkParams(document))
    targets = [entry.target for entry in found or ()]
    assert targets == [editor.uri("meshes/shell.obj"), editor.uri("hand.xml")]


async def rename(editor: Editor, word: str, new: str) -> str:
    params = lsp.RenameParams(new_name=new, **editor.at("arm.xml", marked(word)))
    found = await editor.client.text_document_rename_async(params)
    assert found is not None
    ((uri, edits),) = (found.changes or {}).items()
    assert uri == editor.uri("arm.xml")
    return edited(list(edits), ARM)


async def test_rename_of_node_id(editor: Editor) -> None:
    write(editor)
    assert await rename(editor, "shoulder", "left arm") == ARM.replace("shoulder", "left arm")
    assert await rename(editor, "drive", "struct") == ARM.replace("drive", "struct")
    place = editor.place("arm.xml", marked("shoulder"))
    prepared = await editor.client.text_document_prepare_rename_async(
        lsp.PrepareRenameParams(**place)
    )
    assert isinstance(prepared, lsp.PrepareRenamePlaceholder)
    assert prepared.placeholder == "shoulder"
    context = lsp.ReferenceContext(include_declaration=True)
    found = await editor.client.text_document_references_async(
        lsp.ReferenceParams(context, **place)
    )
    assert [entry.range.start.line for entry in found or ()] == [2]


@pytest.mark.parametrize(
    ("new", "why"),
    [
        ("base", "another node is named `base`"),
        ("palm", "another node is named `palm`, at .*hand.xml:2"),
        ("root", "`root` is reserved for the root frame"),
        ('a"b', "is not a valid id"),
        (" a", "is not a valid id"),
        ("", "is not a valid id"),
    ],
)
async def test_rename_rejects_invalid_node_id(editor: Editor, new: str, why: str) -> None:
    write(editor)
    with pytest.raises(JsonRpcInvalidParams, match=why):
        await rename(editor, "shoulder", new)


async def test_rename_rejects_node_id_of_including_file(editor: Editor) -> None:
    write(editor)
    editor.open("arm.xml", ARM)
    text = HAND.replace("palm", "pa|lm")
    with pytest.raises(
        JsonRpcInvalidParams, match=r"another node is named `shoulder`, at .*arm\.xml:3"
    ):
        await editor.client.text_document_rename_async(
            lsp.RenameParams(new_name="shoulder", **editor.at("hand.xml", text))
        )


async def test_outline_folding_and_tokens_of_innermodel(editor: Editor) -> None:
    write(editor)
    document = lsp.TextDocumentIdentifier(editor.open("arm.xml", ARM))
    (root,) = (
        await editor.client.text_document_document_symbol_async(lsp.DocumentSymbolParams(document))
        or ()
    )
    assert isinstance(root, lsp.DocumentSymbol)
    (base,) = root.children or ()
    (shoulder,) = base.children or ()
    assert (base.name, base.detail, shoulder.name) == ("base", "transform", "shoulder")
    assert [child.name for child in shoulder.children or ()] == ["drive", "shell", "include"]
    folds = await editor.client.text_document_folding_range_async(lsp.FoldingRangeParams(document))
    assert sorted((fold.start_line, fold.end_line) for fold in folds or ()) == [
        (0, 7),
        (1, 6),
        (2, 5),
    ]
    tokens = await editor.client.text_document_semantic_tokens_full_async(
        lsp.SemanticTokensParams(document)
    )
    assert tokens is not None
    assert len(tokens.data) == 5 * 4  # one for each id
    symbols = await editor.client.workspace_symbol_async(lsp.WorkspaceSymbolParams("shldr"))
    assert [symbol.name for symbol in symbols or ()] == ["shoulder"]
