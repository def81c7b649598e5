"""The check of a monitor's class against its interface."""

from __future__ import annotations

from textwrap import dedent

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robocomp_dsl.monitors.class_check import check_monitor_class
from robocomp_dsl.monitors.monitor_finding import MonitoredOperation

OPERATIONS = (
    MonitoredOperation("look", (("x", "float"), ("certainty", "float"))),
    MonitoredOperation("name", (("text", "str"),)),
    MonitoredOperation("stop"),
)
HEADER = "from robocomp_dsl.runtime import Monitor\n"
VALID = HEADER + dedent("""
    class Face(Monitor):
        def __init__(self, certainty: float = 0.8, *, label: str = "") -> None:
            self.certainty = certainty

        def on_create(self) -> None:
            self.count = 0

        def accept_look(self, x: float, certainty: float) -> bool:
            if certainty < self.certainty:
                return False
            self.set_event("e_face", 2.0)
            return True

        def update_name(self, text: str) -> str:
            return text.strip()

        def update(self, operation, arguments):
            return arguments

        def on_destroy(self) -> None:
            self.unset_event("e_face")
    """)


@pytest.mark.parametrize(
    ("method", "marked", "message"),
    [
        ("def accept_lok(self, x, c):\n  return True", "accept_lok", "no operation `lok`"),
        ("def accept_look(self, x):\n  return True", "accept_look", "(self, x, certainty)"),
        ("def accept_look(self, x, c, d):\n  return True", "accept_look", "must take"),
        ("def accept_look(self, x, c, *, d):\n  return True", "accept_look", "must take"),
        ("def accept(self, arguments):\n  return True", "accept", "(self, operation, arguments)"),
        ("def on_create(self, max):\n  pass", "on_create", "must take (self)"),
        ("def accept_name(self, text: int):\n  return True", "text: int", "of type str, not int"),
        ("def accept_name(self, text) -> int:\n  return 1", "accept_name", "returns a bool"),
        ("def accept_name(self, text):\n  print(text)", "accept_name", "returns nothing"),
        ("def update_name(self, text):\n  return", "update_name", "must return the arguments"),
        ("def update_name(self, text) -> None:\n  pass", "update_name", "not None"),
        ("def update_stop(self):\n  return ()", "update_stop", "no arguments to update"),
        ("async def accept_stop(self):\n  return True", "accept_stop", "must not be async"),
        ("def on_created(self):\n  pass", "on_created", "never called"),
        (
            "def on_create(self):\n  self.set_event('e face', 1)",
            "'e face'",
            "not the name of an event",
        ),
        ("def on_create(self):\n  self.set_event('e', 0)", "0", "more than 0 s"),
        ("def on_create(self):\n  self.set_event('e', lifetime=-1)", "-1", "more than 0 s"),
    ],
)
def test_monitor_class_finding_is_located(method: str, marked: str, message: str) -> None:
    text = HEADER + "\nclass Face(Monitor):\n    " + method.replace("\n", "\n    ")
    (finding,) = check_monitor_class(text, "Face", OPERATIONS, {}).findings
    assert message in f"{finding.message} {finding.help}"
    line = text.splitlines()[finding.line - 1]
    assert line[finding.column - 1 : finding.end_column - 1] == marked


@pytest.mark.parametrize(
    ("parameters", "name", "message"),
    [
        ({"certanty": 0.5}, "certanty", "no parameter `certanty`"),
        ({"certainty": "high"}, "certainty", "of type float, not 'high'"),
        ({"certainty": True}, "certainty", "of type float, not True"),
        ({"label": 3}, "label", "of type str, not 3"),
    ],
)
def test_monitor_class_finding_names_the_parameter(
    parameters: dict[str, object], name: str, message: str
) -> None:
    (finding,) = check_monitor_class(VALID, "Face", OPERATIONS, parameters).findings
    assert (finding.parameter, message in finding.message) == (name, True)


