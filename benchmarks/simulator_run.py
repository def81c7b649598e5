"""One simulator of the humanoid, generated and run as a process of its own, and its client here."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import threading
import uuid
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from benchmarks.humanoid import humanoid
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext, Ports

STEP_MS = 1.0
PATIENCE = 60.0
NAME = "humanoid_simulator"
TAP = "BENCH_TAP"  # as in the worker, which is no module of ours
WORKER = Path(__file__).with_name("simulator_worker.py")


@dataclass(frozen=True, slots=True)
class Line:
    """What the worker tells of one simulated second, see there; all in s."""

    simulated: float
    cpu_before: float
    cpu: float
    wall: float
    bare: float


@dataclass(slots=True)
class Run:
    """A running simulator: its lines, what was heard of its topics, and how to call it."""

    process: subprocess.Popen[str]
    middleware: Ports
    types: Any
    lines: list[Line] = field(default_factory=list)
    effects: list[tuple[float, float]] = field(default_factory=list)
    heard: Counter[str] = field(default_factory=Counter)
    time: float = 0.0
    news: threading.Event = field(default_factory=threading.Event)

    def proxy(self, port: str) -> Any:
        """The operations of the port that is called as its interface."""
        interface = getattr(self.types, port.upper())
        at = Endpoint(interface, "client", port, (f"{NAME}.{port}",))
        link = self.ports.proxy(at)
        if not link.wait(PATIENCE):
            raise TimeoutError(f"nobody serves {port}")
        return SimpleNamespace(
            **{operation.name: link.bind(operation) for operation in interface.operations}
        )

    def hear(self, kind: str, port: str, operation: str) -> None:
        """Subscribe to a topic and count what comes."""

        def take(*arguments: Any) -> None:
            self.heard[port] += 1
            if kind == "ControlBoardStateProxy":
                self.time = arguments[0].time
                self.news.set()

        interface = getattr(self.types, kind).INTERFACE
        at = Endpoint(interface, "client", port)
        self.ports.subscribe(at, {operation: take}, CallbackGroup())


@contextmanager
def simulator(
    folder: Path, *options: str, camera: bool = False, tap: bool = False
) -> Iterator[Run]:
    """Generate into `folder`, start, and end it; all is told when the block has ended."""
    home = _generated(folder, camera=camera)
    domain = f"bench-{uuid.uuid4().hex[:8]}"
    command = [sys.executable, "main.py", "--domain", domain, "--log-level", "error"]
    process = subprocess.Popen(
        [*command, "--set", f"step={STEP_MS}", *options],
        cwd=home,
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | ({TAP: "1"} if tap else {}),
    )
    execution = CallbackGroup()
    middleware = open_ports("zenoh", ComponentContext("client", domain, execution, Statistics()))
    run = Run(process, middleware, _interfaces(home))
    reader = threading.Thread(target=_read, args=(run,))
    reader.start()
    try:
        yield run
    finally:
        process.terminate()
        try:
            process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
        reader.join()
        middleware.close()


def _generated(folder: Path, *, camera: bool) -> Path:
    world = folder / "humanoid.xml"
    world.write_text(humanoid(camera=camera))
    rcgen = Path(sys.executable).with_name("rcgen")
    subprocess.run([rcgen, "simulator", world.name], cwd=folder, check=True, capture_output=True)
    home = folder / NAME
    shutil.copyfile(WORKER, home / "specificworker.py")
    return home


def _interfaces(home: Path) -> Any:
    spec = spec_from_file_location(
        "humanoid_interfaces", home / f"{NAME}_generated" / "interfaces.py"
    )
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


def _read(run: Run) -> None:
    assert run.process.stdout is not None
    for text in run.process.stdout:
        record = json.loads(text)
        if record and isinstance(record[0], float):
            run.lines.append(Line(*record))
        else:
            run.effects = [(torque, at) for torque, at in record]
