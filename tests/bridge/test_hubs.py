"""Hubs: which messages form a set, and which are dropped, for any order of arrival."""

from __future__ import annotations

from collections import Counter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robocomp_dsl.runtime.bridge import hubs
from robocomp_dsl.runtime.bridge.hubs import Hub, ReceivedMessage, hub_of
from robocomp_dsl.runtime.bridge.spec import HubSpec, Policy

TOLERANCE = 0.02
ARRIVALS = st.lists(
    st.tuples(st.integers(0, 2), st.integers(-50, 5000).map(lambda ms: ms / 1000)), max_size=120
)
"""Inputs and time stamps in s, in order of arrival: out of order, in bursts, with jumps."""


class Run:
    """A hub over three inputs, its sets and its drops."""

    def __init__(self, policy: Policy, inputs: int = 3) -> None:
        names = tuple("abcdefgh"[:inputs])
        self.drops: Counter[str] = Counter()
        spec = HubSpec("hub", names, "x.bdsl:1", policy, TOLERANCE)
        self.hub: Hub = hub_of(spec, lambda index, reason: self.drops.update([reason]))
        self.sets: list[tuple[ReceivedMessage, ...]] = []
        self.arrived: list[list[ReceivedMessage]] = [[] for _ in names]

    def add(self, index: int, stamp: float = 0.0) -> bool:
        value = (index, len(self.arrived[index]))
        message = ReceivedMessage(value, round(stamp * 1e9), 0.0, 0)
        self.arrived[index].append(message)
        is_ready = self.hub.add(index, message)
        if is_ready:
            assert self.hub.messages is not None
            self.sets.append(self.hub.messages)
        return is_ready


@given(ARRIVALS)
def test_latest_hub_has_newest_message_of_each_input(arrivals: list[tuple[int, float]]) -> None:
    run = Run("latest")
    for index, stamp in arrivals:
        is_ready = run.add(index, stamp)
        assert is_ready == all(run.arrived)
        if is_ready:
            assert list(run.sets[-1]) == [messages[-1] for messages in run.arrived]
    assert not run.drops


@given(ARRIVALS)
def test_all_hub_uses_every_message_once_in_order(arrivals: list[tuple[int, float]]) -> None:
    run = Run("all")
    for index, stamp in arrivals:
        run.add(index, stamp)
    for index, messages in enumerate(run.arrived):
        used = [message_set[index].value for message_set in run.sets]
        assert used == sorted(set(used))
        waiting = min(len(messages) - len(used) - 0, hubs.QUEUE_LENGTH)
        assert len(messages) - len(used) - waiting >= 0
    lost = sum(map(len, run.arrived)) - 3 * len(run.sets) - run.drops.total()
    assert 0 <= lost <= 2 * hubs.QUEUE_LENGTH


@given(ARRIVALS)
def test_synchronised_hub_sets_are_within_tolerance_and_disjoint(
    arrivals: list[tuple[int, float]],
) -> None:
    run = Run("synchronised")
    for index, stamp in arrivals:
        run.add(index, stamp)
    for message_set in run.sets:
        stamps = [message.stamp_ns for message in message_set]
        assert max(stamps) - min(stamps) <= TOLERANCE * 1e9
    for index in range(3):
        used = [message_set[index].value for message_set in run.sets]
        assert len(used) == len(set(used))
    held = sum(map(len, run.arrived)) - 3 * len(run.sets) - run.drops.total()
    assert 0 <= held <= 3 * hubs.QUEUE_LENGTH


@given(st.permutations(range(4)), st.integers(1, 5))
def test_synchronised_hub_matches_complete_rounds_in_any_order(
    order: list[int], rounds: int
) -> None:
    run = Run("synchronised", 4)
    for number in range(rounds):
        for index in order:
            run.add(index, number + index * TOLERANCE / 4)
    assert len(run.sets) == rounds
    assert not run.drops


def test_synchronised_hub_accepts_messages_out_of_order() -> None:
    run = Run("synchronised", 2)
    run.add(0, 2.0)
    run.add(0, 1.5)
    run.add(1, 1.5)
    run.add(1, 2.0)
    stamps = [[m.stamp_ns / 1e9 for m in message_set] for message_set in run.sets]
    assert stamps == [[1.5, 1.5], [2.0, 2.0]]


@pytest.mark.parametrize("first", [0, 1])
def test_synchronised_hub_continues_after_clock_is_set_back(first: int) -> None:
    run = Run("synchronised", 2)
    run.add(1, 100.0)
    run.add(1, 100.1)
    for number in range(20):
        for index in (first, 1 - first):
            run.add(index, number / 10)
    assert len(run.sets) >= 19
    assert run.drops[hubs.SET_BACK] == 2 - run.drops[hubs.QUEUE_FULL]


def test_synchronised_hub_continues_after_single_stamp_in_future() -> None:
    run = Run("synchronised", 2)
    run.add(0, 1e9)
    for number in range(20):
        run.add(1, number / 10)
        run.add(0, number / 10)
    assert len(run.sets) >= 19


@pytest.mark.parametrize("policy", ["all", "synchronised"])
def test_hub_queue_is_bounded_in_burst_of_one_input(policy: Policy) -> None:
    run = Run(policy, 2)
    for number in range(1000):
        run.add(0, number / 1000)
    assert run.drops == {hubs.QUEUE_FULL: 1000 - hubs.QUEUE_LENGTH}
    assert run.hub.missing() == ["b"]
