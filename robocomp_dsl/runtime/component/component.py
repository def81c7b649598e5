"""The base class of all components: hooks of the lifecycle, and attributes for user code.

Generated code extends it; the user's class extends the generated one. The runner sets the
attributes.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from pathlib import Path
from typing import Any, ClassVar

from robocomp_dsl.runtime.clock import Clock
from robocomp_dsl.runtime.component.lifecycle import Lifecycle
from robocomp_dsl.runtime.component.spec import ComponentSpec
from robocomp_dsl.runtime.machine import Machine


class Component:
    """One component. Handlers, `compute` and the other hooks run one at a time (`threads 1`).

    `name` is the name of this instance, `params` are its parameters, `config_file` is their file
    (None: no file), `log` is its logger, `clock` its clock. These attributes and the proxies are
    available from `initialize` on, not in `__init__`. A component with a state machine also has
    `machine`, which starts after `initialize`.
    """

    SPEC: ClassVar[ComponentSpec]
    name: str
    params: Any  # of the class `SPEC.parameters`; generated code declares which
    config_file: Path | None
    log: logging.Logger
    clock: Clock
    machine: Machine
    _lifecycle: Lifecycle
    _request_stop: Callable[[], None]

    def initialize(self) -> None:
        """Called once at the start, before other components can call."""

    def compute(self) -> None:
        """Called every period."""

    def emergency(self) -> None:
        """Called every period of an emergency, instead of `compute`."""

    def restore(self) -> None:
        """Called before an emergency ends; the emergency continues if this raises."""

    def finalize(self) -> None:
        """Called once at the end; other components can still be called."""

    def deadline_missed(self, port: str, seconds: float) -> None:
        """Called when a subscribed port has received nothing for longer than its deadline.

        `seconds` since the latest message, or since a publisher is connected. Called once until the
        next message, by a timer: also when no message comes again.
        """

    def publisher_lost(self, port: str, publisher: str) -> None:
        """Called when a publisher (`component.Port`) of a port with `liveliness` ended or hangs."""

    def publisher_alive(self, port: str, publisher: str) -> None:
        """Called when a publisher of a port with `liveliness` appears, or is alive again."""

    def declare_emergency(self, reason: str) -> None:
        """Enter an emergency: `compute` is not called until `end_emergency`."""
        self._lifecycle.declare_emergency(reason)

    def end_emergency(self) -> None:
        """Leave a declared emergency: `restore`, then `compute` again."""
        self._lifecycle.end_emergency()

    def set_period(self, milliseconds: float) -> None:
        """Change the period of `compute`, in ms; 0: event-driven."""
        self._lifecycle.set_period(milliseconds)

    def quit(self) -> None:
        """Stop the component normally, after the current hook."""
        self._request_stop()