def test_monitor_class_needs_parameters_without_default() -> None:
    text = HEADER + dedent("""
        class Limit(Monitor):
            def __init__(self, low: int, high: int) -> None:
                self.range = (low, high)
        """)
    (finding,) = check_monitor_class(text, "Limit", OPERATIONS, {"low": 1}).findings
    assert finding.message == "`Limit` needs the parameter `high`"


def test_monitor_class_may_be_a_dataclass() -> None:
    text = HEADER + dedent("""
        from dataclasses import dataclass

        @dataclass
        class Limit(Monitor):
            max: float
            label: str = ""
            count = 0
        """)
    assert check_monitor_class(text, "Limit", OPERATIONS, {"max": 3}).findings == []
    findings = check_monitor_class(text, "Limit", OPERATIONS, {"count": 1}).findings
    assert [f.parameter for f in findings] == ["count", "max"]


def test_monitor_class_inherits_within_the_file() -> None:
    text = VALID + dedent("""
        class Strict(Face):
            def accept_stop(self) -> bool:
                self.set_event("e_stop")
                return False
        """)
    result = check_monitor_class(text, "Strict", OPERATIONS, {"certainty": 0.9})
    assert (result.findings, result.events) == ([], {"e_face", "e_stop"})


def test_monitor_class_with_a_base_of_another_file_is_checked_in_part() -> None:
    text = "from base import Base\nclass Mine(Base):\n    def accept_lok(self): return True\n"
    result = check_monitor_class(text, "Mine", OPERATIONS, {"any": 1})
    assert [f.message for f in result.findings] == ["the interface has no operation `lok`"]
    assert not result.all_events_known


@pytest.mark.parametrize(
    ("text", "name", "message"),
    [
        ("class Face(Monitor:\n", "Face", "invalid Python"),
        ("x = 1\0", "Face", "invalid Python"),
        ("class Fase(Monitor): pass", "Face", "no class `Face`"),
        ("", "Face", "no class `Face`"),
        ("class Face: pass", "Face", "does not extend `Monitor`"),
    ],
)
def test_monitor_class_file_that_cannot_be_used(text: str, name: str, message: str) -> None:
    (finding,) = check_monitor_class(text, name, OPERATIONS, {}).findings
    assert message in finding.message


@given(st.data())
def test_monitor_class_of_any_text_is_checked(data: st.DataObject) -> None:
    """Texts of the valid class with parts cut, repeated or replaced."""
    text = VALID
    for _ in range(data.draw(st.integers(1, 4))):
        start = data.draw(st.integers(0, len(text)))
        end = data.draw(st.integers(start, min(len(text), start + 40)))
        new = data.draw(
            st.sampled_from(("", "(", ")", "self", "*", "\n", "\t", ":", "=", "é", "\0"))
        )
        text = text[:start] + new + text[end:]
    lines = len(text.splitlines()) + 1
    for finding in check_monitor_class(text, "Face", OPERATIONS, {"certainty": 1}).findings:
        assert 1 <= finding.line <= finding.end_line <= lines
        assert finding.column >= 1
        assert finding.message


@pytest.mark.parametrize("depth", [100, 400, 5000])
def test_monitor_class_with_deep_nesting_is_checked(depth: int) -> None:
    annotation = "a[" * depth + "b" + "]" * depth
    text = (
        f"class Face(Monitor):\n    def accept_stop(self) -> {annotation}:\n        return True\n"
    )
    assert check_monitor_class(text, "Face", OPERATIONS, {}).findings


def test_monitor_class_suggests_the_class() -> None:
    (finding,) = check_monitor_class("class Face(Monitor): pass", "Fase", OPERATIONS, {}).findings
    assert finding.help == "did you mean `Face`?"


def test_monitor_class_columns_count_characters() -> None:
    text = HEADER + "class Ä(Monitor):\n    def ä(self): pass; self.set_event('é è')\n"
    (finding,) = check_monitor_class(text, "Ä", OPERATIONS, {}).findings
    assert text.splitlines()[2][finding.column - 1 : finding.end_column - 1] == "'é è'"
