"""Signals as workers use them: connect slots, emit.

In: slots, which are functions or other signals. Out: `emit` calls them in the order in which they
were connected. A signal that is emitted in a thread outside of the event loop is queued, as in Qt.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

from robocomp_dsl.runtime.robocomp.event_loop import EventLoop


class BoundSignal:
    """A signal of one object."""

    def __init__(self, loop: EventLoop | None = None) -> None:
        self._loop = loop or EventLoop.current()
        self._slots: list[Callable[..., object]] = []

    @property
    def is_connected(self) -> bool:
        """Whether there is a slot."""
        return bool(self._slots)

    def connect(self, slot: Any, *_: object) -> None:
        """Call `slot` whenever the signal is emitted; the type of connection has no effect."""
        self._slots.append(_callable_of(slot))

    def disconnect(self, slot: Any = None) -> None:
        """Disconnect a slot; without an argument all."""
        if slot is None:
            self._slots.clear()
        elif (function := _callable_of(slot)) in self._slots:
            self._slots.remove(function)
        else:
            raise RuntimeError(f"the signal is not connected to {slot!r}")

    def emit(self, *arguments: object) -> None:
        """Call the slots; in a thread outside of the event loop: soon."""
        if self._loop.is_here:
            self.call_slots(*arguments)
        else:
            self._loop.post(lambda: self.call_slots(*arguments))

    def call_slots(self, *arguments: object) -> None:
        """Call all slots, also after an error; the first error is raised at the end."""
        failure: Exception | None = None
        for slot in list(self._slots):
            try:
                slot(*arguments[: _arity(slot)])
            except Exception as error:
                failure = failure or error
        if failure is not None:
            raise failure

    __call__ = emit


class Signal:
    """The declaration of a signal in a class; each object has its own."""

    def __init__(self, *_: object, **__: object) -> None:
        self._name = ""

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, instance: object, owner: type | None = None) -> Any:
        if instance is None:
            return self
        signals = instance.__dict__.setdefault("_signals_of_object", {})
        if self._name not in signals:
            signals[self._name] = BoundSignal()
        return signals[self._name]


def _callable_of(slot: Any) -> Callable[..., object]:
    """The function that a slot is; for a signal its `emit`."""
    emit = getattr(slot, "emit", None)
    function: Callable[..., object] = emit if callable(emit) else slot
    if not callable(function):
        raise TypeError(f"a slot is a function or a signal, not {slot!r}")
    return function


def _arity(slot: Callable[..., object]) -> int | None:
    """How many positional arguments a slot takes at most; None: any number."""
    try:
        parameters = inspect.signature(slot).parameters.values()
    except (TypeError, ValueError):
        return None
    if any(p.kind is p.VAR_POSITIONAL for p in parameters):
        return None
    return sum(p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD) for p in parameters)
