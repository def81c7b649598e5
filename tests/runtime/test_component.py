"""A component from its program to its end: life cycle, parameters, introspection, exit codes."""

from __future__ import annotations

import json
import logging
import os
import re
import signal
import subprocess
import sys
import time
import uuid
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from robocomp_dsl.runtime import Component, ComponentSpec
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.component_interface import (
    COMPONENT,
    ComponentProxy,
    LifeState,
    Refusal,
)
from robocomp_dsl.runtime.component.lifecycle import LifecycleState
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import (
    InvalidSetting,
    RunSettings,
    parse_connections,
    parse_qos,
)
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.middleware.base import Endpoint, MiddlewareContext, Qos
from robocomp_dsl.runtime.middleware.registry import open_middleware
from robocomp_dsl.runtime.parameters import Parameter, ParameterRejected, Parameters
from tests.support.background_job import IGNORING_INTERRUPT
from tests.support.waiting import wait_until

DEADLINE = 60.0


class ArmParams(Parameters):
    SCHEMA = (
        Parameter(
            "rate", "float", default=50.0, low=1, high=100, unit="Hz", live=True, doc="How often."
        ),
        Parameter("device", "string", default="/dev/null"),
    )
    rate: float
    device: str


class Arm(Component):
    """Writes down what happens to it."""

    SPEC = ComponentSpec(name="arm", period=1, parameters=ArmParams, middleware="inproc")
    params: ArmParams

    def __init__(self) -> None:
        self.happened: list[str] = []
        self.failing = False
        self.refusing = False

    def initialize(self) -> None:
        self.happened.append("initialize")

    def compute(self) -> None:
        if self.failing:
            raise RuntimeError("the arm does not move")
        self.happened.append("compute")

    def emergency(self) -> None:
        self.happened.append("emergency")

    def restore(self) -> None:
        self.happened.append("restore")

    def finalize(self) -> None:
        self.happened.append("finalize")

    def will_set_rate(self, value: float) -> None:
        if self.refusing:
            raise ParameterRejected("not while moving")

    def did_set_rate(self, old: float) -> None:
        self.happened.append(f"rate was {old:g}")


@pytest.fixture
def runner() -> Iterator[Runner]:
    domain = f"test-{uuid.uuid4().hex[:8]}"
    component = Runner(Arm, ArmParams.load(), RunSettings(domain=domain, middleware="inproc"))
    component.start()
    yield component
    component.stop()
    component.wait()


@pytest.fixture
def about(runner: Runner) -> Iterator[ComponentProxy]:
    host = MiddlewareContext("looker", runner.settings.domain, CallbackGroup(), Statistics())
    middleware = open_middleware("inproc", host)
    yield ComponentProxy(middleware.proxy(Endpoint(COMPONENT, "looker", "Component", ("arm",))))
    middleware.close()


def arm_of(runner: Runner) -> Arm:
    assert isinstance(runner.worker, Arm)
    return runner.worker


def test_a_life_in_order(runner: Runner) -> None:
    arm = arm_of(runner)
    wait_until(lambda: arm.happened.count("compute") >= 3)
    arm.quit()
    assert runner.wait()
    assert arm.happened[0] == "initialize"
    assert arm.happened[-1] == "finalize"
    assert set(arm.happened[1:-1]) == {"compute"}
    assert runner.state is LifecycleState.FINALIZE


def test_a_failing_compute_is_an_emergency_that_ends_by_itself(
    runner: Runner, about: ComponentProxy, caplog: pytest.LogCaptureFixture
) -> None:
    arm = arm_of(runner)
    wait_until(lambda: "compute" in arm.happened)
    arm.failing = True
    wait_until(lambda: arm.happened.count("restore") >= 2)
    info = about.getInfo()
    assert info.state in (LifeState.Emergency, LifeState.Restore)
    assert re.search(
        r"RuntimeError: the arm does not move \(.*test_component\.py:\d+\)", info.reason
    )
    reports = [r for r in caplog.records if "the arm does not move" in r.getMessage()]
    assert len([r for r in reports if r.levelno == logging.ERROR]) == 1
    arm.failing = False
    wait_until(lambda: runner.state is LifecycleState.COMPUTE)
    assert about.getInfo().reason == ""
    assert about.getStatistics().failures >= 2


def test_a_declared_emergency_lasts_until_it_is_ended(
    runner: Runner, caplog: pytest.LogCaptureFixture
) -> None:
    arm = arm_of(runner)
    wait_until(lambda: "compute" in arm.happened)
    for _ in range(3):
        arm.declare_emergency("the button")
    assert [r.getMessage() for r in caplog.records].count("emergency: the button") == 1
    wait_until(lambda: arm.happened.count("emergency") >= 3)
    assert "restore" not in arm.happened
    assert runner.lifecycle.reason == "the button"
    arm.end_emergency()
    wait_until(lambda: runner.state is LifecycleState.COMPUTE)
    assert "restore" in arm.happened


