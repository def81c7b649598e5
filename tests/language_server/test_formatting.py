"""Formatting in an editor: small edits with the result of `rcgen fmt`."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException

from tests.language_server.editor_client import Editor

pytestmark = pytest.mark.asyncio

OPTIONS = lsp.FormattingOptions(tab_size=8, insert_spaces=False)
MESSY = """\
/** A face: 🙂, and more. */ Component   face {
  Communications {
      requires Laser,Speech ; /* 🙂 */ /* one */
   implements   Face;  // 🙂 two


    };
	language Python
    period 50 ; };
"""
NEAT = """\
/** A face: 🙂, and more. */ Component face
{
    Communications
    {
        requires Laser, Speech;  /* 🙂 */ /* one */
        implements Face;         // 🙂 two
    };
    language Python
    period 50;
};
"""
XML = (
    '<innerModel><transform id = "a"   tx="1" ><mesh id="🙂"  file="m"/>\n</transform></innerModel>'
)
NEAT_XML = """\
<innerModel>
    <transform id="a" tx="1">
        <mesh id="🙂" file="m"/>
    </transform>
</innerModel>
"""


def apply(text: str, edits: Sequence[lsp.TextEdit]) -> str:
    """`text` after the edits, as a client applies them: the last first."""
    lines = text.split("\n")
    for edit in sorted(edits, key=lambda e: (e.range.start.line, e.range.start.character))[::-1]:
        start, end = edit.range.start, edit.range.end
        before = _cut(lines[start.line], start.character)[0]
        after = _cut(lines[end.line], end.character)[1]
        lines[start.line : end.line + 1] = (before + edit.new_text + after).split("\n")
    return "\n".join(lines)


def _cut(line: str, units: int) -> tuple[str, str]:
    data = line.encode("utf-16-le")
    assert 2 * units <= len(data), "a position behind the end of its line"
    return data[: 2 * units].decode("utf-16-le"), data[2 * units :].decode("utf-16-le")


async def whole(editor: Editor, name: str, text: str) -> list[lsp.TextEdit]:
    document = lsp.TextDocumentIdentifier(editor.open(name, text))
    params = lsp.DocumentFormattingParams(document, OPTIONS)
    return list(await editor.client.text_document_formatting_async(params) or ())


async def lines(editor: Editor, name: str, text: str, first: int, last: int) -> str:
    """`text` with the lines from `first` up to `last`, without that, selected and formatted."""
    document = lsp.TextDocumentIdentifier(editor.open(name, text))
    selected = lsp.Range(lsp.Position(first, 0), lsp.Position(last, 0))
    params = lsp.DocumentRangeFormattingParams(document, selected, OPTIONS)
    return apply(text, list(await editor.client.text_document_range_formatting_async(params) or ()))


@pytest.mark.parametrize(
    ("name", "text", "neat"), [("face.cdsl", MESSY, NEAT), ("world.xml", XML, NEAT_XML)]
)
async def test_formatting_of_whole_file(editor: Editor, name: str, text: str, neat: str) -> None:
    edits = await whole(editor, name, text)
    assert apply(text, edits) == neat
    assert all(edit.new_text.strip() == "" for edit in edits if name != "world.xml")


@pytest.mark.parametrize(("name", "neat"), [("face.cdsl", NEAT), ("world.xml", NEAT_XML)])
async def test_formatting_of_canonical_file_has_no_edits(
    editor: Editor, name: str, neat: str
) -> None:
    assert await whole(editor, name, neat) == []


async def test_formatting_one_change_is_one_edit(editor: Editor) -> None:
    edits = await whole(editor, "face.cdsl", NEAT.replace("period 50", "period  50"))
    assert edits == [lsp.TextEdit(lsp.Range(lsp.Position(8, 11), lsp.Position(8, 12)), "")]


async def test_formatting_keeps_line_ends(editor: Editor) -> None:
    text = NEAT.replace("period 50", "period  50").replace("\n", "\r\n")
    edits = await whole(editor, "face.cdsl", text)
    assert apply(text, edits) == NEAT.replace("\n", "\r\n")


async def test_formatting_skips_file_with_syntax_errors(editor: Editor) -> None:
    assert await whole(editor, "face.cdsl", MESSY.replace("Component", "Component {")) == []


STRUCTS = """\
module M
{
    struct S { int a; };
    struct T { int a }
    struct U { int  b; };
};
"""


async def test_formatting_after_changes(editor: Editor) -> None:
    await whole(editor, "a.idsl", STRUCTS)
    here = lsp.Range(lsp.Position(2, 4), lsp.Position(2, 4))
    added = "enum E { x };\n\n\n"
    editor.change("a.idsl", lsp.TextDocumentContentChangePartial(here, added))
    params = lsp.DocumentFormattingParams(lsp.TextDocumentIdentifier(editor.uri("a.idsl")), OPTIONS)
    edits = await editor.client.text_document_formatting_async(params)
    result = apply(STRUCTS.replace("struct S", added + "struct S"), list(edits or ()))
    neat = "enum E { x };\n\n    struct S"
    assert result == STRUCTS.replace("int  b", "int b").replace("struct S", neat)


async def test_range_formatting(editor: Editor) -> None:
    two = "Component a\n{\n  period   50;\n  threads   2;\n  language   Python;\n};\n"
    assert await lines(editor, "a.cdsl", two, 3, 4) == two.replace("  threads   2", "    threads 2")
    assert await lines(editor, "a.cdsl", two, 5, 6) == two


async def test_formatting_reports_unformattable_file(editor: Editor) -> None:
    fields = "".join(f"    int p{number}\n" for number in range(150))
    with pytest.raises(JsonRpcException, match=r"`a\.idsl` is not formatted: too much") as caught:
        await whole(editor, "a.idsl", f"module M {{ struct S\n{{\n{fields}}}; }};\n")
    assert caught.value.code == lsp.LSPErrorCodes.RequestFailed


async def test_range_formatting_rejects_missing_range(editor: Editor) -> None:
    with pytest.raises(JsonRpcException, match="no line 99"):
        await lines(editor, "a.cdsl", NEAT, 99, 100)
