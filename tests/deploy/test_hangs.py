"""Processes that hang or cannot be loaded: noticed, ended in order, restarted by their policy."""

from __future__ import annotations

import asyncio
import os
from pathlib import Path

import pytest

from robocomp_dsl.deploy import status
from robocomp_dsl.deploy.status import ProcessStatus
from robocomp_dsl.deploy.supervisor.heartbeat import MIN_MARGIN_S
from robocomp_dsl.deploy.supervisor.run_options import Options, Outcome
from robocomp_dsl.model.deployment import Restart
from robocomp_dsl.runtime.component.hang_report import HangReport
from tests.deploy.scripted_processes import STEADY, scripted_process
from tests.deploy.supervisor_run import SupervisorRun, stop

ONCE = """
first = not os.path.exists("hung")
open("hung", "w").close()
def beat(text):
    os.write(int(os.environ["ROBOCOMP_HEARTBEAT_FD"]), f"{text}\\n".encode())
report("initialize"); report("compute")
"""
"""`first`: this is the first process; `beat(text)` writes a line to the supervisor."""
REPORT = HangReport(
    1.0, "compute", 2.0, "worker.py:7", ('  File "worker.py", line 7', "    wait()")
)


def restarted(tmp_path: Path, body: str, message: str, **options: float) -> SupervisorRun:
    """Run a process that hangs once, until its second start is ready; `message` is logged."""
    run = SupervisorRun(
        tmp_path, scripted_process(tmp_path, "a", ONCE + body), options=Options(**options)
    )

    def after_hang(run: SupervisorRun) -> None:
        assert run.row("a").state == status.HUNG
        run.on("restarting in", lambda run: run.on("a is ready", stop))

    run.on(message, after_hang)
    assert run.run() == Outcome(0, "test")
    assert run.row("a").restarts == 1
    assert run.row("a").hang is not None
    return run


def test_stopped_process_is_hung_finalized_and_restarted(tmp_path: Path) -> None:
    body = """
if first:
    beat(0.1)
    os.kill(os.getpid(), signal.SIGSTOP)
wait(); print("finalized")
"""
    run = restarted(tmp_path, body, "a: the process, stopped by a signal, has hung")
    assert run.texts("a").count("finalized") == 2


def test_process_that_holds_the_interpreter_is_killed_and_its_stack_kept(tmp_path: Path) -> None:
    body = """
import ctypes, faulthandler
if first:
    def blocked_in_c():
        ctypes.PyDLL(None).sleep(100)
    faulthandler.dump_traceback_later(0.05)
    beat(0.1)
    blocked_in_c()
wait()
"""
    run = restarted(tmp_path, body, "a: the process has hung", grace_s=0.1)
    hang = run.row("a").hang
    assert hang
    assert any("in blocked_in_c" in line for line in hang.stack)
    assert "a.py:" in hang.location


def test_reported_hang_that_does_not_end_is_killed_after_grace(tmp_path: Path) -> None:
    body = f"""
if first:
    beat(0.1)
    beat({REPORT.to_json()!r})
    threading.Event().wait()
wait()
"""
    run = SupervisorRun(
        tmp_path, scripted_process(tmp_path, "a", ONCE + body), options=Options(grace_s=0.1)
    )
    run.on(f"a: {REPORT.summary()}, restarting", lambda run: run.on("a is ready", stop))
    assert run.run().code == 0
    assert run.row("a").hang == REPORT


def test_heartbeat_reader_ignores_garbage_and_end_of_heartbeats(tmp_path: Path) -> None:
    body = """
beat("nonsense"); beat('{"at": []}'); beat("{"); beat("\\xff"); beat(0.05); beat(0)
os.close(int(os.environ["ROBOCOMP_HEARTBEAT_FD"]))
report("compute"); wait()
"""
    run = SupervisorRun(
        tmp_path,
        scripted_process(tmp_path, "a", ONCE + body),
        scripted_process(tmp_path, "b", STEADY),
    )
    silence_s = MIN_MARGIN_S + 0.1
    run.on(
        "all 2 components are ready",
        lambda run: asyncio.get_running_loop().call_later(2 * silence_s, stop, run),
    )
    assert run.run().code == 0
    assert run.row("a").hang is None


