"""The base of migrated workers: RoboComp's life cycle on top of the component's.

In: the user's class with `__init__(proxy_map, …)`, `setParams`, `compute` and slots. Out: these
methods are called as RoboComp called them: `__init__` and `setParams` when the proxies exist,
slots in the event loop, `compute` by `self.timer`, handlers in other threads.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from functools import partial
from typing import Any, ClassVar, TypeAlias

from robocomp_dsl.runtime.component.component import Component
from robocomp_dsl.runtime.robocomp.application import WorkerApplication
from robocomp_dsl.runtime.robocomp.event_loop import EventLoop
from robocomp_dsl.runtime.robocomp.leaving import (
    delete,
    delete_once,
    end_process_on_exit,
    leave,
)
from robocomp_dsl.runtime.robocomp.machines import DefaultMachine, MachineControl, MachineSignal
from robocomp_dsl.runtime.robocomp.mutexes import QMutex
from robocomp_dsl.runtime.robocomp.settings import Setting, old_settings
from robocomp_dsl.runtime.robocomp.signals import BoundSignal
from robocomp_dsl.runtime.robocomp.timers import ComputeTimer

WORKER = "SpecificWorker"
DEFAULT_MACHINE = "defaultMachine"
DEFAULT_PERIOD_MS = 30
"""`self.Period` of a worker that does not set it."""

_Init: TypeAlias = Callable[..., object]


class LegacyWorker(Component):
    """Runs the code of a RoboComp worker. `legacy.py` sets the class attributes."""

    SETTINGS: ClassVar[tuple[Setting, ...]] = ()
    TABLES: ClassVar[bool] = False
    """Whether `params` are tables of typed values, as from TOML, or strings by dotted key."""
    PROXIES: ClassVar[tuple[tuple[str, str], ...]] = ()
    """Keys of `proxy_map`, and the attributes of the proxies."""
    MACHINE: ClassVar[str] = ""
    """The attribute of the state machine; empty without a machine in SMDSL."""
    STATES: ClassVar[tuple[str, ...]] = ()
    EVENTS: ClassVar[dict[str, str]] = {}
    """Old signals, and the events of the machine that replace them."""

    timer: Any
    mutex: Any
    kill: Any
    destroyed: Any
    Period: int
    defaultMachine: DefaultMachine
    t_initialize_to_compute: MachineSignal
    t_compute_to_compute: MachineSignal
    t_compute_to_finalize: MachineSignal
    configData: dict[str, Any]
    _loop: EventLoop
    _old_init: ClassVar[_Init]

    def __init__(self, *arguments: object, **__: object) -> None:
        super().__init__()
        if not arguments:  # called by the runtime, not by the old `__init__`
            self.initialize = self._start  # type: ignore[method-assign]

    def __init_subclass__(cls, **rest: Any) -> None:
        super().__init_subclass__(**rest)
        if cls.__name__ == WORKER:
            _adapt(cls)

    def _start(self) -> None:
        """Start as RoboComp did; a class without `__init__` has the hook of the component."""
        del self.initialize  # old code may have a method of this name
        old_init = type(self)._old_init
        self._lifecycle.may_block = True  # as with RoboComp: a stop ends a `compute` that waits
        try:
            self.begin(old_init)
            if old_init is LegacyWorker.__init__:
                self.initialize()
        except SystemExit as error:
            self._leave(error)
            raise

    def _leave(self, error: SystemExit) -> None:
        """End the component for a `sys.exit`."""
        leave(self._lifecycle, self._request_stop, error)

    def begin(self, old_init: _Init) -> None:
        """Create what the old base class had, and call the old `__init__` and `setParams`."""
        life, clock, name, stop = self._lifecycle, self.clock, self.name, self._request_stop
        loop = self._loop = EventLoop()
        loop.application = WorkerApplication(loop, stop)
        loop.leave = self._leave
        life.on_stop.append(loop.stop)
        self.Period = DEFAULT_PERIOD_MS
        self.timer = ComputeTimer(loop, life.set_period)
        self.mutex = QMutex(QMutex.Recursive)
        self.kill, self.destroyed = BoundSignal(loop), BoundSignal(loop)
        self.kill.connect(stop)
        self._add_machine(loop)
        life.use_hooks(_LegacyHooks(self, loop))
        with loop.entered():
            self._call_old_methods(old_init)
            loop.start(clock, name)

    def _add_machine(self, loop: EventLoop) -> None:
        machine = self._lifecycle.machine
        if self.MACHINE and machine is not None:
            self._lifecycle.stops_with_machine = False  # RoboComp's components continued
            setattr(self, self.MACHINE, MachineControl())
            for old, event in self.EVENTS.items():
                setattr(self, old, MachineSignal(loop, partial(machine.send, event)))
        elif hasattr(self, "sm_compute"):
            default = DefaultMachine(self, loop)
            setattr(self, DEFAULT_MACHINE, default)
            for name, signal in default.signals.items():
                setattr(self, name, signal)
            self.timer.timeout.connect(default.signals["t_compute_to_compute"])

    def _call_old_methods(self, old_init: _Init) -> None:
        settings = old_settings(
            self.params, self.SETTINGS, tables=self.TABLES or _takes_settings(old_init)
        )
        self.configData = settings
        if old_init is not LegacyWorker.__init__:
            proxies = {key: getattr(self, attribute) for key, attribute in self.PROXIES}
            old_init(self, *([proxies, settings] if _takes_settings(old_init) else [proxies]))
        set_params = getattr(self, "setParams", None)
        if set_params is not None:
            set_params(settings)

    def killYourSelf(self) -> None:
        """Stop the component."""
        self._request_stop()

    def setPeriod(self, period: int) -> None:
        """Change the period of `compute` [ms], and start the timer."""
        self.Period = period
        self.timer.start(period)


def _takes_settings(old_init: _Init) -> bool:
    """Whether it is `__init__(self, proxy_map, configData, …)`."""
    names = list(inspect.signature(old_init).parameters)
    return len(names) > 2 and names[2] != "startup_check"


def _adapt(cls: Any) -> None:
    """Let the runtime create the object first, and call its old `__init__` later."""
    cls._old_init = cls.__init__
    for state in cls.STATES:
        if hasattr(cls, f"sm_{state}") and f"on_enter_{state}" not in vars(cls):
            setattr(cls, f"on_enter_{state}", _slot(f"sm_{state}"))
    cls.__init__ = LegacyWorker.__init__
    delete_once(cls)
    spec = getattr(cls, "SPEC", None)
    for port in (*spec.implements, *spec.subscribes) if spec else ():
        end_process_on_exit(cls, port.methods.values())


def _slot(name: str) -> Callable[[Any], None]:
    """A method that calls the method `name` in the event loop."""

    def call(self: Any) -> None:
        with self._loop.entered():
            getattr(self, name)()

    return call


class _LegacyHooks:
    """The hooks of a worker whose `compute` is a slot of `self.timer`."""

    def __init__(self, worker: LegacyWorker, loop: EventLoop) -> None:
        self._worker = worker
        self._loop = loop
        self._timer: ComputeTimer = worker.timer
        self.initialize = worker.initialize
        self.emergency = worker.emergency
        self.restore = worker.restore

    def compute(self) -> None:
        """Call the slots of `self.timer`; `compute` itself if the worker never uses the timer."""
        try:
            with self._loop.entered():
                if self._timer.is_used:
                    self._timer.fire()
                else:
                    self._worker.compute()
        except SystemExit as error:
            self._worker._leave(error)

    def finalize(self) -> None:
        """Emit `aboutToQuit`, finalize, emit `destroyed`, and call `__del__`."""
        self._loop.application.aboutToQuit.call_slots()
        self._worker.finalize()
        self._worker.destroyed.call_slots()
        delete(self._worker)
