"""Findings about members of parameters and proxies, and about hooks."""

from __future__ import annotations

import pytest

from tests.regeneration.talker_component import TalkerComponent, add_machine, write_worker

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
def test_unknown_members_of_params_and_proxies_are_reported(
    talker: TalkerComponent, use: str
) -> None:
    limits = "limits { low int 1; parts[0:2] { at int 1; }; };"
    parameters = f"rate float 1; motors[0:3] {{ gain float 1; }}; {limits}"
    talker.describe("int say(Word w);", parameters=parameters, ports="requires Talk;")
    write_worker(talker, f"def compute(self): {use}")
    found = talker.generate()
    assert [d.label for d in found] == ([USES[use]] if USES[use] else [])
    if found:
        assert found[0].code.id == ("RC617" if "proxy" in use else "RC616")
        assert f".{found[0].span.text}" in use
        assert found[0].span.text not in {"rate", "gain", "low", "at", "say"}


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
def test_hook_without_matching_parameter_or_state_is_reported(
    talker: TalkerComponent, hook: str
) -> None:
    machine = "m { states a1; initial_state waiting; transitions { waiting => a1 on start; }; };\n"
    add_machine(talker, machine)
    parameters = "rate float 1 live; size int 1; motors[0:3] { gain float 1 live; };"
    (talker.folder / "talker.pdsl").write_text(f"ComponentParams talker {{ {parameters} }};\n")
    talker.worker.unlink()
    talker.generate()
    write_worker(talker, f"def {hook}(self, *more): ...", "def Talk_say(self, w): ...")
    found = talker.generate()
    assert [d.message for d in found] == (
        [f"`{hook}` is never called: {HOOKS[hook]}"] if HOOKS[hook] else []
    )
    if found:
        assert found[0].code.id == ("RC616" if "_set_" in hook else "RC624")
        assert found[0].span.text == hook
