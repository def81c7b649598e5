"""What is said of methods, parameters and operations after a change."""

from __future__ import annotations

import pytest

from tests.regeneration.regenerated import Talker

HEAD = """\
from talker_generated.genericworker import GenericWorker
from talker_generated.interfaces import *

class SpecificWorker(GenericWorker):
"""


def put(talker: Talker, *methods: str) -> None:
    talker.worker.write_text(HEAD + "\n".join(f"    {method}" for method in methods) + "\n")


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
def test_changed_signatures(talker: Talker, case: str) -> None:
    mine, now, expected = SIGNATURES[case]
    put(talker, mine)
    talker.describe(now)
    found = talker.generate()
    assert [d.code.id for d in found] == (["RC615"] if expected else [])
    if found:
        assert expected in found[0].label
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
    "self.params.limits.parts[0].att": "did you mean `at`?",
    "[m.gian for m in self.params.motors]": "did you mean `gain`?",
    "[m.gain for m in self.params.motors]": "",
    "m = self.params.motors[0]; m.gian": "did you mean `gain`?",
    "p = self.params; p.rat": "did you mean `rate`?",
    "p = self.params; l = p.limits; l.lowr": "did you mean `low`?",
    "p = self.params; p = self.other; p.rat": "",
    "p = p.limits; p.lowr": "",
    "[m.gian for i, m in enumerate(self.params.motors)]": "did you mean `gain`?",
    "[m.gian for m, x in zip(self.params.motors[1:], self.other)]": "did you mean `gain`?",
    "[a.att for a in self.params.limits.parts if a.at]": "did you mean `at`?",
    "[[x.att for x in l.parts] for l in [self.params.limits]]": "",
    "return (lambda m: m.gian)(self.params.motors[0])": "",
    "p = self.talk_proxy; p.sayy(1)": "did you mean `say`?",
    "other.params.rat": "",
}


@pytest.mark.parametrize("use", USES)
def test_unknown_members(talker: Talker, use: str) -> None:
    limits = "limits { low int 1; parts[0:2] { at int 1; }; };"
    parameters = f"rate float 1; motors[0:3] {{ gain float 1; }}; {limits}"
    talker.describe("int say(Word w);", parameters=parameters, ports="requires Talk;")
    put(talker, f"def compute(self): {use}")
    found = talker.generate()
    assert [d.label for d in found] == ([USES[use]] if USES[use] else [])
    if found:
        assert found[0].code.id == ("RC617" if "proxy" in use else "RC616")
        assert f".{found[0].span.text}" in use
        assert found[0].span.text not in {"rate", "gain", "low", "at", "say"}


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


def with_machine(talker: Talker, text: str) -> None:
    (talker.folder / "m.smdsl").write_text(text)
    talker.describe("int say(Word w);")
    cdsl = talker.folder / "talker.cdsl"
    cdsl.write_text(cdsl.read_text().replace("language", 'statemachine "m.smdsl"; language'))


MACHINE = "m {{ states a{0}; initial_state b; transitions {{ b => a{0} on start; }}; }};\n"


def test_the_stub_of_a_state_that_was_deleted_stays_deleted(talker: Talker) -> None:
    with_machine(talker, MACHINE.format(1))
    assert [d.span.text for d in talker.generate()] == ["state_b", "state_a1"]
    put(talker, "def Talk_say(self, w): ...")
    assert talker.generate() == []
    (talker.folder / "m.smdsl").write_text(MACHINE.format(2))
    assert [d.span.text for d in talker.generate()] == ["state_a2"]


def test_states_that_come_while_the_file_cannot_be_read_are_not_forgotten(talker: Talker) -> None:
    text = talker.worker.read_text()
    talker.worker.write_text(f"{text}\n    def broken(:\n")
    with_machine(talker, MACHINE.format(1))
    assert [d.code.id for d in talker.generate()] == ["RC613"]
    assert talker.worker.read_text() == f"{text}\n    def broken(:\n"
    talker.worker.write_text(text)
    assert [d.span.text for d in talker.generate()] == ["state_b", "state_a1"]


EVENTS = {
    'self.machine.go("start")': "",
    'self.machine.go("strat", speed=1)': "there is no event `strat`",
    'self.machine.is_in("a1")': "",
    'self.machine.is_in("a2")': "there is no state `a2`",
    'self.machine.is_in("start")': "there is no state `start`",
    "self.machine.go(self.name)": "",
    'self.machine.states.count("x")': "",
    'other.machine.go("x")': "",
}


@pytest.mark.parametrize("use", EVENTS)
def test_unknown_events(talker: Talker, use: str) -> None:
    with_machine(talker, MACHINE.format(1))
    put(talker, f"def compute(self): {use}")
    found = [d for d in talker.generate() if d.code.id == "RC624"]
    assert [d.message for d in found] == ([EVENTS[use]] if EVENTS[use] else [])
    if found:
        assert found[0].span.text in use
        assert found[0].span.text.startswith('"')


HOOKS = {
    "will_set_rate": "",
    "did_set_motors_gain": "",
    "will_set": "",
    "did_set_rat": "there is no parameter `rat`",
    "will_set_motors_gian": "there is no parameter `motors_gian`",
    "will_set_size": "`size` is not live, it never changes",
    "on_enter_a1": "",
    "on_enter_a": "there is no state `a`",
    "on_exit_start": "there is no state `start`",
    "state_machine_is_fine": "",
    "state_waitng": "there is no state `waitng`",
    "helper": "",
}


