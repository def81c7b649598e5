"""The state machine of one running component.

In: a `MachineSpec`, the worker, a clock. Out: `send` for the worker's code, `tick` for the
lifecycle: due events are processed, and the methods of the active states are called.
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

from robocomp_dsl.runtime.clock import TIME_DIGITS, Clock
from robocomp_dsl.runtime.deprecated import DeprecatedMachineNames
from robocomp_dsl.runtime.machine.run_to_completion import RunToCompletionQueue
from robocomp_dsl.runtime.machine.spec import MachineSpec

log = logging.getLogger("robocomp")
state_log = logging.getLogger("robocomp.machine")

MAX_TRANSITIONS = 1000
"""Transitions that one event may cause; more are an endless loop."""


class UnknownEvent(Exception):
    """The machine has no event or state of this name; the message suggests the nearest."""


class EndlessTransitions(Exception):
    """Transitions without events lead from state to state without end."""


@dataclass(frozen=True, order=True, slots=True)
class _Timer:
    """A delayed event."""

    moment: float
    number: int
    fire: Callable[[], None]
    id: str
    delay: float


class Machine(DeprecatedMachineNames):
    """One state machine. It starts after `initialize`; when it finishes, the component stops.

    `changed` is called when the time of the next delayed event changes.
    """

    def __init__(
        self, spec: MachineSpec, worker: object, clock: Clock, changed: Callable[[], None]
    ) -> None:
        self.spec = spec
        self._clock = clock
        self._changed = changed
        self._states = {known_state.name: known_state for known_state in spec.walk()}
        self._hooks = {
            (verb, state.name): getattr(worker, f"{verb}_{state.suffix}", None)
            for state in self._states.values()
            for verb in ("state", "on_enter", "on_exit")
        }
        self._events = set(spec.events) | {t.event for t in spec.transitions if t.event}
        self._timers: list[_Timer] = []
        self._numbers = count()
        self._lock = threading.Lock()
        self._queue = RunToCompletionQueue()
        self._chart: Any = None
        self._running = False
        self._entry_count = 0
        self._transition_count = 0
        self._active: tuple[str, ...] = ()

    def start(self) -> None:
        """Enter the initial states. Raises what the worker's methods raise."""
        from robocomp_dsl.runtime.machine.chart import chart_of  # noqa: PLC0415 - 0.1 s to load

        chart = chart_of(self.spec)

        def enter() -> bool:
            self._transition_count = 0
            chart(self._schedule_delayed, self._cancel, self._on_chart_created, [_Listener(self)])
            self._running = True
            self._update_state()
            return True

        self._queue.submit(enter)

    def _on_chart_created(self, chart: Any) -> None:
        self._chart = chart

    @property
    def states(self) -> tuple[str, ...]:
        """The names of the active states, outermost first; empty before the start."""
        return self._active

    @property
    def ended(self) -> bool:
        """Whether the machine has reached a top-level final state."""
        return self._running and bool(self._chart.is_terminated)

    def is_in(self, state: str) -> bool:
        """Whether this state is active. Raises `UnknownEvent` for an unknown state."""
        if state not in self._states:
            raise UnknownEvent(f"unknown state `{state}`{_suggestion(state, self._states)}")
        return state in self._active

    def send(self, event: str, **data: object) -> bool:
        """Send an event and take its transitions; returns whether there was one.

        `data` is for the conditions of an SCXML document (`_event.data`). If a transition is being
        processed (in this thread or another one), the event is queued and False is returned.
        Raises `UnknownEvent`.
        """
        if self._chart is None:
            raise UnknownEvent(f"`{event}`: the state machine starts after `initialize`")
        if event not in self._events and not self._is_pattern(event):
            raise UnknownEvent(f"unknown event `{event}`{_suggestion(event, self._events)}")
        return self._queue.submit(
            partial(self._process_event, partial(self._chart.send, event, **data))
        )

    def _process_event(self, fire: Callable[[], None], timer: _Timer | None = None) -> bool:
        """Process an event; returns whether a state was entered.

        If a method of the worker raises, the timers are restored, and `timer` is due again.
        """
        before, waiting = self._entry_count, list(self._timers)
        self._transition_count = 0
        try:
            fire()
        except BaseException:
            with self._lock:
                self._timers = sorted([*waiting, timer] if timer else waiting)
            raise
        finally:
            self._update_state()
        return self._entry_count != before

    def next_due(self) -> float | None:
        """Time of the next delayed event; None: there is none."""
        with self._lock:
            return self._timers[0].moment if self._timers else None

    def restart_timers(self) -> None:
        """Restart all delays in full, after a reset of the clock."""
        now = self._clock.now()
        with self._lock:
            again = [
                replace(timer, moment=round(now + timer.delay, TIME_DIGITS))
                for timer in self._timers
            ]
            self._timers = sorted(again)

    def fire_due(self) -> None:
        """Process the delayed events that are due."""
        self._queue.submit(self._fire_next_due)

    def _fire_next_due(self) -> bool:
        """Process the first due event; the next one is queued after the events it causes."""
        timer = self._pop_due()
        if timer is None:
            return False
        moved = self._process_event(timer.fire, timer)
        self._queue.submit(self._fire_next_due)
        return moved

    def tick(self) -> None:
        """Call the `state_…` methods of the active states, outermost first."""
        for name in self._active:
            # A method may have exited the states of the others.
            if name in self._active and (method := self._hooks["state", name]):
                method()

    # Called by the chart.

    def on_transition(self, source: str) -> None:
        """A transition is taken. Raises `EndlessTransitions` for a loop without events."""
        self._transition_count += 1
        if self._transition_count > MAX_TRANSITIONS:
            raise EndlessTransitions(
                f"one event caused more than {MAX_TRANSITIONS} transitions, last from `{source}`:"
                " give one of its transitions an event, or a condition that becomes false"
            )

    def on_state_entered(self, name: str) -> None:
        """A state was entered: start its timers."""
        self._entry_count += 1
        state_log.debug("enter %s", name)
        from robocomp_dsl.runtime.machine.chart import timer_event  # noqa: PLC0415 - see above

        for number, transition in enumerate(self.spec.transitions):
            if transition.source == name and transition.after is not None:
                event = timer_event(number)
                self._schedule(transition.after, partial(self._chart.send, event), event)
        self._update_active_states()
        self._call("on_enter", name)

    def on_state_exited(self, name: str) -> None:
        """A state was exited: cancel its timers."""
        state_log.debug("exit %s", name)
        from robocomp_dsl.runtime.machine.chart import timer_event  # noqa: PLC0415 - see above

        for number, transition in enumerate(self.spec.transitions):
            if transition.source == name and transition.after is not None:
                self._cancel(timer_event(number))
        self._call("on_exit", name)

    def _call(self, verb: str, name: str) -> None:
        method = self._hooks.get((verb, name))
        if method:
            method()

    def _schedule_delayed(self, trigger: Any, delay: float) -> None:
        self._schedule(delay, lambda: self._chart.put_due(trigger), trigger.send_id or "")

    def _schedule(self, delay: float, fire: Callable[[], None], id_: str) -> None:
        with self._lock:
            moment = round(self._clock.now() + delay, TIME_DIGITS)
            timer = _Timer(moment, next(self._numbers), fire, id_, delay)
            heappush(self._timers, timer)
        self._changed()

    def _cancel(self, id_: str) -> None:
        with self._lock:
            self._timers = [timer for timer in self._timers if timer.id != id_]
            heapify(self._timers)

    def _pop_due(self) -> _Timer | None:
        now = self._clock.now()
        with self._lock:
            ready = self._timers and self._timers[0].moment <= now
            return heappop(self._timers) if ready else None

    def _update_state(self) -> None:
        self._update_active_states()
        if self.ended:
            with self._lock:
                self._timers.clear()
            self._changed()

    def _update_active_states(self) -> None:
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
    """Listener for entered and exited states (the method names are those of the library)."""

    def __init__(self, machine: Machine) -> None:
        self._machine = machine

    def before_transition(self, source: Any) -> None:
        self._machine.on_transition(str(source.id))

    def on_enter_state(self, state: Any) -> None:
        self._machine.on_state_entered(str(state.id))

    def on_exit_state(self, state: Any) -> None:
        self._machine.on_state_exited(str(state.id))


def _suggestion(name: str, known: Any) -> str:
    guess = get_close_matches(name, list(known), 1, 0.6)
    listed = ", ".join(sorted(known))
    return f"; did you mean `{guess[0]}`?" if guess else f"; known: {listed or 'none'}"
