"""Findings about methods of changed, removed and renamed operations."""

from __future__ import annotations

import pytest

from tests.regeneration.talker_component import TalkerComponent, write_worker

# Method of the user, changed operation, and expected label.
SIGNATURES = {
    "as it was": ("def Talk_say(self, w: Word) -> int: ...", "int say(Tone w);", "is of type Tone"),
    "another name": ("def Talk_say(self, w: Word) -> int: ...", "int say(Word v);", "`w` is `v`"),
    "another result": (
        "def Talk_say(self, w: Word) -> int: ...",
        "float say(Word w);",
        "it returns float",
    ),
    "one more": (
        "def Talk_say(self, w: Word) -> int: ...",
        "int say(Word w, int n);",
        "it is called with 2 arguments",
    ),
    "one less": (
        "def Talk_say(self, w: Word) -> int: ...",
        "int say();",
        "it is called with 0 arguments",
    ),
    "own words": ("def Talk_say(self, word, *more): ...", "int say(Tone v);", ""),
    "quoted": ("def Talk_say(self, w: 'Word') -> int: ...", "int say(Tone w);", "of type Tone"),
    "qualified": (
        "def Talk_say(self, w: interfaces.Word) -> 'int': ...",
        "int say(Tone w);",
        "is of type Tone",
    ),
    "own annotations": ("def Talk_say(self, words: object): ...", "int say(Tone w);", ""),
    "followed": ("def Talk_say(self, w: Tone) -> int: ...", "int say(Tone w);", ""),
    "wrapped": ("@wrap\n    def Talk_say(self): ...", "int say(Tone w);", ""),
    "wrapped as it was": (
        "@wrap\n    def Talk_say(self, w: Word): ...",
        "int say(Tone w);",
        "Tone",
    ),
    "wrapped, and one more": (
        "@wrap\n    def Talk_say(self, w): ...",
        "int say(Word w, int n);",
        "it is called with 2 arguments",
    ),
    "wrapped for anything": ("@wrap\n    def Talk_say(self, *a): ...", "int say(Tone v);", ""),
    "keyword only": (
        "def Talk_say(self, w, *, loud): ...",
        "int say(Word w);",
        "it is called with 1 argument",
    ),
    "asynchronous": ("async def Talk_say(self, w: Word): ...", "int say(Tone w);", "type Tone"),
}


@pytest.mark.parametrize("case", SIGNATURES)
def test_signature_finding_after_operation_change(talker: TalkerComponent, case: str) -> None:
    method, operation, expected = SIGNATURES[case]
    write_worker(talker, method)
    talker.describe(operation)
    found = talker.generate()
    assert [d.code.id for d in found] == (["RC615"] if expected else [])
    if found:
        assert expected in found[0].label
        assert found[0].span.text == "Talk_say"
        assert "old: def Talk_say(self" in found[0].help
        assert "new: def Talk_say(self" in found[0].help
        again = talker.generate()
        assert [d.label for d in again] == [found[0].label], "reported until fixed"


def test_stale_method_is_reported_until_removed(talker: TalkerComponent) -> None:
    write_worker(talker, "def Talk_say(self, w: Word) -> int: return 1")
    talker.describe("int speak(Word w);")
    added, stale = sorted(talker.generate(), key=lambda d: d.code.id)
    assert (added.code.id, added.span.text) == ("RC611", "Talk_speak")
    assert (stale.code.id, stale.span.text) == ("RC614", "Talk_say")
    assert [d.code.id for d in talker.generate()] == ["RC614"]
    text = talker.worker.read_text()
    talker.worker.write_text(text.replace("    def Talk_say(self, w: Word) -> int: return 1\n", ""))
    assert talker.generate() == []
    talker.worker.write_text(text)
    assert talker.generate() == [], "a method that was never generated belongs to the user"


def test_method_of_removed_port_is_stale(talker: TalkerComponent) -> None:
    talker.describe("int say(Word w);", ports="implements Talk; subscribesTo Ear;")
    assert [d.span.text for d in talker.generate()] == ["Ear_heard"]
    talker.describe("int say(Word w);")
    assert [(d.code.id, d.span.text) for d in talker.generate()] == [("RC614", "Ear_heard")]


def test_renamed_operation_reports_stale_method(talker: TalkerComponent) -> None:
    write_worker(
        talker, "def Talk_say(self, w: Word) -> int: return 1", "def Talk_sya(self, w): ..."
    )
    assert talker.generate() == []
    talker.describe("int says(Word w);")
    stale = [d for d in talker.generate() if d.code.id == "RC614"]
    assert [d.span.text for d in stale] == ["Talk_say"]


def test_damaged_method_record_is_reported_once(talker: TalkerComponent) -> None:
    (talker.folder / ".rcgen" / "methods.json").write_text("<<<<<<<")
    assert [d.code.id for d in talker.generate()] == ["RC620"]
    assert talker.generate() == []
