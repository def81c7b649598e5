"""The supervisor with real processes: order, readiness, restarts, output and status."""

from __future__ import annotations

import json
import os
import signal
import time
from pathlib import Path

import pytest

from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.deploy.supervisor.run_options import Options, Outcome
from robocomp_dsl.model.deployment import Restart
from tests.deploy.scripted_processes import STEADY, scripted_process
from tests.deploy.supervisor_run import SupervisorRun, stop

NEVER = Restart("never")


def test_supervisor_starts_and_stops_in_dependency_order(tmp_path: Path) -> None:
    body = 'print("began"); ' + STEADY
    run = SupervisorRun(
        tmp_path,
        scripted_process(tmp_path, "base", body, stops_after=("nav", "log")),
        scripted_process(tmp_path, "nav", body, after=("base",), stops_after=("log",)),
        scripted_process(tmp_path, "log", body, after=("nav", "base")),
    ).on("all 3 components are ready", stop)
    assert run.run() == Outcome(0, "test")
    order = ["base: began", "base is ready", "nav: began", "nav is ready", "log: began",
             "log: finalized", "nav: finalized", "base: finalized"]  # fmt: skip
    places = [run.at(text) for text in order]
    assert places == sorted(places)
    assert {row.state for row in run.engine.statuses()} == {"exited"}


def test_independent_components_start_concurrently(tmp_path: Path) -> None:
    # Each becomes ready only when the other runs: a sequential start would never end.
    other = 'open(NAME, "w").close()\nwhile not os.path.exists("ab".replace(NAME, "")): pass\n'
    run = SupervisorRun(tmp_path, *(scripted_process(tmp_path, n, other + STEADY) for n in "ab"))
    assert run.on("all 2 components are ready", stop).run().code == 0


def test_supervisor_restarts_crashed_component_and_waits_for_readiness(tmp_path: Path) -> None:
    def kill(run: SupervisorRun) -> None:
        os.kill(run.row("a").pid, signal.SIGKILL)

    body = 'print("life", os.getpid()); report("initialize"); report("compute"); wait()'
    run = SupervisorRun(
        tmp_path, scripted_process(tmp_path, "a", body), scripted_process(tmp_path, "b", STEADY)
    )
    run.on("all 2 components are ready", kill)
    run.on("a: killed by SIGKILL, restarting in 0.1 s", lambda r: r.on("a is ready", stop))
    assert run.run().code == 0
    first, second = run.texts("a")
    assert first != second
    assert run.row("a").restarts == 1
    assert run.row("b").restarts == 0


def test_supervisor_restarts_with_backoff_up_to_limit(tmp_path: Path) -> None:
    crash = scripted_process(
        tmp_path, "a", "print('dying'); sys.exit(3)", restart=Restart(max=3, window_s=60)
    )
    run = SupervisorRun(tmp_path, crash, scripted_process(tmp_path, "b", STEADY))
    assert run.run() == Outcome(1, "failed: a")
    assert run.texts("a") == ["dying"] * 4
    lines = [t for t in run.texts("rcdeploy") if t.startswith(("a:", "a failed"))]
    assert lines == [
        "a: exit code 3, restarting in 0.1 s",
        "a: exit code 3, restarting in 0.2 s",
        "a: exit code 3, restarting in 0.4 s",
        "a failed permanently: exit code 3 (restart limit reached: 3 in 60 s)",
    ]
    assert "stopping: a failed" in run.texts("rcdeploy")
    assert run.row("b").state == "exited"


@pytest.mark.parametrize(
    ("policy", "body", "code", "lives", "state"),
    [
        ("never", "sys.exit(1)", 1, 1, "failed"),
        ("never", "report('compute')", 0, 1, "exited"),
        ("on-failure", "report('compute')", 0, 1, "exited"),
        ("always", "report('compute')", 0, 3, "exited"),
        ("always", "sys.exit(1)", 1, 3, "failed"),
        ("on-failure", "os.kill(os.getpid(), signal.SIGSEGV)", 1, 3, "failed"),
    ],
)
def test_supervisor_applies_restart_policy(
    tmp_path: Path, policy: str, body: str, code: int, lives: int, state: str
) -> None:
    script = f"print('life'); {body}"
    run = SupervisorRun(
        tmp_path, scripted_process(tmp_path, "a", script, restart=Restart(policy, 2, 60))
    )
    assert run.run().code == code
    assert run.texts("a") == ["life"] * lives
    assert run.row("a").state == state


