"""Stubs and findings of states and events of the state machine."""

from __future__ import annotations

import pytest

from tests.regeneration.talker_component import MACHINE, TalkerComponent, add_machine, write_worker


def test_state_changes_add_stubs_and_report_stale_methods(talker: TalkerComponent) -> None:
    machine = "m {{ states a{0}; initial_state b; transitions {{ b => a{0}; }}; }};\n"
    add_machine(talker, machine.format(1))
    assert [d.span.text for d in talker.generate()] == ["state_b", "state_a1"]
    text = talker.worker.read_text() + "\n    def on_exit_a1(self): ...\n"
    talker.worker.write_text(text)
    assert talker.generate() == []
    (talker.folder / "m.smdsl").write_text(machine.format(2))
    found = {d.span.text: d.code.id for d in talker.generate()}
    assert found == {"state_a2": "RC611", "state_a1": "RC614", "on_exit_a1": "RC614"}
    talker.check_import()


def test_deleted_state_stub_is_not_added_again(talker: TalkerComponent) -> None:
    add_machine(talker, MACHINE.format(1))
    assert [d.span.text for d in talker.generate()] == ["state_b", "state_a1"]
    write_worker(talker, "def Talk_say(self, w): ...")
    assert talker.generate() == []
    (talker.folder / "m.smdsl").write_text(MACHINE.format(2))
    assert [d.span.text for d in talker.generate()] == ["state_a2"]


def test_state_stubs_are_added_after_syntax_error_is_fixed(talker: TalkerComponent) -> None:
    text = talker.worker.read_text()
    talker.worker.write_text(f"{text}\n    def broken(:\n")
    add_machine(talker, MACHINE.format(1))
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
def test_unknown_events_and_states_are_reported(talker: TalkerComponent, use: str) -> None:
    add_machine(talker, MACHINE.format(1))
    write_worker(talker, f"def compute(self): {use}")
    found = [d for d in talker.generate() if d.code.id == "RC624"]
    assert [d.message for d in found] == ([EVENTS[use]] if EVENTS[use] else [])
    if found:
        assert found[0].span.text in use
        assert found[0].span.text.startswith('"')


def test_event_without_state_machine_is_reported(talker: TalkerComponent) -> None:
    write_worker(
        talker, 'def compute(self): self.machine.go("start")', "def Talk_say(self, w): ..."
    )
    assert [d.message for d in talker.generate()] == ["there is no state machine"]


def test_event_patterns_of_scxml_match_as_at_runtime(talker: TalkerComponent) -> None:
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
    write_worker(talker, *(f'def f{i}(self): self.machine.go("{e}")' for i, e in enumerate(events)))
    found = [d.span.text for d in talker.generate() if d.code.id == "RC624"]
    assert found == ['"arm"', '"arm.mov"']
