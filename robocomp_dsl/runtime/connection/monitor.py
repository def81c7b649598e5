"""The base class of monitors, which users extend.

A monitor is attached to a connection in a deployment. It sees every message of the connection,
drops or changes messages, and sets events that select among the connections into one input.
"""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from robocomp_dsl.runtime.connection.event_container import EventContainer


class Monitor:
    """A monitor of one connection. Extend it in a Python file beside the deployment.

    The parameters in the deployment are the keywords of the constructor; a dataclass needs no
    constructor of its own. All hooks are optional, and one of them runs at a time.

    Hooks for one operation have its name and its arguments, and replace the general ones:
    `accept_look(self, x, y) -> bool`, `update_look(self, x, y) -> (x, y)`. With one argument,
    `update_…` returns the argument itself, otherwise a tuple.

    A hook that raises, or returns a value of a wrong type, is reported once with its line. The
    message then passes unchanged, or with `on_failure close` the connection passes nothing more.

    `port` and `peer` are the two ends of the connection, as `component.Port`; `port` is the end at
    which the monitor runs. `log` is the logger of its component. They are available in `__init__`.
    """

    port: str
    peer: str
    log: logging.Logger
    _events: EventContainer

    def on_create(self) -> None:
        """Called once, before the first message."""

    def accept(self, operation: str, arguments: tuple[Any, ...]) -> bool:  # noqa: ARG002 - a hook
        """Whether the message passes. Called for every message, also if another connection wins.

        A rejected command or publication is dropped; a rejected query raises `CallRejected`.
        Arguments must not be modified: other receivers may have the same objects.
        """
        return True

    def update(self, operation: str, arguments: tuple[Any, ...]) -> tuple[Any, ...]:  # noqa: ARG002
        """The arguments that the receiver gets: a new tuple, or `arguments` itself.

        Called for accepted messages of the connection that wins.
        """
        return arguments

    def on_destroy(self) -> None:
        """Called once, after the last message."""

    def set_event(self, event: str, lifetime: float | None = None) -> None:
        """Set an event for `lifetime` s of the component's clock; None: until it is unset.

        The events of all connections into one port are shared. Setting an event again replaces its
        lifetime. Raises `ValueError` for an invalid name, or a lifetime that is not positive.
        """
        self._events.set(event, lifetime)

    def unset_event(self, event: str) -> None:
        """Remove an event; no effect if it is not set."""
        self._events.unset(event)

    def is_event_set(self, event: str) -> bool:
        """Whether an event is set and its lifetime has not ended."""
        return event in self._events.active()
