"""The state machine of one running component.

In: a `MachineSpec`, the worker, a clock. Out: `go` for the worker's code, `beat` for the life
cycle: events whose time has come are taken, and the methods of the active states are called.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from difflib import get_close_matches
from functools import partial
from heapq import heapify, heappop, heappush
from itertools import count
from typing import Any

from robocomp_dsl.runtime.clock import DIGITS, Clock
from robocomp_dsl.runtime.machine.spec import MachineSpec
from robocomp_dsl.runtime.machine.turns import Turns

log = logging.getLogger("robocomp")


class UnknownEvent(Exception):
    """The machine has no event of this name; the message offers the nearest."""


@dataclass(frozen=True, order=True, slots=True)
class _Due:
    """An event that waits for its moment."""

    moment: float
    number: int
    fire: Callable[[], None]
    id: str
    delay: float


class Machine:
    """One state machine. It begins behind `initialize`, and its end is that of the component.

    `changed` is called where something is to be done at another time than before.
    """

    def __init__(
        self, spec: MachineSpec, worker: object, clock: Clock, changed: Callable[[], None]
    ) -> None:
        self.spec = spec
        self._clock = clock
        self._changed = changed
        self._states = {one.name: one for one in spec.walk()}
        self._hooks = {
            (verb, one.name): getattr(worker, f"{verb}_{one.suffix}", None)
            for one in self._states.values()
            for verb in ("state", "on_enter", "on_exit")
        }
        self._events = set(spec.events) | {t.event for t in spec.transitions if t.event}
        self._due: list[_Due] = []
        self._numbers = count()
        self._lock = threading.Lock()
        self._turns = Turns()
        self._chart: Any = None
        self._running = False
        self._entries = 0
        self._active: tuple[str, ...] = ()

    def start(self) -> None:
        """Enter the first states. Raises what the worker's methods raise."""
        from robocomp_dsl.runtime.machine.chart import chart_of  # noqa: PLC0415 - 0.1 s to load

        chart = chart_of(self.spec)

        def enter() -> bool:
            chart(self._later, self._cancel, self._begun, [_Listener(self)])
            self._running = True
            self._settle()
            return True

        self._turns.take(enter)

    def _begun(self, chart: Any) -> None:
        self._chart = chart

    @property
    def states(self) -> tuple[str, ...]:
        """The names of the active states, outer ones first; none before the beginning."""
        return self._active

    @property
    def ended(self) -> bool:
        """Whether a final state of the whole was reached."""
        return self._running and bool(self._chart.is_terminated)

    def is_in(self, state: str) -> bool:
        """Whether this state is active. Raises `UnknownEvent` for one that there is not."""
        if state not in self._states:
            raise UnknownEvent(f"there is no state `{state}`{_near(state, self._states)}")
        return state in self._active

    def go(self, event: str, **data: object) -> bool:
        """Fire an event: the transitions that wait for it are taken; whether there was one.

        `data` is for the conditions of an SCXML document (`_event.data`). Called from a method
        that a transition calls, or while another thread is at it, it is taken when that is done,
        and False is returned. Raises `UnknownEvent`.
        """
        if self._chart is None:
            raise UnknownEvent(f"`{event}`: the state machine begins behind `initialize`")
        if event not in self._events and not self._is_pattern(event):
            raise UnknownEvent(f"there is no event `{event}`{_near(event, self._events)}")
        return self._turns.take(partial(self._happen, partial(self._chart.send, event, **data)))

    def _happen(self, fire: Callable[[], None], timer: _Due | None = None) -> bool:
        """Let something happen; whether a state was entered.

        Where a method of the worker raises, it has not happened, and a timer is still due.
        """
        before, waiting = self._entries, list(self._due)
        try:
            fire()
        except BaseException:
            with self._lock:
                self._due = sorted([*waiting, timer] if timer else waiting)
            raise
        finally:
            self._settle()
        return self._entries != before

    def due(self) -> float | None:
        """When the next event comes by itself; None: none does."""
        with self._lock:
            return self._due[0].moment if self._due else None

    def restart_timers(self) -> None:
        """Time has begun anew: what waits for its moment waits in full again."""
        now = self._clock.now()
        with self._lock:
            again = [replace(one, moment=round(now + one.delay, DIGITS)) for one in self._due]
            self._due = sorted(again)

    def fire_due(self) -> None:
        """Take the events whose time has come."""
        self._turns.take(self._fire_next)

    def _fire_next(self) -> bool:
        """The first event whose time has come, and then the next, behind what they cause."""
        one = self._next_due()
        if one is None:
            return False
        moved = self._happen(one.fire, one)
        self._turns.take(self._fire_next)
        return moved

    def beat(self) -> None:
        """Call the `state_…` methods of the active states, outer ones first."""
        for name in self._active:
            # One of them may have left the states of the others.
            if name in self._active and (method := self._hooks["state", name]):
                method()

    # What follows is for the chart.

    def entered(self, name: str) -> None:
        """A state was entered; its timers begin."""
        self._entries += 1
        from robocomp_dsl.runtime.machine.chart import timer_event  # noqa: PLC0415 - see above

        for number, one in enumerate(self.spec.transitions):
            if one.source == name and one.after is not None:
                event = timer_event(number)
                self._add(one.after, partial(self._chart.send, event), event)
        self._settle_names()
        self._call("on_enter", name)

    def left(self, name: str) -> None:
        """A state was left; its timers end."""
        from robocomp_dsl.runtime.machine.chart import timer_event  # noqa: PLC0415 - see above

        for number, one in enumerate(self.spec.transitions):
            if one.source == name and one.after is not None:
                self._cancel(timer_event(number))
        self._call("on_exit", name)

    def _call(self, verb: str, name: str) -> None:
        method = self._hooks.get((verb, name))
        if method:
            method()

    def _later(self, trigger: Any, delay: float) -> None:
        self._add(delay, lambda: self._chart.put_due(trigger), trigger.send_id or "")

    def _add(self, delay: float, fire: Callable[[], None], id_: str) -> None:
        with self._lock:
            moment = round(self._clock.now() + delay, DIGITS)
            one = _Due(moment, next(self._numbers), fire, id_, delay)
            heappush(self._due, one)
        self._changed()

    def _cancel(self, id_: str) -> None:
        with self._lock:
            self._due = [one for one in self._due if one.id != id_]
            heapify(self._due)

    def _next_due(self) -> _Due | None:
        now = self._clock.now()
        with self._lock:
            ready = self._due and self._due[0].moment <= now
            return heappop(self._due) if ready else None

    def _settle(self) -> None:
        self._settle_names()
        if self.ended:
            with self._lock:
                self._due.clear()
            self._changed()

    def _settle_names(self) -> None:
        if self._chart is None:
            return
        found = {str(state.id) for state in self._chart.configuration}
        self._active = tuple(name for name in self._states if name in found)

    def _is_pattern(self, event: str) -> bool:
        """Whether an event of the document is a pattern that takes this one (SCXML 3.12.1)."""
        return any(
            p == "*" or event.startswith(f"{p.removesuffix('*').removesuffix('.')}.")
            for p in self._events
        )


class _Listener:
    """Hears of states that are entered and left (the names are those of the library)."""

    def __init__(self, machine: Machine) -> None:
        self._machine = machine

    def on_enter_state(self, state: Any) -> None:
        self._machine.entered(str(state.id))

    def on_exit_state(self, state: Any) -> None:
        self._machine.left(str(state.id))


def _near(name: str, known: Any) -> str:
    guess = get_close_matches(name, list(known), 1, 0.6)
    listed = ", ".join(sorted(known))
    return f"; did you mean `{guess[0]}`?" if guess else f"; there are {listed or 'none'}"
