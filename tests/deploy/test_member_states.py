"""The state of a group in one process."""

from __future__ import annotations

import pytest

from robocomp_dsl.deploy.status import ProcessStatus, format_table
from robocomp_dsl.deploy.supervisor.member_states import MemberStates


@pytest.fixture
def states() -> MemberStates:
    return MemberStates(["arm", "eye"])


def test_member_states_compute_when_all_do(states: MemberStates) -> None:
    assert states.update("arm", 7, "compute") == "initialize"
    assert states.update("eye", 7, "initialize") == "initialize"
    assert states.update("eye", 7, "compute") == "compute"
    assert states.update("arm", 7, "emergency") == "emergency"
    assert states.as_pairs() == (("arm", "emergency"), ("eye", "compute"))


def test_member_states_ignore_member_that_ended(states: MemberStates) -> None:
    for name in ("arm", "eye"):
        states.update(name, 7, "compute")
    assert states.update("arm", 7, "") == "compute"
    assert states.update("eye", 7, "") == ""


def test_member_states_begin_again_with_another_process(states: MemberStates) -> None:
    for name in ("arm", "eye"):
        states.update(name, 7, "compute")
    assert states.update("arm", 8, "compute") == "initialize"
    assert states.update("eye", 7, "") == ""
    assert states.update("eye", 8, "compute") == "compute"


def test_status_table_has_a_line_for_each_member() -> None:
    row = ProcessStatus("left", "ready", 12, life="compute", members=(("left-arm", "compute"),))
    assert ProcessStatus.from_dict(row.as_dict()) == row
    lines = format_table([row], 100, colours=False)
    assert lines[2] == "  left-arm         compute"
