"""Runs a component with a window in the thread of a test, offscreen."""

from __future__ import annotations

import threading
import uuid
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.component import Component
from robocomp_dsl.runtime.component.proxy import Proxy
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.gui.application import WindowApplication

W = TypeVar("W", bound=Component)
P = TypeVar("P", bound=Proxy)


def run_window(worker_class: type[W], action: Callable[[W, Runner], None]) -> tuple[W, bool]:
    """Run the component until it ends; `action` runs in a thread of its own, and then stops it.

    Returns the worker, and whether the component ended normally. Raises what `action` raised.
    """
    window = WindowApplication("test", worker_class.SPEC.threads)
    settings = RunSettings(domain=f"test-{uuid.uuid4().hex[:8]}", middleware="inproc")
    parameters = worker_class.SPEC.parameters.load()
    runner = Runner(worker_class, parameters, settings, hook_thread=window)
    worker = runner.worker
    assert isinstance(worker, worker_class)
    errors: list[BaseException] = []

    def act() -> None:
        try:
            action(worker, runner)
        except BaseException as error:
            errors.append(error)
        finally:
            runner.stop()

    thread = threading.Thread(target=act, daemon=True)
    runner.start()
    thread.start()
    succeeded = window.run(runner)
    thread.join(60)
    if errors:
        raise errors[0]
    return worker, succeeded


@contextmanager
def proxy_of(runner: Runner, proxy: type[P]) -> Iterator[P]:
    """A proxy of another component for the interface of the running component."""
    host = ComponentContext("tester", runner.settings.domain, CallbackGroup(), Statistics())
    ports = open_ports("inproc", host)
    name = proxy.INTERFACE.name.rpartition("::")[2]
    served = proxy(ports.proxy(Endpoint(proxy.INTERFACE, "tester", name)))
    try:
        assert served.wait_for_server(60)
        yield served
    finally:
        ports.close()
