"""Builds a class of python-statemachine from a machine's description.

In: a `MachineSpec`. Out: a `StateChart` class that passes delayed events to a callback. The library
itself would sleep until they are due and block the component.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable
from types import new_class
from typing import Any

from statemachine import StateChart
from statemachine.event_data import TriggerData
from statemachine.io import create_machine_class_from_definition, load

from robocomp_dsl.runtime.machine.spec import MachineSpec, StateSpec, TransitionSpec

# The library describes each internal step at level debug; `robocomp.machine` has the states.
logging.getLogger("statemachine").setLevel(logging.INFO)


class ExternallyTimedChart(StateChart[Any]):
    """Callbacks of the machines of both languages.

    `later` receives an event and the seconds until it is due, `cancel` the id of the events to
    cancel, `begun` the machine before its first event.
    """

    catch_errors_as_events = False

    def __init__(
        self,
        later: Callable[[TriggerData, float], None],
        cancel: Callable[[str], None],
        begun: Callable[[ExternallyTimedChart], None],
        listeners: list[object],
    ) -> None:
        self._later = later
        self._cancel = cancel
        begun(self)  # entering the initial states calls methods that may use it
        super().__init__(listeners=listeners)

    def _put_nonblocking(self, trigger_data: TriggerData, internal: bool = False) -> None:
        delay = getattr(trigger_data.event, "delay", 0)
        if delay:
            self._later(trigger_data, delay / 1000)
        else:
            super()._put_nonblocking(trigger_data, internal=internal)

    def put_due(self, trigger_data: TriggerData) -> None:
        """A delayed event that is due."""
        trigger_data.execution_time = 0.0
        super()._put_nonblocking(trigger_data)
        self._engine.processing_loop()

    def cancel_event(self, send_id: str) -> None:
        """Cancel the delayed events with this id (the name is the library's)."""
        self._cancel(send_id)
        super().cancel_event(send_id)


def chart_of(spec: MachineSpec) -> type[ExternallyTimedChart]:
    """The class. Raises the library's exceptions for unsupported documents."""
    # Expressions of a document can only read and write its data; they cannot run code.
    chart = load(spec.scxml, format="scxml", trusted=False) if spec.scxml else _from_states(spec)
    both: type[ExternallyTimedChart] = new_class(spec.name, (ExternallyTimedChart, chart))
    return both


def timer_event(number: int) -> str:
    """The timed event of the transition with this number."""
    return f"after_{number}_s"


def _from_states(spec: MachineSpec) -> type[StateChart[Any]]:
    states = {state.name: _state_definition(state, spec.transitions) for state in spec.states}
    return create_machine_class_from_definition(
        spec.name,
        states,
        validate_disconnected_states=False,
        validate_trap_states=False,
        validate_final_reachability=False,
    )


def _state_definition(state: StateSpec, transitions: Iterable[TransitionSpec]) -> Any:
    all_ = tuple(transitions)
    events: dict[str | None, list[dict[str, str]]] = {}
    for number, transition in enumerate(all_):
        if transition.source == state.name:
            named = [transition.event] if transition.event else []
            timed = [timer_event(number)] if transition.after is not None else []
            for event in (*named, *timed):
                events.setdefault(event, []).append({"target": transition.target})
    definition: dict[str, Any] = {
        "initial": state.initial,
        "final": state.final,
        "parallel": state.parallel,
    }
    definition["states"] = {inner.name: _state_definition(inner, all_) for inner in state.inside}
    definition["on"] = events
    return definition
