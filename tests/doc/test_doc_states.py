"""Diagrams of state machines: boxes in boxes, every transition from its source to its target."""

from __future__ import annotations

import re
from itertools import combinations
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.generate.doc.drawing import Curve, Rectangle
from robocomp_dsl.generate.doc.state_figure import state_figure
from robocomp_dsl.generate.doc.state_words import transition_label
from robocomp_dsl.model.statemachine import State, StateMachine, Transition
from robocomp_dsl.source import Source
from tests.doc.doc_site import check_links, pages, read

SPAN = Source(Path("x.smdsl"), "x").file_span
NEAR = 0.21
"""Positions are written with one decimal."""


def _transition(source: str, target: str, event: str = "e", **more: object) -> Transition:
    return Transition(source, target, event, SPAN, **more)  # type: ignore[arg-type]


def _machine(states: tuple[State, ...], *transitions: Transition) -> StateMachine:
    return StateMachine("m", Path("m.smdsl"), SPAN, states, transitions)


@st.composite
def machines(draw: st.DrawFn) -> StateMachine:
    """States within states, and transitions between any two of them."""
    count = draw(st.integers(1, 9))
    parents = [draw(st.integers(-1, i - 1)) for i in range(count)]

    def inside(parent: int) -> tuple[State, ...]:
        states = [i for i in range(count) if parents[i] == parent]
        return tuple(
            State(
                f"s{i}",
                SPAN,
                initial=i == states[0] and draw(st.booleans()),
                final=draw(st.booleans()),
                parallel=draw(st.booleans()),
                substates=inside(i),
            )
            for i in states
        )

    names = st.integers(0, count - 1).map(lambda i: f"s{i}")
    pairs = draw(st.lists(st.tuples(names, names), max_size=14))
    return _machine(inside(-1), *(_transition(*pair) for pair in pairs))


@settings(max_examples=150)
@given(machines())
def test_state_figure_of_random_machine_is_valid(machine: StateMachine) -> None:
    drawing = state_figure(machine, "x").drawing
    boxes = {
        p.tooltip.removesuffix(": final state"): p
        for p in drawing.parts
        if isinstance(p, Rectangle)
    }
    _check_boxes(machine.states, boxes)
    for state in boxes.values():
        assert state.x >= 0
        assert state.x + state.width <= drawing.width
        assert state.y + state.height <= drawing.height
    for transition in machine.transitions:
        text = re.compile(f"{transition.source} to {transition.target}(:|$)")
        lines = [p for p in drawing.parts if isinstance(p, Curve) and text.match(p.tooltip)]
        _check_curves(lines, boxes[transition.source], boxes[transition.target])


def _check_boxes(
    states: tuple[State, ...], boxes: dict[str, Rectangle], outer: Rectangle | None = None
) -> None:
    for item, other in combinations(states, 2):
        a, b = boxes[item.name], boxes[other.name]
        separate = a.x + a.width <= b.x or b.x + b.width <= a.x
        assert separate or a.y + a.height <= b.y or b.y + b.height <= a.y
    for state in states:
        box = boxes[state.name]
        if outer:
            assert outer.x < box.x
            assert outer.y < box.y
            assert box.x + box.width < outer.x + outer.width
            assert box.y + box.height < outer.y + outer.height
        _check_boxes(state.substates, boxes, box)


def _check_curves(lines: list[Curve], source: Rectangle, target: Rectangle) -> None:
    """One line in pieces, divided at the borders that it crosses."""
    ends = [_ends(line) for line in lines]
    (arrow,) = [end for line, (_, end) in zip(lines, ends, strict=True) if line.arrow_head]
    assert _on_border(arrow, target)
    begins = [begin for begin, _ in ends if not any(_same(begin, end) for _, end in ends)]
    begins = begins or [begin for begin, _ in ends]  # a line to itself
    assert len(begins) == 1
    assert _on_border(begins[0], source)


def _ends(line: Curve) -> tuple[tuple[float, float], tuple[float, float]]:
    numbers = [float(n) for n in re.findall(r"-?[0-9.]+(?:e-?[0-9]+)?", line.path)]
    tip = [float(n) for n in re.findall(r"-?[0-9.]+", line.arrow_head)] or numbers[-2:]
    return (numbers[0], numbers[1]), (tip[0], tip[1])


def _same(item: tuple[float, float], other: tuple[float, float]) -> bool:
    return abs(item[0] - other[0]) < NEAR and abs(item[1] - other[1]) < NEAR


def _on_border(point: tuple[float, float], box: Rectangle) -> bool:
    x, y = point
    left, top, right, bottom = box.x, box.y, box.x + box.width, box.y + box.height
    within = left - NEAR <= x <= right + NEAR and top - NEAR <= y <= bottom + NEAR
    return within and min(abs(x - left), abs(x - right), abs(y - top), abs(y - bottom)) < NEAR


LABELS = [
    (_transition("a", "b", "go"), "go"),
    (_transition("a", "b", "a_to_b"), ""),
    (_transition("a", "b", "t_a_to_b"), ""),
    (_transition("a", "b", "", after_s=2.5), "after 2.5 s"),
    (_transition("a", "b", "go", after_s=60.0), "go or after 60 s"),
    (_transition("a", "b", "go", cond="x >  3"), "go [x > 3]"),
    (_transition("a", "", "tick"), "tick (stays)"),
    (_transition("a", "b", "x" * 50), "x" * 39 + "…"),
]


@pytest.mark.parametrize(("transition", "text"), LABELS)
def test_transition_label_shows_event_time_and_condition(transition: Transition, text: str) -> None:
    assert transition_label(transition) == text


def test_state_figure_marks_initial_final_and_history_states() -> None:
    inner = (State("in", SPAN, initial=True), State("h", SPAN, history="deep", start=("in",)))
    states = (State("a", SPAN, initial=True, substates=inner), State("z", SPAN, final=True))
    parts = state_figure(_machine(states), "x").drawing.parts
    boxes = [p for p in parts if isinstance(p, Rectangle)]
    assert [p.kind for p in boxes].count("dot") == 2
    assert [p.kind for p in boxes].count("ring") == 1
    assert "H* h" in {item.text for p in boxes for item in p.labels}
    assert "h to in" in {p.tooltip for p in parts if isinstance(p, Curve)}


def test_component_page_shows_state_machine(tmp_path: Path) -> None:
    (tmp_path / "c.cdsl").write_text('Component c { language Python; statemachine "c.smdsl"; };')
    (tmp_path / "c.smdsl").write_text(
        "c { initial_state rest; states work; end_state over; "
        "transitions { rest => work on go; work => over after 2 min; }; };"
        ":work { initial_state think; states act; "
        "transitions { think => act; act => over on fall; }; };"
    )
    site = pages(tmp_path / "c.cdsl")
    assert check_links(site)
    text = read(site["components/c.html"]).text
    assert "State machine c.smdsl" in text
    assert "act over fall" in text
    assert "work over after 120 s" in text
    assert "act to over: fall" in text
    assert "components/c.states.svg" in site
    assert not any(path.startswith("statemachines/") for path in site)
