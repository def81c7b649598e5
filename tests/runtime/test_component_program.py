"""The program of a component: signals, exit codes and log output."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import uuid
from collections.abc import Sequence
from pathlib import Path

import pytest

from tests.support.background_job import IGNORING_INTERRUPT

DEADLINE = 60.0


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


def read_until(process: subprocess.Popen[str], text: str) -> list[str]:
    assert process.stderr
    lines = []
    for line in process.stderr:
        lines.append(line)
        if text in line:
            return lines
    raise AssertionError("".join(lines))


@pytest.mark.parametrize("middleware", ["inproc", "zenoh"])
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_program_finalizes_on_signal(program: Program, middleware: str, number: int) -> None:
    with program.start("--middleware", middleware) as process:
        read_until(process, "started with 50.0")
        process.send_signal(number)
        _, err = process.communicate(timeout=DEADLINE)
    assert process.returncode == 0
    assert "finalized" in err


def test_program_in_background_job_finalizes_on_sigint(program: Program) -> None:
    with program.start("--middleware", "inproc", prefix=IGNORING_INTERRUPT) as process:
        read_until(process, "started with 50.0")
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=DEADLINE)
    assert process.returncode == 0
    assert "finalized" in err


def test_program_exits_although_compute_never_returns(program: Program) -> None:
    with program.start("--hang", "--middleware", "inproc") as process:
        read_until(process, "hanging")
        process.terminate()
        _, err = process.communicate(timeout=DEADLINE)
    assert process.returncode == 1
    assert "compute did not return within 2 s" in err


def test_program_logs_json_lines(program: Program) -> None:
    with program.start("--log-format", "json", "--name", "mine", "--set", "rate=7") as process:
        record = json.loads(read_until(process, "started")[-1])
        process.terminate()
        process.communicate(timeout=DEADLINE)
    assert (record["component"], record["level"], record["message"]) == (
        "mine",
        "INFO",
        "started with 7.0",
    )
    assert record["pid"] == process.pid


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["--set", "rate=500"], 1, "rate"),
        (["--set", "rates=5"], 1, "did you mean `rate`"),
        (["--config", "nowhere.yaml"], 1, "nowhere.yaml"),
        (["--middleware", "corba"], 1, "unknown middleware `corba`; known: dds"),
        (["--connect", "laser=base"], 2, "c has no port `laser`"),
        (["--qos", "x"], 2, "write PORT="),
        (["--name", "a/b"], 2, "`a/b` is not a valid name"),
        (["--listen-port", "99999"], 2, "not a port number"),
        (["--nonsense"], 2, "--nonsense"),
    ],
)
def test_program_reports_start_error(
    program: Program, arguments: list[str], code: int, message: str
) -> None:
    found, err = program.run(*arguments)
    assert found == code
    assert message in err
    assert "Traceback" not in err


def test_program_locates_configuration_error(program: Program) -> None:
    (program.folder / "etc").mkdir()
    (program.folder / "etc/config.yaml").write_text("# mine\nrate: fast\n")
    code, err = program.run()
    assert code == 1
    assert "etc/config.yaml:2:7" in err
