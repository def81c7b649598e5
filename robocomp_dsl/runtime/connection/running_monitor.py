"""One monitor of a connection: its object, and what happens when one of its hooks fails.

In: the class, its settings, the ends of the connection. Out: functions that accept and update the
messages of an operation. They report each kind of failure once.
"""

from __future__ import annotations

import inspect
import logging
from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.user_errors import describe_error, log_error
from robocomp_dsl.runtime.connection.argument_types import ArgumentTypes
from robocomp_dsl.runtime.connection.event_container import EventContainer
from robocomp_dsl.runtime.connection.monitor import Monitor
from robocomp_dsl.runtime.connection.monitor_settings import MonitorSettings
from robocomp_dsl.runtime.data.convert import described
from robocomp_dsl.runtime.data.errors import EncodeError

Arguments: TypeAlias = tuple[Any, ...]
AcceptFunction: TypeAlias = Callable[[Arguments], bool]
UpdateFunction: TypeAlias = Callable[[Arguments], Arguments]


class ConnectionClosed(Exception):
    """A hook failed, and the connection is declared to close then."""


class _Hook(NamedTuple):
    """A method of a monitor for one operation; `returns_value`: the argument, not a tuple."""

    name: str
    method: Callable[..., Any]
    call: Callable[[Arguments], Any]
    returns_value: bool = False


class WrongResult(TypeError):
    """A hook returned a value of a wrong type; the message has the place of its definition."""

    def __init__(self, message: str, hook: _Hook) -> None:
        code = getattr(inspect.unwrap(hook.method), "__code__", None)
        location = f" ({code.co_filename}:{code.co_firstlineno})" if code else ""
        super().__init__(f"{message}{location}")


def _as_answer(answer: Any, hook: _Hook) -> bool:
    """The result of `accept`. Raises `WrongResult`."""
    if isinstance(answer, bool | np.bool_):
        return bool(answer)
    raise WrongResult(f"returned {described(answer)}, not True or False", hook)


def _as_arguments(
    result: Any, hook: _Hook, types: ArgumentTypes, arguments: Arguments
) -> Arguments:
    """The result of `update`, as a receiver expects it. Raises `WrongResult`."""
    values = (result,) if hook.returns_value else result
    if not isinstance(values, tuple | list):
        raise WrongResult(f"returned {described(result)}, not a tuple of arguments", hook)
    try:
        return types.convert_changed(tuple(values), arguments)
    except EncodeError as error:
        raise WrongResult(f"returned a wrong value: {error}", hook) from None


class RunningMonitor:
    """One monitor. `connection` is its text for messages, as `a.X -> b.Y`."""

    def __init__(self, cls: type[Monitor], settings: MonitorSettings, connection: str) -> None:
        self.name = cls.__name__
        self.failures = 0
        self._class = cls
        self._settings = settings
        self._connection = connection
        self._monitor: Monitor | None = None
        self._reported: set[str] = set()

    @property
    def is_created(self) -> bool:
        """Whether the object exists: neither its constructor nor `on_create` has failed."""
        return self._monitor is not None

    def create(self, port: str, peer: str, events: EventContainer) -> None:
        """Create the object and call `on_create`. Raises `ConnectionClosed`."""
        monitor = self._class.__new__(self._class)
        logger = logging.getLogger(port.rpartition(".")[0])
        attributes = {"port": port, "peer": peer, "log": logger, "_events": events}
        for name, value in attributes.items():
            object.__setattr__(monitor, name, value)  # also of a frozen dataclass
        hook = "__init__"
        try:
            monitor.__init__(**dict(self._settings.parameters))  # type: ignore[misc]
            hook = "on_create"
            monitor.on_create()
        except Exception as error:
            self._fail(hook, error)
            return
        self._monitor = monitor

    def destroy(self) -> None:
        """Call `on_destroy`; a failure is reported."""
        monitor, self._monitor = self._monitor, None
        if monitor is None:
            return
        try:
            monitor.on_destroy()
        except Exception as error:
            self._report("on_destroy", error, "")

    def accept_function(self, operation: Operation) -> AcceptFunction | None:
        """A function that says whether a message passes; None if all do.

        It raises `ConnectionClosed`.
        """
        hook = self._hook("accept", operation)
        if hook is None:
            return None

        def accept(arguments: Arguments) -> bool:
            try:
                return _as_answer(hook.call(arguments), hook)
            except Exception as error:
                self._fail(hook.name, error)
                return True

        return accept

    def update_function(self, operation: Operation, types: ArgumentTypes) -> UpdateFunction | None:
        """A function that returns the arguments to pass on; None if it changes none.

        It raises `ConnectionClosed`.
        """
        hook = self._hook("update", operation)
        if hook is None or not operation.inputs:
            return None

        def update(arguments: Arguments) -> Arguments:
            try:
                return _as_arguments(hook.call(arguments), hook, types, arguments)
            except Exception as error:
                self._fail(hook.name, error)
                return arguments

        return update

    def _hook(self, kind: str, operation: Operation) -> _Hook | None:
        """The method for an operation; None if it is that of the base class."""
        monitor = self._monitor
        if monitor is None:
            return None
        name = f"{kind}_{operation.name}"
        specific = getattr(monitor, name, None)
        if specific is not None:
            is_single = len(operation.inputs) == 1
            return _Hook(name, specific, lambda arguments: specific(*arguments), is_single)
        if getattr(type(monitor), kind) is getattr(Monitor, kind):
            return None
        general, operation_name = getattr(monitor, kind), operation.name
        return _Hook(kind, general, lambda arguments: general(operation_name, arguments))

    def _fail(self, hook: str, error: Exception) -> None:
        """Report a failure. Raises `ConnectionClosed` if the connection is declared to close."""
        self.failures += 1
        if self._settings.closes_on_failure:
            self._report(hook, error, "; the connection is closed")
            raise ConnectionClosed from error
        if hook in {"__init__", "on_create"}:
            self._report(hook, error, "; the connection works without it")
        else:
            self._report(hook, error, "; such messages pass unchanged")

    def _report(self, hook: str, error: Exception, consequence: str) -> None:
        kind = f"{hook} {type(error).__name__}"
        if kind in self._reported:
            return
        self._reported.add(kind)
        text = str(error) if isinstance(error, WrongResult) else f"failed: {describe_error(error)}"
        log_error(f"monitor {self.name} of {self._connection}: {hook} {text}{consequence}", error)
