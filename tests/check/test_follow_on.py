"""What follows from a syntax error is silent; what is wrong besides it is reported."""

from __future__ import annotations

from pathlib import Path

import pytest

from benchmarks.token_faults import find_errors

STRUCTS = """\
module M
{
    struct %s { double x; };
    struct Way { Place from; %s };
    interface Finder { Way find(%s); };
};
"""
MACHINE = """\
Machine
{
    initial_state Idle;
    states Busy;
    transitions { %s };
};
"""


@pytest.mark.parametrize(
    ("name", "rest", "parameters", "messages"),
    [
        ("", "", "", ["a name is missing after `struct`"]),
        ("", "Wway w;", "", ["a name is missing after `struct`", "unknown type `Wway`"]),
        ("Place", "double;", "Wai w", ["a name is missing after `double`", "unknown type `Wai`"]),
        ("Place", "Plaice, 3 to;", "", ["expected a name, found `,`"]),
        ("Place", "", "Way, 3 w", ["`3` is not a valid name"]),
    ],
)
def test_discard_follow_on_errors_leaves_independent_errors(
    name: str, rest: str, parameters: str, messages: list[str], tmp_path: Path
) -> None:
    errors = find_errors(tmp_path / "x.idsl", STRUCTS % (name, rest, parameters))
    assert [error.message for error in errors] == messages


@pytest.mark.parametrize(
    ("transitions", "messages"),
    [
        ("Idle => Busy; => Idle;", ["a name is missing before `=>`"]),
        (
            "Idle => Buzsy; Busy => on x;",
            ["unknown state `Buzsy`", "a name is missing after `=>`"],
        ),
        ("Idle => Busy; Busy => Idle on;", ["a name is missing after `on`"]),
    ],
)
def test_discard_follow_on_errors_in_state_machines(
    transitions: str, messages: list[str], tmp_path: Path
) -> None:
    errors = find_errors(tmp_path / "x.smdsl", MACHINE % transitions)
    assert [error.message for error in errors] == messages


def test_discard_follow_on_errors_keeps_unknown_interface_beside_syntax_error(
    tmp_path: Path,
) -> None:
    text = """\
import "Laser.idsl";
Component c
{
    Communications { requires Lazer; implements ; };
    period
};
"""
    messages = [error.message for error in find_errors(tmp_path / "x.cdsl", text)]
    assert "interface `Lazer` is not declared by any import" in messages
