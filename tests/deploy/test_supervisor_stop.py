"""The supervisor stops components: signals, deadlines, and nothing left behind."""

from __future__ import annotations

import time
from pathlib import Path

from robocomp_dsl.deploy.supervisor.run_options import Options, Outcome
from robocomp_dsl.model.deployment import Restart
from tests.deploy.scripted_processes import STEADY, scripted_process
from tests.deploy.supervisor_run import TIMEOUT_S, SupervisorRun, stop


def test_supervisor_kills_component_that_ignores_sigterm(tmp_path: Path) -> None:
    ignoring = scripted_process(
        tmp_path, "a", 'signal.signal(15, signal.SIG_IGN); report("compute"); wait()'
    )
    run = SupervisorRun(tmp_path, ignoring, options=Options(grace_s=0.3)).on("a is ready", stop)
    assert run.run() == Outcome(1, "failed: a")
    assert "a did not exit within 0.3 s and was killed" in run.texts("rcdeploy")
    assert run.row("a").note == "killed by SIGKILL while stopping"


def test_second_stop_request_kills_all_components(tmp_path: Path) -> None:
    ignoring = 'signal.signal(15, lambda *_: print("ignoring")); report("compute"); wait()'
    run = SupervisorRun(
        tmp_path, scripted_process(tmp_path, "a", ignoring), options=Options(grace_s=TIMEOUT_S)
    )
    run.on("a is ready", stop).on("a: ignoring", stop)
    began = time.monotonic()
    assert run.run().code == 1
    assert time.monotonic() - began < TIMEOUT_S / 2


def test_supervisor_stop_timeout_bounds_whole_shutdown(tmp_path: Path) -> None:
    ignoring = 'signal.signal(15, signal.SIG_IGN); report("compute"); wait()'
    chain = [
        scripted_process(tmp_path, f"a{i}", ignoring, stops_after=(f"a{i + 1}",) if i < 4 else ())
        for i in range(5)
    ]
    run = SupervisorRun(tmp_path, *chain, options=Options(grace_s=10, stop_timeout_s=0.5))
    assert run.on("all 5 components are ready", stop).run().code == 1


def test_supervisor_stops_while_component_starts(tmp_path: Path) -> None:
    starting = scripted_process(tmp_path, "a", 'report("initialize"); print("starting up"); wait()')
    run = SupervisorRun(tmp_path, starting, scripted_process(tmp_path, "b", STEADY, after=("a",)))
    run.on("a: starting up", stop)
    assert run.run().code == 0
    assert run.row("b").note == "not started: a was not ready"


def test_supervisor_stops_while_restart_is_pending(tmp_path: Path) -> None:
    run = SupervisorRun(
        tmp_path, scripted_process(tmp_path, "a", "sys.exit(1)", restart=Restart(max=90))
    )
    run.on("restarting in 0.4 s", stop)
    assert run.run().code == 0


def test_supervisor_ends_descendants_of_component(tmp_path: Path) -> None:
    # A child in the process group, and a daemon that left it.
    body = """
import subprocess
inside = subprocess.Popen([sys.executable, "-S", "-c", "import time; time.sleep(600)"])
escaped = subprocess.Popen([sys.executable, "-S", "-c", "import time; time.sleep(600)"],
                           start_new_session=True)
print("started"); report("compute"); wait()
"""
    run = SupervisorRun(tmp_path, scripted_process(tmp_path, "a", body)).on("a is ready", stop)
    assert run.run().code == 0  # SupervisorRun.run asserts that no process remains


def test_supervisor_duration_starts_when_all_are_ready(tmp_path: Path) -> None:
    run = SupervisorRun(
        tmp_path, scripted_process(tmp_path, "a", STEADY), options=Options(duration_s=0.2)
    )
    assert run.run() == Outcome(0, "duration of 0.2 s is over")
