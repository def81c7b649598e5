"""Quick fixes: the text after the edit."""

from __future__ import annotations

import subprocess

import pytest
from lsprotocol import types as lsp

from tests.language_server import project
from tests.language_server.editor_client import SERVER, Editor, edited
from tests.language_server.project import FILES

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
    return [action_ for action_ in found or () if isinstance(action_, lsp.CodeAction)]


def applied(editor: Editor, action: lsp.CodeAction, name: str, text: str) -> str:
    assert action.edit is not None
    assert action.edit.changes is not None
    (edits,) = action.edit.changes.values()
    assert list(action.edit.changes) == [editor.uri(name)]
    return edited(list(edits), text)


async def test_code_actions_apply_fixes(editor: Editor) -> None:
    project.write(editor)
    for name, (right, wrong), word, title, expected in CASES:
        text = FILES[name].replace(right, wrong, 1)
        found = await actions(editor, name, text, word)
        (action_,) = [action for action in found if action.title == title]
        assert expected in applied(editor, action_, name, text)
        assert action_.kind == lsp.CodeActionKind.QuickFix
        editor.close(name)


GUESSES = [
    ("a.smdsl", "game { initial_state first; states second; transitions { first => secnd; }; };\n",
     "secnd", "Change to `second`", "first => second;"),
    ("a.xml", "<innerModel>\n<transfrm id='a'>\n</transfrm>\n</innerModel>\n", "transfrm",
     "Change to `transform`", "<transform id='a'>\n</transform>"),
    ("a.xml", "<innerModel>\n<transform id='a' Tx='1'/>\n</innerModel>\n", "Tx=",
     "Change to `tx`", "tx='1'"),
    ("a.xml", "<innerModel>\n<mesh id='a' file='b' render='norml'/>\n</innerModel>\n", "'norml",
     "Change to `normal`", "render='normal'"),
]  # fmt: skip


MISSPELLED = """\
game { initial_state first; states secnd; transitions { first => second; second => first; }; };
"""


async def test_misspelled_declaration_has_its_uses_and_a_quick_fix(editor: Editor) -> None:
    editor.open("a.smdsl", MISSPELLED)
    (found,) = await editor.until("a.smdsl", bool)
    assert found.message.startswith("`secnd` is declared, but `second` is used")
    assert MISSPELLED[found.range.start.character :].startswith("secnd;")
    uses = [related.location.range for related in found.related_information or ()]
    assert [MISSPELLED[use.start.character : use.end.character] for use in uses] == ["second"] * 2
    (action,) = await actions(editor, "a.smdsl", MISSPELLED, "secnd", [lsp.CodeActionKind.QuickFix])
    assert action.title == "Change to `second`"
    assert "states second;" in applied(editor, action, "a.smdsl", MISSPELLED)


async def test_code_actions_apply_suggestions(editor: Editor) -> None:
    for name, text, word, title, expected in GUESSES:
        found = await actions(editor, name, text, word)
        titles = [action.title for action in found]
        assert title in titles, (text, titles)
        assert expected in applied(editor, found[titles.index(title)], name, text)
        editor.close(name)


async def test_code_actions_import_every_declaring_file(editor: Editor) -> None:
    project.write(editor)
    editor.write("Other.idsl", FILES["Laser.idsl"].replace("Scans", "Other"))
    text = FILES["reader.cdsl"].replace('import "Laser.idsl";\n', "")
    found = await actions(editor, "reader.cdsl", text, "Laser")
    titles = {action_.title for action_ in found}
    assert {'Add `import "Laser.idsl";`', 'Add `import "Other.idsl";`'} <= titles
    assert not any(action_.is_preferred for action_ in found)


async def test_code_action_applies_all_fixes_of_file(editor: Editor) -> None:
    project.write(editor)
    text = FILES["Laser.idsl"].replace("float angle", "floot angle").replace("float dist", "reel d")
    text = text.replace("int level", "int32 level")
    found = await actions(editor, "Laser.idsl", text, "floot")
    (action_,) = [each for each in found if each.title.startswith("Apply all ")]
    after = applied(editor, action_, "Laser.idsl", text)
    assert "float angle" in after
    assert "int level" in after


LEGACY = """import "Laser.idsl";
Component reader
{
    Communications { requires Laser; };
    language Python;
    gui Qt(QWidget);
};
"""


async def test_fix_all_equals_check_fix(editor: Editor) -> None:
    project.write(editor)
    text = "import 'Laser.idsl'\n" + LEGACY.partition("\n")[2].replace("requires", "REQUIRES")
    text = text.replace("Laser;", "Lasr;")
    path = editor.folder / "reader.cdsl"
    editor.write("reader.cdsl", text)
    subprocess.run([*SERVER[:-1], "check", "--fix", str(path)], check=False, capture_output=True)
    expected = path.read_text(encoding="utf-8")
    assert expected != text
    editor.write("reader.cdsl", text)
    for kind in ("source.fixAll", "source.fixAll.rcgen", "source"):
        (action_,) = await actions(editor, "reader.cdsl", text, "Component", [kind])
        assert action_.kind == "source.fixAll.rcgen"
        assert applied(editor, action_, "reader.cdsl", text) == expected
    assert "Lasr" in expected  # what is a guess is not taken
    assert await actions(editor, "reader.cdsl", expected, "Component", ["source.fixAll"]) == []


async def test_code_actions_are_empty_without_findings(editor: Editor) -> None:
    project.write(editor)
    assert await actions(editor, "reader.cdsl", FILES["reader.cdsl"], "Laser") == []