def test_an_emergency_that_initialize_declares_is_one_from_the_beginning() -> None:
    class Careful(Arm):
        def initialize(self) -> None:
            super().initialize()
            self.declare_emergency("the brakes are on")

    careful = Runner(Careful, ArmParams.load(), RunSettings(domain=uuid.uuid4().hex[:8]))
    careful.start()
    arm = arm_of(careful)
    wait_until(lambda: arm.happened.count("emergency") >= 3)
    assert (careful.state, careful.lifecycle.reason) == (
        LifecycleState.EMERGENCY,
        "the brakes are on",
    )
    assert "compute" not in arm.happened
    arm.end_emergency()
    wait_until(lambda: careful.state is LifecycleState.COMPUTE)
    careful.stop()
    assert careful.wait()


def test_a_failing_initialize_ends_the_component(caplog: pytest.LogCaptureFixture) -> None:
    class Lame(Arm):
        def initialize(self) -> None:
            raise OSError("no such bus")

    lame = Runner(Lame, ArmParams.load(), RunSettings(domain=uuid.uuid4().hex[:8]))
    lame.start()
    assert not lame.wait()
    assert arm_of(lame).happened == ["finalize"]
    assert re.search(r"initialize failed: OSError: no such bus \(.*:\d+\)", caplog.text)


def test_a_period_that_is_too_short_is_counted() -> None:
    class Slow(Arm):
        def compute(self) -> None:
            until = time.perf_counter() + 0.004
            while time.perf_counter() < until:
                pass
            self.happened.append("compute")

    slow = Runner(Slow, ArmParams.load(), RunSettings(domain=uuid.uuid4().hex[:8]))
    slow.start()
    wait_until(lambda: slow.statistics.overruns >= 3)
    slow.stop()
    assert slow.wait()


def test_introspection(runner: Runner, about: ComponentProxy) -> None:
    wait_until(lambda: runner.statistics.computes.count > 3)
    info = about.getInfo()
    assert (info.name, info.component, info.pid) == ("arm", "arm", os.getpid())
    assert info.state is LifeState.Compute
    rate, device = about.getParameters()
    assert (rate.name, rate.unit, rate.low, rate.high, rate.live) == (
        "rate",
        "Hz",
        "1",
        "100",
        True,
    )
    assert (device.value, device.live) == ("/dev/null", False)
    figures = about.getStatistics()
    assert figures.period == 1
    assert figures.cycles > 3
    assert "getInfo" in {operation.operation for operation in figures.operations}


def test_parameters_change_live_or_not_at_all(runner: Runner, about: ComponentProxy) -> None:
    arm = arm_of(runner)
    about.setParameters({"rate": "20"})
    assert arm.params.rate == 20
    wait_until(lambda: "rate was 50" in arm.happened)
    for changes, message in (
        ({"rate": "500"}, "100"),
        ({"rate": "fast"}, "number"),
        ({"rates": "20"}, "rate"),
        ({"device": "/dev/tty"}, "live"),
    ):
        with pytest.raises(Refusal) as caught:
            about.setParameters(changes)
        assert message in caught.value.reason
    arm.refusing = True
    with pytest.raises(Refusal) as caught:
        about.setParameters({"rate": "30"})
    assert "not while moving" in caught.value.reason
    assert arm.params.rate == 20


def test_the_period_changes_live(runner: Runner, about: ComponentProxy) -> None:
    arm = arm_of(runner)
    about.setPeriod(0)
    wait_until(lambda: runner.lifecycle.period_ms == 0)
    with pytest.raises(Refusal):
        about.setPeriod(-1)
    count = arm.happened.count("compute")
    about.setPeriod(1)
    wait_until(lambda: arm.happened.count("compute") > count + 2)


def test_log_levels(about: ComponentProxy) -> None:
    before = logging.getLogger().level
    try:
        about.setLogLevel("error")
        assert logging.getLogger().level == logging.ERROR
        with pytest.raises(Refusal, match="loud"):
            about.setLogLevel("loud")
    finally:
        logging.getLogger().setLevel(before)


def test_stop_from_outside(runner: Runner, about: ComponentProxy) -> None:
    about.stop()
    assert runner.wait()


@pytest.mark.parametrize("text", ["laser", "=base", "laser=", "laser=a b", "laser=*"])
def test_wires_that_cannot_be_read(text: str) -> None:
    with pytest.raises(InvalidSetting):
        parse_connections([text])


