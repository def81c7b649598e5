"""What systemd's properties of a unit mean."""

from __future__ import annotations

import pytest

from robocomp_dsl.deploy import status
from robocomp_dsl.deploy.hosts.host_report import UnitState

NOW_S = 100.0


def unit_state(**properties: object) -> UnitState:
    """The state of a unit; start and readiness were 10 s ago."""
    fields = {
        "LoadState": "loaded",
        "ActiveState": "failed",
        "SubState": "failed",
        "Result": "exit-code",
        "ExecMainCode": "1",
        "ExecMainStatus": "3",
        "NRestarts": "0",
        "StartLimitBurst": "4",
        "InactiveExitTimestampMonotonic": "90000000",
        "ActiveEnterTimestampMonotonic": "90500000",
    } | {name: str(value) for name, value in properties.items()}
    return UnitState.from_properties(fields, NOW_S)


def test_unit_state_reports_start_limit_without_refused_restart() -> None:
    state = unit_state(NRestarts=4)
    assert (state.state, state.restarts) == (status.FAILED, 3)
    assert state.note == "failed too often: exit code 3"


def test_unit_state_of_last_restart_is_no_start_limit() -> None:
    state = unit_state(NRestarts=3)
    assert (state.restarts, state.note) == (3, "exit code 3")


def test_unit_state_without_start_limit_keeps_its_restarts() -> None:
    assert unit_state(NRestarts=1000, StartLimitBurst=0).restarts == 1000


@pytest.mark.parametrize(
    ("entered_us", "note"),
    [
        (90_500_000, "did not exit in time and was killed"),
        (80_000_000, "not ready in time"),
        (0, "not ready in time"),
    ],
)
def test_unit_state_tells_timeout_of_stop_from_start(entered_us: int, note: str) -> None:
    state = unit_state(Result="timeout", ActiveEnterTimestampMonotonic=entered_us)
    assert state.note == note
