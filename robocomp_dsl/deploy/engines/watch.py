"""How an engine learns whether a component is ready: the Protocol, without any middleware.

A component is ready when it is alive in the domain and its life cycle has reached `compute`. A
watch tells every change as it happens; nobody polls, nobody guesses a time.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeAlias

from robocomp_dsl.deploy.status import Time

READY = ("compute", "emergency")
"""States of the life cycle in which a component works; one that initialises is not there yet."""

Seen: TypeAlias = Callable[[str, int, str], None]
"""`seen(name, pid, state)`: the process `pid` says that component `name` is in `state`; an empty
state: it is no longer seen. Called from any thread."""


class Watch(Protocol):
    """Follows the components of one domain."""

    def start(self, seen: Seen) -> None:
        """Begin; what is alive already is told, too."""

    def time(self) -> Time | None:
        """The simulated time that was told last; None without any."""

    def close(self) -> None:
        """End; nothing is told afterwards."""
