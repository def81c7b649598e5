"""Models of SCXML files, compared with those of SMDSL."""

from __future__ import annotations

from pathlib import Path

from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.check.languages import check_file
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.statemachine import StateMachine

CASES = Path(__file__).parent.parent / "cases"


def read(path: Path) -> tuple[StateMachine, Report]:
    report = Report()
    found = check_file(path, Workspace(environ={}), report)
    assert isinstance(found, StateMachine)
    return found, report


def test_scxml_model() -> None:
    machine, report = read(CASES / "scxml" / "sem_clean.scxml")
    assert list(report) == []
    assert (machine.name, machine.language, machine.start) == ("game", "ecmascript", ("waiting",))
    assert machine.data.startswith("<datamodel>")
    assert machine.data.endswith("</datamodel>")
    states = {state.name: state for state in machine.all_states()}
    assert [state.name for state in machine.states] == ["waiting", "playing", "paused", "over"]
    assert [name for name, state in states.items() if state.initial] == [
        "waiting",
        "silent",
        "dark",
    ]
    assert [name for name, state in states.items() if state.parallel] == ["playing"]
    assert [name for name, state in states.items() if state.final] == ["over"]
    assert (states["last"].history, states["last"].start) == ("deep", ("silent",))
    assert states["waiting"].exit == '<cancel sendid="tick"/>'
    assert states["waiting"].entry.count("<") == 2
    assert states["loud"].entry.startswith("<if cond")
    ways = {(transition.source, transition.event): transition for transition in machine.transitions}
    assert ways["waiting", "start go.*"].targets == ("playing",)
    assert ways["paused", "begin"].targets == ("loud", "bright")
    conditional, assigning = (w for w in machine.transitions if w.event == "tick")
    assert conditional.cond == "points > 3"
    assert (assigning.targets, assigning.action[:7]) == ((), "<assign")


def test_smdsl_and_scxml_give_equal_models(tmp_path: Path) -> None:
    """Names, nesting, regions and transitions of a machine in both languages."""
    (tmp_path / "m.smdsl").write_text(
        "m { initial_state a; states b; end_state c;"
        " transitions { a => b on go; b => c on stop; }; };"
        " :b { initial_state x; states y; transitions { x => y on next; y => a on back; }; };"
    )
    (tmp_path / "m.scxml").write_text(
        '<scxml name="m" initial="a"><state id="a"><transition event="go" target="b"/></state>'
        '<state id="b" initial="x"><transition event="stop" target="c"/>'
        '<state id="x"><transition event="next" target="y"/></state>'
        '<state id="y"><transition event="back" target="a"/></state></state>'
        '<final id="c"/></scxml>'
    )
    shapes = []
    for path in (tmp_path / "m.smdsl", tmp_path / "m.scxml"):
        machine, report = read(path)
        assert list(report) == []
        states = {
            (s.name, s.initial, s.final, s.start, tuple(i.name for i in s.substates))
            for s in machine.all_states()
        }
        ways = {(w.source, w.event, w.targets) for w in machine.transitions}
        shapes.append((machine.name, machine.start, states, ways))
    assert shapes[0] == shapes[1]


def test_component_model_has_state_machine() -> None:
    report = Report()
    shipped = CASES / "interfaces"
    path = CASES / "cdsl" / "sem_statemachine" / "main.cdsl"
    found = check_file(path, Workspace(environ={}, shipped=shipped), report)
    assert isinstance(found, Component)
    assert found.statemachine is not None
    assert found.statemachine.machine is not None
    assert [state.name for state in found.statemachine.machine.states] == ["a", "unseen", "b"]


def test_scxml_nesting_depth_is_reported(tmp_path: Path) -> None:
    path = tmp_path / "m.scxml"
    path.write_text("<scxml>" + "<state>" * 5000 + "</state>" * 5000 + "</scxml>")
    report = Report()
    assert check_file(path, Workspace(environ={}), report) is None
    assert [d.code.id for d in report] == ["RC709"]


PIECES = [
    "<scxml>", '<scxml initial="a">', "</scxml>", '<state id="a">', "<state>", "</state>",
    '<state id="b" initial="a c">', "<parallel>", "</parallel>", '<final id="c"/>', "<initial>",
    "</initial>", '<transition target="a"/>', '<transition event="e" target="b &amp; c">',
    "</transition>", '<history id="h" type="deep">', "</history>", "<onentry>", "</onentry>",
    "<script>x &lt; 1</script>", "<![CDATA[", "]]>", "<data/>", "text", "<q:w/>", "<", ">",
]  # fmt: skip


@settings(max_examples=300)
@given(st.lists(st.sampled_from(PIECES), max_size=30).map("".join))
def test_scxml_check_accepts_any_text(text: str) -> None:
    path = Path("machine.scxml")
    workspace = Workspace(environ={})
    source = workspace.sources.set_overlay(path, text)
    report = Report()
    check_file(path, workspace, report)
    for item in report:
        assert item.span.source is source
        assert 0 <= item.span.start <= item.span.end <= len(text)