def test_hang_in_first_initialize_is_restarted_by_policy(tmp_path: Path) -> None:
    body = """
report("initialize")
if not os.path.exists("hung"):
    open("hung", "w").close()
    wait(); sys.exit(0)
report("compute"); wait()
"""
    run = SupervisorRun(tmp_path, scripted_process(tmp_path, "a", body, start_timeout_s=1.0))
    run.on("a: not ready within 1 s (state: initialize), restarting", lambda r: r.on("ready", stop))
    assert run.run().code == 0
    assert run.row("a").restarts == 1


def test_starts_that_time_out_end_at_the_limit_however_far_apart(tmp_path: Path) -> None:
    policy = Restart(max=1, window_s=0.001)
    hanging = scripted_process(tmp_path, "a", "wait()", start_timeout_s=0.3, restart=policy)
    run = SupervisorRun(tmp_path, hanging)
    assert run.run() == Outcome(1, "failed: a")
    assert any("(not ready in 2 starts)" in text for text in run.texts("rcdeploy"))


@pytest.mark.parametrize(
    ("body", "error"),
    [
        ("import no_such_module_x", "ModuleNotFoundError: No module named 'no_such_module_x'"),
        ("from os import no_such_name", "ImportError: cannot import name 'no_such_name'"),
        ("import broken", "SyntaxError: "),
    ],
)
def test_program_that_cannot_be_loaded_is_not_restarted(
    tmp_path: Path, body: str, error: str
) -> None:
    (tmp_path / "broken.py").write_text("x = 1\ndef f(:\n")
    run = SupervisorRun(tmp_path, scripted_process(tmp_path, "a", body))
    assert run.run() == Outcome(1, "failed: a")
    assert run.row("a").restarts == 0
    reports = [text for text in run.texts("rcdeploy") if "failed permanently" in text]
    assert len(reports) == 1
    assert error in reports[0]
    place = "broken.py:2)" if "broken" in body else "a.py:"
    assert place in reports[0]


def test_caught_import_error_before_a_crash_is_restarted(tmp_path: Path) -> None:
    body = """
import traceback
try: import no_such_module_x
except ImportError: traceback.print_exc()
raise RuntimeError("crashed")
"""
    run = SupervisorRun(tmp_path, scripted_process(tmp_path, "a", body, restart=Restart(max=1)))
    assert run.run().code == 1
    assert run.row("a").restarts == 1


def test_exited_process_is_never_ready(tmp_path: Path) -> None:
    """The state that a process has published may arrive after its exit."""
    run = SupervisorRun(
        tmp_path, scripted_process(tmp_path, "a", "os._exit(3)", restart=Restart("never"))
    )

    late: list[bool] = []

    def publish_late(run: SupervisorRun) -> None:
        process = run.engine._processes["a"]
        assert process.child
        # The event loop is here, so it cannot notice the exit yet.
        os.waitid(os.P_PID, process.child.pid, os.WEXITED | os.WNOWAIT)
        process.on_state_changed(process.child.pid, "compute")
        late.append(process.ready.is_set())

    def on_change() -> None:
        if run.row("a").pid and not late:
            asyncio.get_running_loop().call_soon(publish_late, run)

    run.changed = on_change
    run.run()
    assert late[0] is False
    assert not any("is ready" in text for text in run.texts("rcdeploy"))


def test_status_lists_hangs_with_stack() -> None:
    row = ProcessStatus("arm", status.READY, 4711, hang=REPORT)
    assert status.format_hangs([row], 13.0) == [
        "",
        "arm, 12.0 s ago: compute has hung for 2.0 s at worker.py:7",
        *REPORT.stack,
    ]
    assert ProcessStatus.from_dict(row.as_dict()) == row
