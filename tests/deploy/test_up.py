"""`rcdeploy` with generated components over zenoh, in processes, as a user has it."""

from __future__ import annotations

import json
import os
import re
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.deploy.supervisor import reaper
from tests.deploy.deploy_process import Running, runtime_folder
from tests.deploy.deploy_robot import build
from tests.support.waiting import wait_until

PROGRAM = "from robocomp_dsl.cli.rcdeploy.main import main; main()"
ARM = """
class SpecificWorker(GenericWorker):
    def initialize(self):
        print("arm begins with", self.params.serial, self.params.rate, os.environ.get("MODE"))
    def finalize(self):
        print("arm finalizes")
    def Laser_getLaserData(self):
        self.log.info("asked by a client")
        return TLaserData([TData(0.5, float(os.getpid()))])
"""
EYE = """
class SpecificWorker(GenericWorker):
    seen = 0
    def compute(self):
        server = int(self.laser_proxy.getLaserData()[0].dist)
        if server != self.seen:
            print("eye sees a new arm", server)
        self.seen = server
    def finalize(self):
        print("eye finalizes")
"""
APP = """
import "arm/arm.cdsl";
import "eye/eye.cdsl";
Deployment app
{
    component arm { set serial = "abc"; set rate = 20; env MODE = fast; ready within 200 s; };
    component eye { after arm; ready within 200 s; };
};
"""


