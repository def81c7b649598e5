"""The error of a call that several servers could answer names what selects one of them."""

from __future__ import annotations

from dataclasses import replace

import pytest

from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.peer_selection import matches, select_server
from robocomp_dsl.runtime.errors import AmbiguousServer

AT = Endpoint(Interface("Arms::Arm"), "mover", "Arm")


@pytest.mark.parametrize(
    ("candidates", "hint"),
    [
        (["left.Arm", "right.Arm"], "left"),
        (["arms.Arm1", "arms.Arm"], "arms.Arm"),
        (["arms.Arm", "arms.Arm1", "left.Arm"], "arms.Arm"),
        (["arms.Arm", "left.Arm", "left.Arm1"], "arms"),
    ],
)
def test_select_server_names_a_connection_that_selects_one(
    candidates: list[str], hint: str
) -> None:
    with pytest.raises(AmbiguousServer) as raised:
        select_server(AT, candidates)
    assert str(raised.value).endswith(f"select one: --connect Arm={hint}")
    connected = replace(AT, peers=(hint,))
    left = [each for each in candidates if matches(connected, *each.split("."))]
    assert len(left) == 1