@pytest.mark.parametrize("hook", HOOKS)
def test_methods_that_nobody_calls(talker: Talker, hook: str) -> None:
    machine = "m { states a1; initial_state waiting; transitions { waiting => a1 on start; }; };\n"
    with_machine(talker, machine)
    parameters = "rate float 1 live; size int 1; motors[0:3] { gain float 1 live; };"
    (talker.folder / "talker.pdsl").write_text(f"ComponentParams talker {{ {parameters} }};\n")
    talker.worker.unlink()
    talker.generate()
    put(talker, f"def {hook}(self, *more): ...", "def Talk_say(self, w): ...")
    found = talker.generate()
    assert [d.message for d in found] == (
        [f"`{hook}` is never called: {HOOKS[hook]}"] if HOOKS[hook] else []
    )
    if found:
        assert found[0].code.id == ("RC616" if "_set_" in hook else "RC624")
        assert found[0].span.text == hook


def test_events_of_a_machine_that_is_gone(talker: Talker) -> None:
    put(talker, 'def compute(self): self.machine.go("start")', "def Talk_say(self, w): ...")
    assert [d.message for d in talker.generate()] == ["there is no state machine"]


def test_patterns_of_events_take_what_they_take_when_it_runs(talker: Talker) -> None:
    scxml = (
        '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" initial="a">'
        '<state id="a"><transition event="arm.moved arm.lost.*" target="b"/></state>'
        '<state id="b"/></scxml>'
    )
    (talker.folder / "m.scxml").write_text(scxml)
    talker.describe("int say(Word w);")
    cdsl = talker.folder / "talker.cdsl"
    cdsl.write_text(cdsl.read_text().replace("language", 'statemachine "m.scxml"; language'))
    events = ("arm.moved", "arm.moved.far", "arm.lost", "arm.lost.x", "arm", "arm.mov")
    put(talker, *(f'def f{i}(self): self.machine.go("{e}")' for i, e in enumerate(events)))
    found = [d.span.text for d in talker.generate() if d.code.id == "RC624"]
    assert found == ['"arm"', '"arm.mov"']


WITHIN = "from talker_generated.genericworker import GenericWorker\nif True:\n    "

# The user's module, and a beside module; what is said of `say`, and where.
ELSEWHERE = {
    "in an if": (f"{WITHIN}class SpecificWorker(GenericWorker): pass\n", "", "at the margin"),
    "another name": (
        f"{HEAD.replace('Specific', 'My')}    pass\nSpecificWorker = MyWorker\n",
        "",
        "`MyWorker` has no method for the operation `say`; this stub was added",
    ),
    "two workers": (
        f"{HEAD.replace('Specific', 'My')}    pass\n\n"
        "class Other(MyWorker):\n    pass\n\nSpecificWorker = Other if True else MyWorker\n",
        "",
        "what its base `SpecificWorker` has cannot be seen here",
    ),
    "the second of two workers": (
        f"{HEAD.replace('Specific', 'My')}    pass\n\nclass SpecificWorker(MyWorker):\n    pass\n",
        "",
        "`SpecificWorker` has no method for the operation `say`; this stub was added",
    ),
    "all in another file": ("from mine import SpecificWorker\n", f"{HEAD}    pass\n", "margin"),
    "a base beside it": (
        f"from mine import Mix as M\n{HEAD.replace('(', '(M, ')}    pass\n",
        "class Mix:\n    def Talk_say(self, w): return 1\n",
        "",
    ),
    "a qualified base beside it": (
        f"import mine\n{HEAD.replace('(', '(mine.Mix, ')}    pass\n",
        "class Mix:\n    def Talk_say(self, w): return 1\n",
        "",
    ),
    "a base that lacks it": (
        f"from mine import Mix\n{HEAD.replace('(', '(Mix, ')}    pass\n",
        "class Mix:\n    def Talk_other(self, w): return 1\n",
        "this stub was added",
    ),
    "an unknown base": (
        f"from enum import Enum as Mix\n{HEAD.replace('(', '(Mix, ')}    pass\n",
        "",
        "what its base `Mix` has cannot be seen here",
    ),
    "in an if in the class": (f"{HEAD}    if True:\n        def Talk_say(s, w): ...\n", "", ""),
    "in a match in the class": (
        f"{HEAD}    match 1:\n        case _:\n            def Talk_say(s, w): ...\n",
        "",
        "",
    ),
    "in a circle": ("from mine import SpecificWorker\n", "from specificworker import *\n", "seen"),
}


@pytest.mark.parametrize("case", ELSEWHERE)
def test_classes_made_elsewhere(talker: Talker, case: str) -> None:
    text, beside, expected = ELSEWHERE[case]
    talker.describe("")
    talker.worker.unlink()
    talker.generate()
    talker.worker.write_text(text)
    (talker.folder / "mine.py").write_text(beside)
    talker.describe("int say(Word w);")
    found = talker.generate()
    assert [d.code.id for d in found] == (["RC611"] if expected else [])
    assert expected in "".join(d.message for d in found)
    if "added" not in expected or "none" in expected:
        assert talker.worker.read_text() == text


def test_what_a_base_beside_the_file_has_is_judged(talker: Talker) -> None:
    beside = talker.folder / "mine.py"
    beside.write_text("class Mix:\n    def Talk_say(self, w) -> int: return self.params.rat\n")
    talker.worker.write_text(f"from mine import Mix\n{HEAD.replace('(', '(Mix, ')}    pass\n")
    talker.describe("int say(Word w, int n);", parameters="rate float 1;")
    found = talker.generate()
    assert {(d.code.id, d.span.text) for d in found} == {("RC615", "Talk_say"), ("RC616", "rat")}
    assert {d.span.source.path for d in found} == {beside}
