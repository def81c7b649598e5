"""Stubs: their place and text; user code does not change."""

from __future__ import annotations

import ast

import pytest

from tests.regeneration.talker_component import TalkerComponent

HEAD = "from talker_generated.genericworker import GenericWorker\n"

# The module of the user, and the expected text after `say` and `sing` are added.
CASES = {
    "spaces": (
        f"{HEAD}\n\nclass SpecificWorker(GenericWorker):\n    x = 1  # one\n\n# the end\n",
        "    x = 1  # one\n\n    def Talk_say(self, w: Word) -> int:\n        ",
    ),
    "two spaces": (
        f"{HEAD}class SpecificWorker(GenericWorker):\n  def initialize(self):\n    pass\n",
        "    pass\n\n  def Talk_say(self, w: Word) -> int:\n    ",
    ),
    "tabs": (
        f"{HEAD}class SpecificWorker(GenericWorker):\n\tdef initialize(self):\n\t\tpass\n",
        "\t\tpass\n\n\tdef Talk_say(self, w: Word) -> int:\n\t\t",
    ),
    "one line": (
        f"{HEAD}class SpecificWorker(GenericWorker): pass\nx = 1\n",
        "(GenericWorker): \n    pass\n\n    def Talk_say(self, w: Word) -> int:\n        ",
    ),
    "no line end": (
        f"{HEAD}class SpecificWorker(GenericWorker):\n    x = 1",
        "    x = 1\n\n    def Talk_say(self, w: Word) -> int:\n        ",
    ),
    "carriage returns": (
        f"{HEAD}class SpecificWorker(GenericWorker):\n    x = 1\n".replace("\n", "\r\n"),
        "    x = 1\r\n\r\n    def Talk_say(self, w: Word) -> int:\r\n        ",
    ),
    "decorators and helpers": (
        (
            f"{HEAD}@final\nclass SpecificWorker(GenericWorker):\n    @property\n    def a(self):\n"
            "        return [\n  1,\n ]\n\n\nclass Helper:\n    pass\n"
        ),
        " ]\n\n    def Talk_say(self, w: Word) -> int:\n        ",
    ),
    "an alias": (
        (
            f"{HEAD}from talker_generated.interfaces import Word as W\n"
            "class SpecificWorker(GenericWorker):\n    pass\n"
        ),
        "    pass\n\n    def Talk_say(self, w: W) -> int:\n        ",
    ),
    "another Word": (
        f"{HEAD}class Word: pass\nclass SpecificWorker(GenericWorker):\n    pass\n",
        "    pass\n\n    def Talk_say(self, w: generated_interfaces.Word) -> int:\n        ",
    ),
    "everything": (
        (
            f"{HEAD}from talker_generated.interfaces import *\n"
            "class SpecificWorker(GenericWorker):\n    pass\n"
        ),
        "    pass\n\n    def Talk_say(self, w: Word) -> int:\n        ",
    ),
    "a mark of the encoding": (
        f"\ufeff{HEAD}class SpecificWorker(GenericWorker):\n    x = 'ä'\n",
        "    x = 'ä'\n\n    def Talk_say(self, w: Word) -> int:\n        ",
    ),
}


def is_within(before: str, after: str) -> bool:
    """Whether all characters of one text are in the other, in order."""
    rest = iter(after)
    return all(c in rest for c in before)


@pytest.mark.parametrize("case", CASES)
def test_stub_is_appended_to_worker_class(talker: TalkerComponent, case: str) -> None:
    before, inside = CASES[case]
    talker.worker.write_bytes(before.encode())
    talker.describe("int say(Word w); [command] void sing(Word w, Tone t);")
    found = talker.generate()
    assert [d.code.id for d in found] == ["RC611", "RC611"]
    assert [d.span.text for d in found] == ["Talk_say", "Talk_sing"]
    after = talker.worker.read_bytes().decode()
    assert inside in after
    assert is_within(before, after)
    assert ("\r\n" in before) == ("\r\n" in after)
    if "\r\n" in before:
        assert "\n" not in after.replace("\r\n", "")
    if "final" not in before:
        talker.check_import()
    ast.parse(after.removeprefix("\ufeff"))
    assert talker.generate() == []
    assert talker.worker.read_bytes().decode() == after


