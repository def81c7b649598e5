"""The state of a group in one process: one state, from those of its components.

In: the state of each component, by process id. Out: the state of the group.
"""

from __future__ import annotations

from collections.abc import Iterable

from robocomp_dsl.deploy.supervisor.lifecycle_monitor import READY_STATES


class MemberStates:
    """The states of the components of one group, in the latest process that reported."""

    def __init__(self, names: Iterable[str]) -> None:
        self._names = tuple(names)
        self._pid = 0
        self._states: dict[str, str] = {}

    def update(self, name: str, pid: int, state: str) -> str:
        """A component has changed; returns the state of the group, "" if no component is alive.

        The group computes when all components do; one that has ended by itself does not count.
        """
        if pid != self._pid:
            if not state:
                return ""  # the end of an earlier process
            self._pid, self._states = pid, {}
        self._states[name] = state
        alive = {n: s for n, s in self._states.items() if s}
        if not alive:
            return ""
        started = len(self._states) == len(self._names)
        waiting = [s for s in alive.values() if s not in (*READY_STATES, "restore")]
        if waiting or not started:
            return waiting[0] if waiting else "initialize"
        return "emergency" if "emergency" in alive.values() else next(iter(alive.values()))

    def as_pairs(self) -> tuple[tuple[str, str], ...]:
        """Each component with its state, "" if it is not alive."""
        return tuple((name, self._states.get(name, "")) for name in self._names)