@pytest.fixture
def sockets(monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Where the processes of the test find each other."""
    with runtime_folder(monkeypatch) as path:
        monkeypatch.setenv("XDG_STATE_HOME", str(path.parent / "state"))
        yield path


@pytest.fixture
def folder(tmp_path: Path, sockets: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two generated components and their deployment."""
    monkeypatch.chdir(tmp_path)
    build(tmp_path, {"arm": ARM, "eye": EYE})
    (tmp_path / "app.ddsl").write_text(APP)
    return tmp_path


def up(*arguments: str) -> Running:
    return Running(sys.executable, "-c", PROGRAM, "app.ddsl", *arguments)


def rcdeploy(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", PROGRAM, *arguments],
        capture_output=True, text=True, check=False, timeout=60,
    )  # fmt: skip


def status(name: str = "app") -> dict[str, Any]:
    answer = rcdeploy("status", name, "--format", "json")
    assert answer.stdout, answer.stderr
    found: dict[str, Any] = json.loads(answer.stdout)
    return found


def pid_in(line: str) -> int:
    """The last number of a line."""
    return int(re.findall(r"\d+", line)[-1])


def test_from_start_to_ctrl_c(folder: Path, sockets: Path) -> None:
    with up() as app:
        arm = pid_in(app.until("all 2 components are ready", "eye sees a new arm"))
        state = status()
        assert [(c["name"], c["state"]) for c in state["components"]] == [
            ("arm", "ready"), ("eye", "ready"),
        ]  # fmt: skip
        assert state["components"][0]["pid"] == arm
        assert rcdeploy("app.ddsl", "status").returncode == 0
        logs = rcdeploy("logs", "-c", "arm").stdout
        assert "arm begins with abc 20.0 fast" in logs
        assert "asked by a client" in logs
        assert "eye" not in logs
        app.process.send_signal(signal.SIGINT)
        assert app.end() == 0
    messages = [line.partition("| ")[2] for line in app.lines]
    assert messages.index("eye finalizes") < messages.index("arm finalizes")
    assert "stopping: Ctrl-C" in messages
    assert reaper.find_processes(f"{state['domain']}.{app.process.pid}") == []
    assert [path.name for path in sockets.iterdir()] == [".deployments"]
    assert list((sockets / ".deployments").iterdir()) == []


def test_parameters_of_running_components(folder: Path) -> None:
    with up() as app:
        app.until("all 2 components are ready")
        listed = rcdeploy("param", "list", "app.ddsl").stdout.splitlines()
        row = ["arm", "rate", "20.0", "float", "1.0:1000.0", "[Hz]", "live"]
        assert listed[1].split() == row
        assert listed[-1] == "eye has no parameters"
        assert rcdeploy("param", "get", "app", "arm", "rate", "serial").stdout == "20.0\nabc\n"
        refused = rcdeploy("param", "set", "app.ddsl", "arm", "rate=30", "serial=x")
        assert refused.returncode == 1
        assert "`arm` rejects the change: `serial` is not live" in refused.stderr
        assert rcdeploy("param", "get", "app.ddsl", "arm", "rate").stdout == "20.0\n"
        done = rcdeploy("param", "set", "app.ddsl", "arm", "rate=30", "--save")
        saved = folder / "arm" / "etc" / "config.saved.yaml"
        assert done.stdout == (
            f"arm: rate = 30\nkept in {saved.resolve()}\n"
            "app.ddsl:6 has `set rate = 20;`, which overrides the saved value at the next start\n"
            "to write it there: rcdeploy param set app arm rate=30 --ddsl\n"
        )
        text = (folder / "app.ddsl").read_text()
        there = rcdeploy("app.ddsl", "param", "set", "arm", "rate=30", "--ddsl")
        assert there.stdout == f"arm: rate = 30\nwritten to {(folder / 'app.ddsl').resolve()}\n"
        assert (folder / "app.ddsl").read_text() == text.replace("rate = 20", "rate = 30")
        again = rcdeploy("param", "set", "app", "arm", "rate=30", "--ddsl", "--save").stdout
        assert "overrides" not in again
        assert '"rate": 30.0\n' in saved.read_text()
        data = json.loads(rcdeploy("param", "list", "app", "arm", "--format", "json").stdout)
        assert data["arm"][0]["value"] == "30.0"
        for wrong, hint in (
            (("get", "app", "arm", "rat"), "did you mean `rate`?"),
            (("get", "app", "amr", "rate"), "it has arm, eye"),
            (("get", "nothing", "arm", "rate"), "is not running"),
        ):
            run = rcdeploy("param", *wrong)
            assert (run.returncode, hint in run.stderr) == (1, True), run.stderr
        assert rcdeploy("param", "set", "app", "arm", "rate").returncode == 2
        odd = rcdeploy("param", "set", "app", "arm", "rate=-5")
        assert (odd.returncode, "lowest value is 1 Hz" in odd.stderr) == (1, True), odd.stderr
        odd = rcdeploy("param", "set", "app", "arm", "rate=zwölf=12")
        assert (odd.returncode, "zwölf=12" in odd.stderr) == (1, True), odd.stderr
        arm = json.loads(rcdeploy("app.ddsl", "status", "--format", "json").stdout)["components"][0]
        os.kill(arm["pid"], signal.SIGSTOP)
        try:
            stuck = rcdeploy("param", "get", "app", "arm", "rate")
        finally:
            os.kill(arm["pid"], signal.SIGCONT)
        assert (stuck.returncode, stuck.stdout) == (1, "")
        assert "does not answer within 5 s" in stuck.stderr
        app.process.send_signal(signal.SIGINT)
        assert app.end() == 0


def test_components_are_stopped_and_started_by_name_and_by_hand(folder: Path) -> None:
    with up() as app:
        first = pid_in(app.until("eye sees a new arm"))
        worker = folder / "arm" / "specificworker.py"
        worker.write_text(worker.read_text().replace("arm begins", "new arm begins"))
        (folder / "app.ddsl").write_text(APP.replace("rate = 20", "rate = 30"))
        done = rcdeploy("app.ddsl", "restart", "arm")
        assert (done.returncode, done.stderr) == (0, "")
        second = status()["components"][0]["pid"]
        assert done.stdout == f"arm: stopped\narm: ready (pid {second})\n"
        app.until("new arm begins with abc 30.0 fast")
        assert pid_in(app.until("eye sees a new arm")) == second != first

        stopped = rcdeploy("stop", "arm")
        assert stopped.stdout == "arm: stopped\nstill running without it: eye\n"
        (shown,) = json.loads(rcdeploy("status", "--format", "json").stdout)
        assert [c["state"] for c in shown["components"]] == ["exited", "ready"]
        lines = rcdeploy("plan", "app.ddsl").stdout.splitlines()
        (line,) = [line for line in lines if "--name arm" in line]
        with Running("sh", "-c", line, where=Path("/")) as by_hand:
            by_hand.until("new arm begins with abc 30.0 fast")
            third = pid_in(app.until("eye sees a new arm"))
            assert third not in (first, second)
            os.kill(third, signal.SIGTERM)
            assert by_hand.end() == 0

        (folder / "app.ddsl").write_text(APP.replace("rate = 20", "raet = 20"))
        refused = rcdeploy("start", "app", "arm")
        assert refused.returncode == 1
        assert "app.ddsl has errors; nothing was changed" in refused.stdout
        (folder / "app.ddsl").write_text(APP)
        assert rcdeploy("start").returncode == 0
        app.until("new arm begins with abc 20.0 fast")
        app.process.terminate()
        assert app.end() == 0


def test_up_runs_on_a_full_disk_and_ends_with_its_reader(folder: Path) -> None:
    command = [sys.executable, "-c", PROGRAM, "app.ddsl"]
    with Path("/dev/full").open("w") as full:
        process = subprocess.Popen(command, stdout=full, stderr=full, start_new_session=True)
    try:
        wait_until(lambda: "all 2 components are ready" in rcdeploy("logs").stdout)
        assert "standard output refuses log lines (No space left" in rcdeploy("logs").stdout
        assert [row["state"] for row in status()["components"]] == ["ready", "ready"]
        process.terminate()
        assert process.wait(60) == 0
    finally:
        process.kill()
    reader, writer = os.pipe()
    os.close(reader)
    with os.fdopen(writer) as pipe:
        closed = subprocess.run(
            command, stdout=pipe, stderr=subprocess.PIPE, text=True, check=False, timeout=60
        )
    assert (closed.returncode, closed.stderr) == (141, "error: output closed (broken pipe)\n")


def test_logs_are_kept_after_the_end_and_after_a_crash(folder: Path) -> None:
    with up() as app:
        app.until("eye sees a new arm")
        with Running(sys.executable, "-c", PROGRAM, "logs", "-f", "--json") as follower:
            follower.until("eye sees a new arm")
            app.process.terminate()
            assert app.end() == 0
            assert follower.end() == 0
    followed = [json.loads(line) for line in follower.lines]
    assert [r["sequence"] for r in followed] == list(range(1, len(followed) + 1))
    assert [r["text"] for r in followed[-2:]] == ["eye finalizes", "arm finalizes"]
    with up() as app:
        app.until("all 2 components are ready")
        wait_until(lambda: "components are ready" in rcdeploy("logs").stdout)
        app.process.kill()
        app.end()
        killed_pids = [int(x) for x in re.findall(r"pid (\d+)", "\n".join(app.lines))]
        reaper._wait_for_exit(killed_pids, 60)
    crashed = rcdeploy("logs", "app.ddsl")
    assert (crashed.returncode, crashed.stderr) == (0, "")
    assert "all 2 components are ready" in crashed.stdout
    assert "finalizes" not in crashed.stdout
    before = rcdeploy("logs", "--run", "-1", "--json").stdout.splitlines()
    assert [json.loads(line) for line in before] == followed
    assert rcdeploy("logs", "--run", "1", "--json").stdout.splitlines() == before
    matched = rcdeploy("logs", "app", "--run", "-1", "--grep", "final.zes", "-c", "arm").stdout
    assert [line.partition("| ")[2] for line in matched.splitlines()] == ["arm finalizes"]
    assert rcdeploy("logs", "--level", "error", "--since", "1 h").stdout == ""
    runs = rcdeploy("logs", "--runs").stdout.splitlines()
    assert runs[0].endswith("exit code 0: SIGTERM")
    assert runs[1].endswith("killed: rcdeploy could not end it")
    for wrong, code, message in (
        (("--run", "-2"), 1, "there is no run -2 of `app`"),
        (("--grep", "("), 2, "`(` is not a regular expression"),
        (("--since", "soon"), 2, "`soon` is no time"),
        (("-c", "amr"), 1, "there is no component `amr`"),
        (("other",), 1, "`other` is not running and has no stored logs; stored: app"),
    ):
        result = rcdeploy("logs", *wrong)
        assert (result.returncode, message in result.stderr) == (code, True), result.stderr


def test_a_killed_component_comes_back_and_its_client_goes_on(folder: Path) -> None:
    with up() as app:
        first = pid_in(app.until("eye sees a new arm"))
        os.kill(first, signal.SIGKILL)
        app.until("arm: killed by SIGKILL, restarting in 0.1 s")
        second = pid_in(app.until("eye sees a new arm"))
        assert second != first
        rows = status()["components"]
        assert [(row["name"], row["restarts"]) for row in rows] == [("arm", 1), ("eye", 0)]
        stopped = rcdeploy("app.ddsl", "stop")
        assert (stopped.returncode, stopped.stdout) == (0, "app: requested by `rcdeploy stop`\n")
        assert app.end() == 0


GROUPED = """
import "arm/arm.cdsl";
import "eye/eye.cdsl";
Deployment app
{
    host desk { address "127.0.0.1"; };
    group left on desk
    {
        component arm { set serial = "abc"; ready within 200 s; };
        component eye { after arm; ready within 200 s; };
        export Laser from arm;
    };
    component eye on localhost { after left; ready within 200 s; };
};
"""


def test_groups_run(folder: Path) -> None:
    (folder / "app.ddsl").write_text(GROUPED)
    with up() as app:
        app.until("all 3 components are ready")
        while sum("eye sees a new arm" in line for line in app.lines) < 2:
            app.until("eye sees a new arm")
        rows = status()["components"]
        assert [c["name"] for c in rows] == ["left-arm", "left-eye", "eye"]
        app.process.send_signal(signal.SIGINT)
        assert app.end() == 0
    seen = [pid_in(line) for line in app.lines if "eye sees a new arm" in line]
    assert seen == [rows[0]["pid"]] * 2


def test_one_group_runs_alone(folder: Path) -> None:
    (folder / "app.ddsl").write_text(GROUPED)
    with up("--group", "left") as app:
        app.until("all 2 components are ready", "eye sees a new arm")
        rows = status("app-left")["components"]
        assert [c["name"] for c in rows] == ["left-arm", "left-eye"]
        stopped = rcdeploy("stop", "app-left")
        assert stopped.returncode == 0
        assert app.end() == 0
    unknown = rcdeploy("plan", "app.ddsl", "--group", "right")
    assert unknown.returncode == 2
    assert "`app` has no group `right`; its groups: left" in unknown.stderr


def test_its_own_fixed_port_is_not_held_against_a_running_deployment(folder: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    (folder / "app.ddsl").write_text(APP.replace("env MODE", f"port {port}; env MODE"))
    with up() as app:
        app.until("all 2 components are ready")
        assert rcdeploy("app.ddsl", "check").returncode == 0
        assert f"--listen-port {port}" in rcdeploy("app.ddsl", "plan").stdout
        again = rcdeploy("app.ddsl")
        assert again.returncode == 1
        assert "`app` is already running (pid" in again.stderr
        other = rcdeploy("app.ddsl", "--name", "other")
        assert other.returncode == 1
        assert f"port {port} cannot be used" in other.stderr
        app.process.terminate()
        assert app.end() == 0


def test_two_of_the_same_file_do_not_see_each_other(folder: Path) -> None:
    with up() as first:
        first.until("all 2 components are ready")
        with up() as refused:
            assert refused.end() == 1
            assert refused.has(f"`app` is already running (pid {first.process.pid},")
        with up("--name", "other") as other:
            server = pid_in(other.until("eye sees a new arm"))
            assert server == next(
                row["pid"] for row in status("other")["components"] if row["name"] == "arm"
            )
            unclear = rcdeploy("stop", "app.ddsl")
            assert unclear.returncode == 1
            assert "several deployments are running" in unclear.stderr
            assert rcdeploy("stop", "other").returncode == 0
            assert other.end() == 0
        assert [row["state"] for row in status("app")["components"]] == ["ready", "ready"]
        first.process.terminate()
        assert first.end() == 0
    assert not first.has("AmbiguousServer")


def test_killed_rcdeploy_lets_components_finalize(folder: Path, sockets: Path) -> None:
    with up() as app:
        app.until("all 2 components are ready")
        token = f"{status()['domain']}.{app.process.pid}"
        running = reaper.find_processes(token)
        assert len(running) == 2
        app.process.kill()
        app.end()
        reaper._wait_for_exit(running, 30)
        assert reaper.find_processes(token) == []
    assert [path.name for path in sockets.iterdir()] == [".deployments"]
    # Its name is free at once, although nobody gave it back.
    with up("--duration", "0") as again:
        assert again.end() == 0


FAILING = """
class SpecificWorker(GenericWorker):
    def initialize(self):
        raise RuntimeError("no such device")
"""


def test_a_component_that_cannot_initialize_ends_the_deployment(folder: Path) -> None:
    text = (folder / "arm" / "specificworker.py").read_text()
    head = text.partition("class SpecificWorker")[0]
    (folder / "arm" / "specificworker.py").write_text(head + FAILING)
    (folder / "app.ddsl").write_text(APP.replace("env MODE", "restart on-failure max 1; env MODE"))
    with up() as app:
        assert app.end() == 1
    assert app.has("initialize failed")
    assert app.has("arm failed permanently: exit code 1 (restart limit reached: 1 in 60 s")
    assert app.lines[-1] == "error: failed: arm"
    assert not app.has("eye is ready")


def test_a_port_in_use_starts_nothing(folder: Path, sockets: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        (folder / "app.ddsl").write_text(APP.replace("env MODE", f"port {port}; env MODE"))
        with up() as app:
            assert app.end() == 1
    assert app.has(f"port {port} cannot be used: Address already in use")
    assert [path.name for path in sockets.iterdir()] == [".deployments"]  # no domain was opened


def test_a_named_domain_may_be_joined_by_hand(folder: Path) -> None:
    with up("--domain", "lab", "--duration", "1000") as app:
        app.until("all 2 components are ready")
        command = [sys.executable, "main.py", "--name", "guest", "--domain", "lab"]
        with Running(*command, where=folder / "eye") as guest:
            guest.until("eye sees a new arm")
            guest.process.terminate()
            assert guest.end() == 0
        app.process.terminate()
        assert app.end() == 0
