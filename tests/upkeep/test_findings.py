"""What is said of methods, parameters and operations after a change."""

from __future__ import annotations

import pytest
from regenerated import Talker

HEAD = """\
from generated.genericworker import GenericWorker
from generated.interfaces import *

class SpecificWorker(GenericWorker):
"""


def put(talker: Talker, *methods: str) -> None:
    talker.worker.write_text(HEAD + "\n".join(f"    {one}" for one in methods) + "\n")


# What the user has, what the operation was and is, and what is said.
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
        "it gets 2 arguments",
    ),
    "one less": ("def Talk_say(self, w: Word) -> int: ...", "int say();", "it gets 0 arguments"),
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
    "keyword only": (
        "def Talk_say(self, w, *, loud): ...",
        "int say(Word w);",
        "it gets 1 argument",
    ),
    "asynchronous": ("async def Talk_say(self, w: Word): ...", "int say(Tone w);", "type Tone"),
}


@pytest.mark.parametrize("case", SIGNATURES)
def test_changed_signatures(talker: Talker, case: str) -> None:
    mine, now, said = SIGNATURES[case]
    put(talker, mine)
    talker.describe(now)
    found = talker.generate()
    assert [d.code.id for d in found] == (["RC615"] if said else [])
    if found:
        assert said in found[0].label
        assert found[0].span.text == "Talk_say"
        assert "old: def Talk_say(self" in found[0].help
        assert "new: def Talk_say(self" in found[0].help
        again = talker.generate()
        assert [d.label for d in again] == [found[0].label], "it is said until it is mended"


def test_stale_until_it_is_gone(talker: Talker) -> None:
    put(talker, "def Talk_say(self, w: Word) -> int: return 1")
    talker.describe("int speak(Word w);")
    added, stale = sorted(talker.generate(), key=lambda d: d.code.id)
    assert (added.code.id, added.span.text) == ("RC611", "Talk_speak")
    assert (stale.code.id, stale.span.text) == ("RC614", "Talk_say")
    assert [d.code.id for d in talker.generate()] == ["RC614"]
    text = talker.worker.read_text()
    talker.worker.write_text(text.replace("    def Talk_say(self, w: Word) -> int: return 1\n", ""))
    assert talker.generate() == []
    talker.worker.write_text(text)
    assert talker.generate() == [], "a method of a name that was never generated is the user's"


def test_a_port_that_is_gone(talker: Talker) -> None:
    talker.describe("int say(Word w);", ports="implements Talk; subscribesTo Ear;")
    assert [d.span.text for d in talker.generate()] == ["Ear_heard"]
    talker.describe("int say(Word w);")
    assert [(d.code.id, d.span.text) for d in talker.generate()] == [("RC614", "Ear_heard")]


def test_renamed_is_offered(talker: Talker) -> None:
    put(talker, "def Talk_say(self, w: Word) -> int: return 1", "def Talk_sya(self, w): ...")
    assert talker.generate() == []
    talker.describe("int says(Word w);")
    stale = [d for d in talker.generate() if d.code.id == "RC614"]
    assert [d.span.text for d in stale] == ["Talk_say"]


USES = {
    "self.params.rate": "",
    "self.params.rat": "did you mean `rate`?",
    "self.params.motors[0].gain": "",
    "self.params.motors[0].gian": "did you mean `gain`?",
    "self.params.motors[1:].gian": "",
    "self.params.motors.append": "",
    "self.params.set({})": "",
    "self.params.limits.low": "",
    "self.params.limits.lowr": "did you mean `low`?",
    "self.talk_proxy.say(1)": "",
    "self.talk_proxy.sayy(1)": "did you mean `say`?",
    "self.talk_proxy.wait_for_server(1)": "",
    "self.other.sayy(1)": "",
    "other.params.rat": "",
}


@pytest.mark.parametrize("use", USES)
def test_unknown_members(talker: Talker, use: str) -> None:
    parameters = "rate float 1; motors[0:3] { gain float 1; }; limits { low int 1; };"
    talker.describe("int say(Word w);", parameters=parameters, ports="requires Talk;")
    put(talker, f"def compute(self): {use}")
    found = talker.generate()
    assert [d.label for d in found] == ([USES[use]] if USES[use] else [])
    if found:
        assert found[0].code.id == ("RC617" if "proxy" in use else "RC616")
        assert use.split("(", maxsplit=1)[0].endswith(found[0].span.text)


def test_a_damaged_record(talker: Talker) -> None:
    (talker.folder / ".rcgen" / "methods.json").write_text("<<<<<<<")
    assert [d.code.id for d in talker.generate()] == ["RC620"]
    assert talker.generate() == []


def test_states_come_and_go(talker: Talker) -> None:
    machine = "m {{ states a{0}; initial_state b; transitions {{ b => a{0}; }}; }};\n"
    (talker.folder / "m.smdsl").write_text(machine.format(1))
    talker.describe("int say(Word w);")
    cdsl = talker.folder / "talker.cdsl"
    cdsl.write_text(cdsl.read_text().replace("language", 'statemachine "m.smdsl"; language'))
    assert [d.span.text for d in talker.generate()] == ["state_b", "state_a1"]
    text = talker.worker.read_text() + "\n    def on_exit_a1(self): ...\n"
    talker.worker.write_text(text)
    assert talker.generate() == []
    (talker.folder / "m.smdsl").write_text(machine.format(2))
    found = {d.span.text: d.code.id for d in talker.generate()}
    assert found == {"state_a2": "RC611", "state_a1": "RC614", "on_exit_a1": "RC614"}
    talker.imports()
