"""Quick fixes: the text after the edit is what the user wanted."""

from __future__ import annotations

import project
import pytest
from editor_client import Editor, edited
from lsprotocol import types as lsp
from project import FILES

pytestmark = pytest.mark.asyncio

WORD = ("reader.cdsl", ("requires Laser", "requires Lasr"), "Lasr")
CASES = [
    (*WORD, "Change to `Laser`", "requires Laser;"),
    ("reader.cdsl", ('import "Laser.idsl";\n', ""), "Laser", 'Add `import "Laser.idsl";`',
     'import "Laser.idsl";\n'),
    ("Laser.idsl", ("float dist", "floot dist"), "floot", "Change to `float`", "float dist"),
    ("app.ddsl", ("component base;", "component bose;"), "bose", "Change to `base`",
     "component base;"),
]  # fmt: skip


async def actions(
    editor: Editor, name: str, text: str, word: str, only: list[str] | None = None
) -> list[lsp.CodeAction]:
    document = lsp.TextDocumentIdentifier(editor.open(name, text))
    before = text[: text.index(word)]
    start = lsp.Position(before.count("\n"), len(before.rpartition("\n")[2]))
    context = lsp.CodeActionContext([], only=only)
    params = lsp.CodeActionParams(document, lsp.Range(start, start), context)
    found = await editor.client.text_document_code_action_async(params)
    return [one for one in found or () if isinstance(one, lsp.CodeAction)]


def applied(editor: Editor, action: lsp.CodeAction, name: str, text: str) -> str:
    assert action.edit is not None
    assert action.edit.changes is not None
    (edits,) = action.edit.changes.values()
    assert list(action.edit.changes) == [editor.uri(name)]
    return edited(list(edits), text)


async def test_fixes(editor: Editor) -> None:
    project.write(editor)
    for name, (right, wrong), word, title, expected in CASES:
        text = FILES[name].replace(right, wrong, 1)
        found = await actions(editor, name, text, word)
        (one,) = [action for action in found if action.title == title]
        assert expected in applied(editor, one, name, text)
        assert one.kind == lsp.CodeActionKind.QuickFix
        editor.close(name)


async def test_everything_at_once(editor: Editor) -> None:
    project.write(editor)
    text = FILES["Laser.idsl"].replace("float angle", "floot angle").replace("float dist", "reel d")
    text = text.replace("int level", "int32 level")
    (one,) = await actions(editor, "Laser.idsl", text, "module", ["source.fixAll"])
    after = applied(editor, one, "Laser.idsl", text)
    assert "float angle" in after
    assert "int level" in after


async def test_nothing_where_nothing_is_wrong(editor: Editor) -> None:
    project.write(editor)
    assert await actions(editor, "reader.cdsl", FILES["reader.cdsl"], "Laser") == []
