"""Runs workers with the old base class, without middleware."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import pytest

from robocomp_dsl.runtime.clock import WallClock
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.hook_thread import LifecycleThread
from robocomp_dsl.runtime.component.lifecycle import Lifecycle
from robocomp_dsl.runtime.component.statistics import Statistics

DEADLINE_S = 60.0


class RunningWorker:
    """A worker whose lifecycle runs in a thread; handlers take `handlers` as those of ports."""

    def __init__(self, worker_class: type[Any], period_ms: float = 10) -> None:
        self.worker = worker_class()
        self.handlers = CallbackGroup()
        self.life = Lifecycle(
            self.worker,
            period_ms,
            WallClock(),
            LifecycleThread(self.handlers),
            Statistics(),
            lambda _: None,
        )
        self.worker.params = SimpleNamespace(values=dict)
        self.worker.clock, self.worker.name = WallClock(), "old"
        self.worker._request_stop = self.life.stop
        self.worker._lifecycle = self.life
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self) -> None:
        if self.life.initialize():
            self.life.loop()
        self.life.finalize()

    def call(self, handler: Callable[..., Any], *arguments: object) -> Any:
        """Call a method as a handler of a port, in a thread of the middleware."""
        assert self.handlers.enter(DEADLINE_S)
        try:
            return handler(*arguments)
        finally:
            self.handlers.leave()

    def stop(self) -> bool:
        """Stop; whether the lifecycle ended."""
        self.life.stop()
        self._thread.join(DEADLINE_S)
        return not self._thread.is_alive()


@pytest.fixture
def run_worker() -> Iterator[Callable[..., RunningWorker]]:
    """`run_worker(SpecificWorker)`; all workers are stopped at the end."""
    workers: list[RunningWorker] = []

    def run(worker_class: type[Any], **options: Any) -> RunningWorker:
        workers.append(RunningWorker(worker_class, **options))
        return workers[-1]

    yield run
    assert all(running.stop() for running in workers)
