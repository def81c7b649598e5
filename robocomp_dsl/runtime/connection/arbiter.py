"""Selects the connection that may pass messages into an arbitrated input.

In: the connections with their constraints in the order of the deployment, and the events. Out: at
every moment at most one connection, the winner: the first whose constraint is true.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from robocomp_dsl.monitors.constraint import Constraint
from robocomp_dsl.runtime.connection.event_container import EventContainer

_MAX_CACHED = 1024
"""Combinations of events whose winner is cached."""


class Arbiter:
    """The arbiter of one input; `connections` are its connections with their constraints.

    `report` gets a message the first time that two given connections have true constraints.
    """

    def __init__(
        self,
        connections: Mapping[str, Constraint],
        events: EventContainer,
        report: Callable[[str], None],
    ) -> None:
        self._connections = dict(connections)
        self._events = events
        self._report = report
        self._winners: dict[frozenset[str], str] = {}
        self._reported: set[tuple[str, str]] = set()

    def winner(self) -> str:
        """The connection that may pass messages now; "" if no constraint is true."""
        active = self._events.active()
        winner = self._winners.get(active)
        if winner is None:
            winner = self._select(active)
            if len(self._winners) >= _MAX_CACHED:
                self._winners.clear()
            self._winners[active] = winner
        return winner

    def _select(self, active: frozenset[str]) -> str:
        satisfied = [name for name, c in self._connections.items() if c.evaluate(active)]
        for other in satisfied[1:]:
            pair = (satisfied[0], other)
            if pair not in self._reported:
                self._reported.add(pair)
                self._report(self._describe_conflict(*pair, active))
        return satisfied[0] if satisfied else ""

    def _describe_conflict(self, winner: str, loser: str, active: frozenset[str]) -> str:
        events = f"with the events {', '.join(sorted(active))}" if active else "without any event"
        return (
            f"{winner} and {loser} may both pass messages {events}: `when"
            f" {self._connections[winner].text}` and `when {self._connections[loser].text}`"
            f" are true; {winner} wins, because the deployment declares it first"
        )
