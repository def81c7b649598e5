"""Deployments as processes: signals, SIGKILL, control from other processes, several at once."""

from __future__ import annotations

import contextlib
import json
import os
import re
import signal
import sys
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from robocomp_dsl.cli.rcdeploy.main import program
from robocomp_dsl.deploy import control, instances
from robocomp_dsl.deploy.external_program import ExternalProgram
from robocomp_dsl.deploy.supervisor import reaper
from robocomp_dsl.host_tools.resource_limits import process_tree
from tests.deploy.rcdeploy_process import DEADLINE_S, RunningProcess, runtime_folder
from tests.deploy.scripted_processes import STEADY

SESSION = Path(__file__).with_name("scripted_session.py")
PAIR: list[dict[str, Any]] = [
    {"name": "a", "body": STEADY},
    {"name": "b", "body": STEADY, "after": ["a"]},
]


@pytest.fixture(autouse=True)
def sockets(monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    with runtime_folder(monkeypatch) as path:
        yield path


@pytest.fixture
def sessions() -> Iterator[ExitStack]:
    with ExitStack() as stack:
        yield stack


def start_session(
    sessions: ExitStack, where: Path, spec: list[dict[str, Any]], name: str = "demo"
) -> RunningProcess:
    command = (sys.executable, str(SESSION), str(where), name, json.dumps(spec))
    return sessions.enter_context(RunningProcess(*command))


def pids(name: str) -> list[int]:
    answer = next(control.send_request(name, {"verb": "status"}))
    return [row["pid"] for row in answer["rows"]]


def is_alive(pid: int) -> bool:
    """Whether it runs; an orphan that init has not reaped yet does not."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


def assert_ended(processes: list[int]) -> None:
    reaper._wait_for_exit(processes, DEADLINE_S)
    assert not [pid for pid in processes if is_alive(pid)]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_session_stops_in_reverse_order_on_signal(
    tmp_path: Path, sessions: ExitStack, number: signal.Signals
) -> None:
    session = start_session(sessions, tmp_path / "x", PAIR)
    session.until("all 2 components are ready")
    running = pids("demo")
    session.process.send_signal(number)
    assert session.end() == 0
    assert [line for line in session.lines if "finalized" in line] == [
        "b: finalized",
        "a: finalized",
    ]
    assert_ended(running)
    assert instances.running() == []


def test_terminal_ctrl_c_reaches_session_only(tmp_path: Path, sessions: ExitStack) -> None:
    body = 'signal.signal(2, lambda *_: print("hit")); ' + STEADY
    session = start_session(sessions, tmp_path / "x", [{"name": "a", "body": body}])
    session.until("the component is ready")
    os.killpg(session.process.pid, signal.SIGINT)  # as a terminal does
    assert session.end() == 0
    assert "a: hit" not in session.lines
    assert "a: finalized" in session.lines


def test_killed_session_leaves_no_process_and_components_finalize(
    tmp_path: Path, sessions: ExitStack
) -> None:
    note = tmp_path / "finalized"
    finalizing = f'report("compute"); wait(); open({str(note)!r}, "w").close()'
    ignoring = 'signal.signal(15, signal.SIG_IGN); report("compute"); wait()'
    daemon = """
import subprocess
child = subprocess.Popen([sys.executable, "-S", "-c", "import time; time.sleep(600)"],
                         start_new_session=True, stdout=-3, stderr=-3)
print("daemon", child.pid); report("compute"); wait()
"""
    spec = [{"name": n, "body": b} for n, b in (("a", finalizing), ("b", ignoring), ("c", daemon))]
    session = start_session(sessions, tmp_path / "x", spec)
    escaped = int(session.until("c: daemon").split()[-1])
    session.until("all 3 components are ready")
    running = [*pids("demo"), escaped]
    session.process.kill()
    session.end()
    assert_ended(running)
    assert note.exists()
    assert instances.running() == []
    start_session(sessions, tmp_path / "y", PAIR).until("all 2 components are ready")


def reaper_of(pid: int) -> int:
    """The pid of the reaper of the rcdeploy `pid`; 0 if it has none."""
    for child in process_tree(pid)[1:]:
        with contextlib.suppress(OSError):
            if "reaper.py" in Path(f"/proc/{child}/cmdline").read_text():
                return child
    return 0


def test_session_replaces_reaper_that_died(tmp_path: Path, sessions: ExitStack) -> None:
    session = start_session(sessions, tmp_path / "x", PAIR)
    session.until("all 2 components are ready")
    first = reaper_of(session.process.pid)
    os.kill(first, signal.SIGKILL)
    line = session.until(f"the reaper (pid {first})")
    assert "died (killed by SIGKILL); started another reaper" in line
    second = int(re.findall(r"pid (\d+)", line)[1])
    assert is_alive(second)
    running = pids("demo")
    assert all(map(is_alive, running))
    session.process.kill()
    session.end()
    assert_ended([*running, second])


def test_session_ends_after_reaper_died(tmp_path: Path, sessions: ExitStack) -> None:
    session = start_session(sessions, tmp_path / "x", PAIR)
    session.until("all 2 components are ready")
    os.kill(reaper_of(session.process.pid), signal.SIGKILL)
    session.process.terminate()
    assert session.end() == 0


def test_session_killed_during_start_leaves_no_process(tmp_path: Path, sessions: ExitStack) -> None:
    crash = 'print("life", os.getpid()); sys.exit(1)'
    spec = [{"name": f"c{i}", "body": crash} for i in range(4)]
    session = start_session(sessions, tmp_path / "x", spec)
    session.until("life")
    session.process.kill()
    session.end()
    lives = [int(line.split()[-1]) for line in session.lines if "life" in line]
    assert_ended(lives)
    token = f"demo-{tmp_path.name}-x.{session.process.pid}"
    assert_ended(reaper.find_processes(token))
    assert reaper.find_processes(token) == []


def test_control_socket_serves_status_logs_and_stop(tmp_path: Path, sessions: ExitStack) -> None:
    session = start_session(sessions, tmp_path / "x", PAIR)
    session.until("all 2 components are ready")
    (entry,) = instances.running()
    assert (entry.name, entry.pid) == ("demo", session.process.pid)
    rows = next(control.send_request("demo", {"verb": "status"}))["rows"]
    assert [(r["name"], r["state"], r["restarts"]) for r in rows] == [
        ("a", "ready", 0), ("b", "ready", 0),
    ]  # fmt: skip
    assert all(r["memory"] > 1e6 for r in rows)
    logs = list(control.send_request("demo", {"verb": "logs"}))
    assert "all 2 components are ready" in logs[-1]["text"]
    assert len(list(control.send_request("demo", {"verb": "logs", "last": 1}))) == 1
    following = control.send_request("demo", {"verb": "logs", "follow": True})
    assert next(following)["component"] == "rcdeploy"
    assert list(control.send_request("demo", {"verb": "stop"})) == [
        {"code": 0, "reason": "requested by `rcdeploy stop`"}
    ]
    rest = [f"{r['component']}: {r['text']}" for r in following]
    assert rest[-2:] == ["b: finalized", "a: finalized"]
    assert session.end() == 0
    with pytest.raises(instances.Unavailable, match="`demo` does not respond"):
        list(control.send_request("demo", {"verb": "status"}))


def test_status_shows_external_programs(tmp_path: Path, sessions: ExitStack) -> None:
    gui = ExternalProgram("gui", "ice", "", "requires", "RoboCompLaser::Laser", ("a", "b"))
    spec = [*PAIR, {"extern": gui.as_dict()}]
    start_session(sessions, tmp_path / "x", spec).until("all 2 components are ready")
    text = CliRunner().invoke(program, ["status", "demo"]).output.splitlines()
    assert text[-1] == "external gui: requires RoboCompLaser::Laser over ice, used by a, b"
    data = json.loads(CliRunner().invoke(program, ["status", "demo", "--format", "json"]).output)
    assert data["externals"] == [gui.as_dict()]
    assert [row["name"] for row in data["components"]] == ["a", "b"]


def test_session_rejects_name_in_use_with_pid(tmp_path: Path, sessions: ExitStack) -> None:
    session = start_session(sessions, tmp_path / "x", PAIR)
    session.until("all 2 components are ready")
    second = start_session(sessions, tmp_path / "y", PAIR)
    assert second.end() == 1
    who = f"pid {session.process.pid}, {tmp_path}/x/demo.ddsl"
    advice = "stop it, or use another --name"
    assert second.lines == [f"`demo` is already running ({who}); {advice}"]
    third = start_session(sessions, tmp_path / "z", PAIR, name="other")
    third.until("all 2 components are ready")
    assert [r.name for r in instances.running()] == ["demo", "other"]
    assert next(control.send_request("other", {"verb": "stop"}))["code"] == 0
    assert len(pids("demo")) == 2
    assert third.end() == 0


def test_control_socket_survives_invalid_requests(tmp_path: Path, sessions: ExitStack) -> None:
    session = start_session(sessions, tmp_path / "x", PAIR)
    session.until("all 2 components are ready")
    for nonsense in ({"verb": "dance"}, {"verb": "logs", "last": "many"}, {}, "text", [1]):
        assert list(control.send_request("demo", nonsense)) == []  # type: ignore[arg-type]
    assert list(control.send_request("demo", {"verb": "x" * 200_000})) == []
    assert len(pids("demo")) == 2
    session.process.send_signal(signal.SIGTERM)
    assert session.end() == 0


def test_instances_remove_stale_entries(tmp_path: Path) -> None:
    claim = instances.acquire("demo")
    claim.publish(instances.RunningDeployment("demo", "x.ddsl", "d", 2**22 - 1, 0.0))
    os.close(claim._lock)  # as the kernel does when a process is killed
    assert claim.folder.exists()
    assert instances.running() == []
    assert not claim.folder.exists()
    again = instances.acquire("demo")
    with pytest.raises(instances.Unavailable, match="already running"):
        instances.acquire("demo")
    again.release()
    instances.acquire("demo").release()


@pytest.mark.parametrize("name", ["", "..", "a/b", "-x", "a b", "x" * 65, "ü"])
def test_instances_reject_invalid_name(name: str) -> None:
    with pytest.raises(instances.Unavailable, match="is not a valid name"):
        instances.acquire(name)


def test_control_socket_works_below_long_path(
    tmp_path: Path, sessions: ExitStack, monkeypatch: pytest.MonkeyPatch
) -> None:
    deep = tmp_path / ("d" * 120)
    deep.mkdir()
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(deep))
    session = start_session(sessions, tmp_path / "x", PAIR)
    session.until("all 2 components are ready")
    assert next(control.send_request("demo", {"verb": "stop"}))["code"] == 0
    assert session.end() == 0