def test_stub_keeps_declared_encoding(talker: TalkerComponent) -> None:
    text = f"# -*- coding: latin-1 -*-\n{HEAD}class SpecificWorker(GenericWorker):\n    x = 'ä'\n"
    talker.worker.write_bytes(text.encode("latin-1"))
    assert [d.code.id for d in talker.generate()] == ["RC611"]
    after = talker.worker.read_bytes()
    assert is_within(text, after.decode("latin-1"))
    assert b"def Talk_say" in after
    talker.check_import()


def test_stub_is_not_added_to_file_with_syntax_error(talker: TalkerComponent) -> None:
    talker.worker.write_bytes(b"class SpecificWorker(GenericWorker):\n  def x(:\n")
    talker.describe("void other();")
    (found,) = talker.generate()
    assert found.code.id == "RC613"
    assert found.span.start_position == (2, 9)
    assert talker.worker.read_bytes() == b"class SpecificWorker(GenericWorker):\n  def x(:\n"


def test_stub_is_not_written_through_link(talker: TalkerComponent) -> None:
    target = talker.folder.parent / "mine.py"
    target.write_text(f"{HEAD}class SpecificWorker(GenericWorker):\n    pass\n")
    talker.worker.unlink()
    talker.worker.symlink_to(target)
    before = target.read_bytes()
    (found,) = talker.generate()
    assert (found.code.id, found.span.text) == ("RC611", "SpecificWorker")
    assert "the file is a link" in found.message
    assert target.read_bytes() == before
    assert talker.worker.is_symlink()


def test_stub_is_not_added_to_read_only_file(talker: TalkerComponent) -> None:
    talker.worker.write_text(f"{HEAD}class SpecificWorker(GenericWorker):\n    pass\n")
    talker.worker.chmod(0o444)
    before = talker.worker.read_bytes()
    (found,) = talker.generate()
    assert "the file is read-only, so none is added" in found.message
    assert talker.worker.read_bytes() == before


LOOKALIKES = {
    "a remark": "# def Talk_say(self)\n",
    "a text": "x = '''\n    def Talk_say(self): ...\n'''\n",
    "another class": "class Other:\n    def Talk_say(self): ...\n",
}


@pytest.mark.parametrize("case", LOOKALIKES)
def test_stub_finding_has_position_of_stub(talker: TalkerComponent, case: str) -> None:
    text = f"{HEAD}{LOOKALIKES[case]}class SpecificWorker(GenericWorker):\n    pass\n"
    talker.worker.write_text(text + LOOKALIKES[case])
    (found,) = talker.generate()
    lines = talker.worker.read_text().splitlines()
    row, column = found.span.start_position
    assert lines[row - 1][column - 1 :].startswith("Talk_say(self, w: Word) -> int:")
    assert lines[row - 2] == "", "the blank line before a stub"


@pytest.mark.parametrize(
    ("operation", "stub"),
    [
        ("Word two();", "def Talk_two(self) -> generated_interfaces.Word:\n"),
        ("Word say(out int n);", "def Talk_say(self) -> tuple[generated_interfaces.Word, int]:\n"),
        (
            "Word say(Word Word);",
            "def Talk_say(self, Word: generated_interfaces.Word) -> generated_interfaces.Word:\n",
        ),
    ],
)
def test_stub_uses_local_names_of_types(talker: TalkerComponent, operation: str, stub: str) -> None:
    text = f"{HEAD}class Word: pass\nclass SpecificWorker(GenericWorker):\n    pass\n"
    talker.worker.write_text(text)
    talker.describe(operation)
    talker.generate()
    assert stub in talker.worker.read_text()
    talker.check_import()
