"""One end of a connection with monitors: which messages pass, and with which arguments.

In: running monitors, and the arbiter if the input is arbitrated. Out: functions that replace the
call or the handler of an operation. The order is: all monitors accept, the connection wins, all
monitors update.
"""

from __future__ import annotations

from collections.abc import Sequence
from threading import Lock
from typing import Any, NamedTuple

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.connection.arbiter import Arbiter
from robocomp_dsl.runtime.connection.argument_types import ArgumentTypes
from robocomp_dsl.runtime.connection.event_container import EventContainer
from robocomp_dsl.runtime.connection.monitor_settings import ConnectionMonitors
from robocomp_dsl.runtime.connection.ports import OperationCallable
from robocomp_dsl.runtime.connection.running_monitor import (
    AcceptFunction,
    Arguments,
    ConnectionClosed,
    RunningMonitor,
    UpdateFunction,
)
from robocomp_dsl.runtime.errors import CallRejected, RejectedByReceiver


class _Hooks(NamedTuple):
    """The hooks of all monitors of a connection for one operation."""

    accepts: tuple[AcceptFunction, ...]
    updates: tuple[UpdateFunction, ...]


class MonitoredConnection:
    """One end of a connection. `peer` is the other end, `port` this end, as `component.Port`.

    `lock` is shared by all connections of an arbitrated input: one message is judged at a time.
    """

    def __init__(
        self,
        settings: ConnectionMonitors,
        port: str,
        peer: str,
        monitors: Sequence[RunningMonitor],
        events: EventContainer,
        lock: Lock,
        arbiter: Arbiter | None = None,
    ) -> None:
        self.settings = settings
        self.port = port
        self.peer = peer
        self.monitors = monitors
        self.events = events
        self.arbiter = arbiter
        self.passed = 0
        self.rejected = 0
        self.is_closed = False
        self._lock = lock

    @property
    def is_winner(self) -> bool:
        """Whether messages may pass now; True without arbitration.

        It takes no lock: a component whose monitor hangs can still be inspected.
        """
        return self.arbiter is None or self.arbiter.winner() == self.peer

    def create(self) -> None:
        """Create the monitors."""
        for monitor in self.monitors:
            try:
                monitor.create(self.port, self.peer, self.events)
            except ConnectionClosed:
                self.is_closed = True

    def destroy(self) -> None:
        """Destroy the monitors, the last monitor first."""
        with self._lock:
            for monitor in reversed(self.monitors):
                monitor.destroy()

    def wrap(
        self, operation: Operation, call: OperationCallable, *, is_query: bool, is_sender: bool
    ) -> OperationCallable:
        """`call`, the handler or the calling function of `operation`, for messages that pass.

        A rejected query raises `CallRejected`; for other messages the function returns None.
        """
        types = ArgumentTypes(operation)
        hooks = _Hooks(
            tuple(filter(None, (m.accept_function(operation) for m in self.monitors))),
            tuple(filter(None, (m.update_function(operation, types) for m in self.monitors))),
        )

        def monitored(*arguments: Any) -> Any:
            if is_sender:
                arguments = types.convert(arguments)
            passing = self._judge(arguments, hooks)
            if passing is not None:
                return call(*passing)
            if is_query:
                error = CallRejected if is_sender else RejectedByReceiver
                raise error(self._describe_rejection(operation))
            return None

        return monitored

    def _judge(self, arguments: Arguments, hooks: _Hooks) -> Arguments | None:
        """The arguments to pass on; None if the message is rejected. It is counted."""
        with self._lock:
            try:
                passing = self._select(arguments, hooks)
            except ConnectionClosed:
                self.is_closed = True
                passing = None
            if passing is None:
                self.rejected += 1
            else:
                self.passed += 1
            return passing

    def _select(self, arguments: Arguments, hooks: _Hooks) -> Arguments | None:
        if self.is_closed or not all(accept(arguments) for accept in hooks.accepts):
            return None
        if self.arbiter is not None and self.arbiter.winner() != self.peer:
            return None
        for update in hooks.updates:
            arguments = update(arguments)
        return arguments

    def _describe_rejection(self, operation: Operation) -> str:
        names = ", ".join(monitor.name for monitor in self.monitors)
        what = f"{operation.name} of the connection between {self.port} and {self.peer}"
        if self.is_closed:
            return f"{what} was rejected: the connection is closed since a monitor failed"
        by = f" by its monitor {names}" if names else ""
        if self.settings.constraint is None:
            return f"{what} was rejected{by}"
        return f"{what} was rejected{by}, or `when {self.settings.constraint.text}` is false"
