"""Generates bridges and runs them in the process of the test."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.command_line import create_parser, parse_settings
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.lifecycle import LifecycleState
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import ComponentPorts, open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from tests.cli.rcgen_run import Rcgen
from tests.support.waiting import wait_until

NUMBERS = rt.Interface(
    "Test::Numbers", rt.Operation("push", rt.Pattern.PUBLISH, {"numbers": rt.Float64Array})
)


def generate(rcgen: Rcgen, folder: Path, text: str, name: str = "x.bdsl") -> Path:
    """Write a bridge into `folder` and generate its component there."""
    (folder / name).write_text(text)
    run = rcgen("bridge", folder / name, "--format", "concise")
    assert run.code == 0, run.err + run.out
    return folder


def load_worker(folder: Path) -> Any:
    """The class `SpecificWorker` of a generated component, as `main.py` loads it."""
    (package,) = folder.glob("*_generated")
    for module in [m for m in sys.modules if m.split(".")[0] == package.name]:
        del sys.modules[module]
    sys.path.insert(0, str(folder))
    try:
        path = folder / "specificworker.py"
        spec = importlib.util.spec_from_file_location(f"worker_of_{package.name}", path)
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        sys.modules[spec.name] = module
        spec.loader.exec_module(module)
    finally:
        sys.path.remove(str(folder))
    return module.SpecificWorker


@contextmanager
def running(folder: Path, *options: str) -> Iterator[Any]:
    """The worker of a generated bridge while it runs in this process."""
    worker = load_worker(folder)
    settings = parse_settings(create_parser(worker.SPEC).parse_args(options), worker.SPEC)
    params = worker.SPEC.parameters.load(None, settings.overrides)
    runner = Runner(worker, params, settings)
    runner.start()
    try:
        wait_until(lambda: runner.state is LifecycleState.COMPUTE)
        yield runner.worker
    finally:
        runner.stop()
        assert runner.wait()


class Peer:
    """A program with ports on one middleware, in a domain of its own: no component of the bridge's.

    `addresses` are those of its own ports, by port.
    """

    def __init__(
        self,
        name: str,
        domain: str,
        middleware: str,
        settings: dict[str, str] | None = None,
        addresses: dict[str, str] | None = None,
    ) -> None:
        self.name = name
        self.middleware = middleware
        self.group = CallbackGroup()
        self.statistics = Statistics()
        context = ComponentContext(
            name,
            domain,
            self.group,
            self.statistics,
            transport_settings={(middleware, key): v for key, v in (settings or {}).items()},
            addresses={(middleware, port): at for port, at in (addresses or {}).items()},
        )
        self.ports: ComponentPorts = open_ports(middleware, context)

    def endpoint(self, interface: rt.Interface, port: str, *peers: str) -> Endpoint:
        """A port; `peers` are components that it looks for."""
        return Endpoint(interface, self.name, port, peers, middlewares=(self.middleware,))

    def publisher(self, interface: rt.Interface, port: str) -> Callable[..., None]:
        """A function that publishes the only operation of an interface."""
        channel = self.ports.advertise(self.endpoint(interface, port))
        return channel.bind(interface.operations[0])

    def subscribe(self, interface: rt.Interface, port: str, *peers: str) -> list[Any]:
        """The received messages of a topic with one argument, which grow."""
        received: list[Any] = []
        handlers = {operation.name: received.append for operation in interface.operations}
        self.ports.subscribe(self.endpoint(interface, port, *peers), handlers, self.group)
        return received

    def close(self) -> None:
        """Close all ports."""
        self.ports.close()
