"""The base of all components: the hooks of their life, and what their code may use.

In: nothing; the runner puts in place what is declared here. Out: the class that generated code
extends and the user's class ends.
"""

from __future__ import annotations

import logging
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from robocomp_dsl.runtime.clock import Clock
from robocomp_dsl.runtime.machine import Machine
from robocomp_dsl.runtime.parameters import Parameters
from robocomp_dsl.runtime.spec import ComponentSpec

if TYPE_CHECKING:
    from robocomp_dsl.runtime.runner import Runner


class Component:
    """One component. Handlers, `compute` and the other hooks run one at a time (`threads 1`).

    `name` is that of this instance, `params` are its parameters, `config_file` is where they come
    from, if there is one, `log` is its logger. They and the proxies are there from `initialize` on,
    not in `__init__`. A component with a state machine has `machine` too, which begins behind
    `initialize`.
    """

    SPEC: ClassVar[ComponentSpec]
    name: str
    params: Parameters
    config_file: Path | None
    log: logging.Logger
    clock: Clock
    machine: Machine
    _runner: Runner

    def initialize(self) -> None:
        """Once at the start, before others can call."""

    def compute(self) -> None:
        """Every period."""

    def emergency(self) -> None:
        """Every period of an emergency, instead of `compute`."""

    def restore(self) -> None:
        """Before an emergency ends; it goes on when this raises."""

    def finalize(self) -> None:
        """Once at the end; other components can still be called."""

    def declare_emergency(self, reason: str) -> None:
        """Compute no more until `end_emergency`."""
        self._runner.lifecycle.declare_emergency(reason)

    def end_emergency(self) -> None:
        """Restore, and compute again."""
        self._runner.lifecycle.end_emergency()

    def set_period(self, milliseconds: int) -> None:
        """Compute so often from now on; 0: only on events."""
        self._runner.lifecycle.set_period(milliseconds)

    def quit(self) -> None:
        """End in order, after what is being done now."""
        self._runner.stop()