@pytest.mark.parametrize(
    "text", ["laser", "laser=fast", "laser=depth=0", "laser=depth=x", "laser=priority=urgent"]
)
def test_qualities_that_cannot_be_read(text: str) -> None:
    with pytest.raises(InvalidSetting):
        parse_qos([text])


def test_qualities() -> None:
    qualities = parse_qos(["laser=best_effort,depth=1", "laser=priority=high,deadline=40"])
    assert qualities == {"laser": Qos(False, 1, "high", 0.04)}


# The program.

PROGRAM = """
import sys, time
from robocomp_dsl.runtime import Component, ComponentSpec, main
from robocomp_dsl.runtime.parameters import Parameter, Parameters
class P(Parameters):
    SCHEMA = (Parameter("rate", "float", default=50.0, low=1, high=100),)
class C(Component):
    SPEC = ComponentSpec(name="c", period=5, parameters=P)
    def initialize(self):
        self.log.info("started with %s", self.params.rate)
    def compute(self):
        if "--hang" in EXTRA:
            self.log.info("hanging")
            while True: pass
    def finalize(self):
        self.log.info("finalized")
EXTRA = [a for a in sys.argv if a == "--hang"]
sys.argv = [a for a in sys.argv if a not in EXTRA]
raise SystemExit(main(C))
"""


class Program:
    def __init__(self, folder: Path) -> None:
        self.folder = folder
        (folder / "program.py").write_text(PROGRAM)

    def start(self, *arguments: str, prefix: Sequence[str] = ()) -> subprocess.Popen[str]:
        domain = f"test-{uuid.uuid4().hex[:8]}"
        return subprocess.Popen(
            [*prefix, sys.executable, "program.py", "--domain", domain, *arguments],
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def run(self, *arguments: str) -> tuple[int, str]:
        with self.start(*arguments) as process:
            _, err = process.communicate(timeout=DEADLINE)
            return process.returncode, err


@pytest.fixture
def program(tmp_path: Path) -> Program:
    return Program(tmp_path)


def until(process: subprocess.Popen[str], text: str) -> list[str]:
    assert process.stderr
    lines = []
    for line in process.stderr:
        lines.append(line)
        if text in line:
            return lines
    raise AssertionError("".join(lines))


@pytest.mark.parametrize("middleware", ["inproc", "zenoh"])
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_ends_it_in_order(program: Program, middleware: str, number: int) -> None:
    with program.start("--middleware", middleware) as process:
        until(process, "started with 50.0")
        process.send_signal(number)
        _, err = process.communicate(timeout=DEADLINE)
    assert process.returncode == 0
    assert "finalized" in err


def test_sigint_ends_a_background_job_in_order(program: Program) -> None:
    with program.start("--middleware", "inproc", prefix=IGNORING_INTERRUPT) as process:
        until(process, "started with 50.0")
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=DEADLINE)
    assert process.returncode == 0
    assert "finalized" in err


def test_a_compute_that_never_ends_is_left_behind(program: Program) -> None:
    with program.start("--hang", "--middleware", "inproc") as process:
        until(process, "hanging")
        process.terminate()
        _, err = process.communicate(timeout=DEADLINE)
    assert process.returncode == 1
    assert "compute did not return within 2 s" in err


def test_json_lines(program: Program) -> None:
    with program.start("--log-format", "json", "--name", "mine", "--set", "rate=7") as process:
        record = json.loads(until(process, "started")[-1])
        process.terminate()
        process.communicate(timeout=DEADLINE)
    assert (record["component"], record["level"], record["message"]) == (
        "mine",
        "INFO",
        "started with 7.0",
    )
    assert record["pid"] == process.pid


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        (["--set", "rate=500"], 1, "rate"),
        (["--set", "rates=5"], 1, "did you mean `rate`"),
        (["--config", "nowhere.yaml"], 1, "nowhere.yaml"),
        (["--middleware", "corba"], 1, "unknown middleware `corba`; known: inproc"),
        (["--connect", "laser=base"], 2, "c has no port `laser`"),
        (["--qos", "x"], 2, "write PORT="),
        (["--name", "a/b"], 2, "`a/b` is not a valid name"),
        (["--listen-port", "99999"], 2, "not a port number"),
        (["--nonsense"], 2, "--nonsense"),
    ],
)
def test_what_cannot_be_started_says_why(
    program: Program, arguments: list[str], code: int, says: str
) -> None:
    found, err = program.run(*arguments)
    assert found == code
    assert says in err
    assert "Traceback" not in err


def test_a_wrong_configuration_is_located(program: Program) -> None:
    (program.folder / "etc").mkdir()
    (program.folder / "etc/config.yaml").write_text("# mine\nrate: fast\n")
    code, err = program.run()
    assert code == 1
    assert "etc/config.yaml:2:7" in err