def test_supervisor_stops_when_component_is_not_ready_in_time(tmp_path: Path) -> None:
    body = 'print("life"); report("initialize"); wait()'
    slow = scripted_process(
        tmp_path, "a", body, start_timeout_s=0.5, restart=Restart("on-failure", 1, 60)
    )
    never = scripted_process(tmp_path, "c", "print('never')", after=("a",))
    run = SupervisorRun(tmp_path, slow, scripted_process(tmp_path, "b", STEADY), never)
    assert run.run() == Outcome(1, "failed: a")
    assert run.texts("a") == ["life"] * 2
    assert run.row("a").note.startswith("not ready within 0.5 s")
    assert run.texts("c") == []
    assert run.row("c").note == "not started: a was not ready"


def test_supervisor_with_keep_going_continues_after_failure(tmp_path: Path) -> None:
    bad = scripted_process(tmp_path, "a", "sys.exit(2)", restart=NEVER)
    failed = tmp_path / "failed"
    body = (
        f'report("compute")\nwhile not os.path.exists({str(failed)!r}): pass\nprint("on"); wait()'
    )
    run = SupervisorRun(
        tmp_path, bad, scripted_process(tmp_path, "b", body), options=Options(keep_going=True)
    )
    run.on("a failed permanently", lambda _: failed.touch()).on("b: on", stop)
    assert run.run() == Outcome(1, "failed: a")


def test_exited_dependency_counts_as_ready(tmp_path: Path) -> None:
    once = scripted_process(tmp_path, "a", "print('set up')")
    run = SupervisorRun(tmp_path, once, scripted_process(tmp_path, "b", STEADY, after=("a",)))
    assert run.on("b is ready", stop).run().code == 0


def test_supervisor_reports_program_that_cannot_be_started(tmp_path: Path) -> None:
    (tmp_path / "plain").write_text("no program")
    process = Process("a", "a", ("./plain",), tmp_path, restart=Restart(max=1))
    run = SupervisorRun(tmp_path, process)
    assert run.run() == Outcome(1, "failed: a")
    assert run.row("a").note == "cannot be started: Permission denied"


def test_supervisor_merges_output_without_loss(tmp_path: Path) -> None:
    log = json.dumps({"time": time.time(), "level": "WARNING", "message": "careful"})
    body = f"""
print('plain')
print({log!r})
print("to stderr", file=sys.stderr)
os.write(1, b"not utf-8 \\xff\\n" + b"x" * 200000 + b"\\n")
report("compute"); wait()
sys.stdout.write("no line end")
"""
    run = SupervisorRun(tmp_path, scripted_process(tmp_path, "a", body)).on("a is ready", stop)
    assert run.run().code == 0
    by_stream = {s: [r for r in run.records if r.component == "a" and r.stream == s]
                 for s in ("stdout", "stderr", "log")}  # fmt: skip
    assert [r.text for r in by_stream["stderr"]] == ["to stderr"]
    assert [(r.level, r.text) for r in by_stream["log"]] == [("WARNING", "careful")]
    plain = [r.text for r in by_stream["stdout"]]
    assert plain[:2] == ["plain", "not utf-8 \N{REPLACEMENT CHARACTER}"]
    assert "".join(plain[2:-1]) == "x" * 200000
    assert plain[-1] == "no line end"


def test_supervisor_survives_flood_of_output(tmp_path: Path) -> None:
    flood = 'report("compute")\nwhile not stopped.is_set(): print("flood " * 20)'
    run = SupervisorRun(
        tmp_path, scripted_process(tmp_path, "a", flood), scripted_process(tmp_path, "b", STEADY)
    )
    assert run.on("all 2 components are ready", stop).run().code == 0


def test_supervisor_status_follows_lifecycle_reports(tmp_path: Path) -> None:
    body = """
for state in ("initialize", "compute", "emergency", "gone", "compute"):
    report(state)
wait()
"""
    run = SupervisorRun(tmp_path, scripted_process(tmp_path, "a", body))
    seen: list[tuple[str, str]] = []

    def changed() -> None:
        row = run.row("a")
        seen.append((row.state, row.life))
        if seen[-2:] == [("unknown", ""), ("ready", "compute")]:
            run.engine.stop("test")

    run.changed = changed
    assert run.run().code == 0
    steps = [step for step, before in zip(seen, [None, *seen], strict=False) if step != before]
    assert steps[:6] == [
        ("starting", ""), ("starting", "initialize"), ("ready", "compute"), ("ready", "emergency"),
        ("unknown", ""), ("ready", "compute"),
    ]  # fmt: skip


def test_supervisor_ignores_lifecycle_report_of_other_process(tmp_path: Path) -> None:
    impostor = scripted_process(
        tmp_path, "b", 'NAME = "a"; report("compute"); NAME = "b"; ' + STEADY
    )
    silent = scripted_process(tmp_path, "a", "wait()", start_timeout_s=0.5, restart=NEVER)
    assert SupervisorRun(tmp_path, silent, impostor).run() == Outcome(1, "failed: a")
