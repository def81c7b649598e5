"""`rcdeploy` with generated components over zenoh, in processes, as a user starts it."""

from __future__ import annotations

import json
import os
import signal
import sys
from pathlib import Path

from robocomp_dsl.deploy.supervisor import reaper
from tests.deploy.laser_app import last_number, start_app, status
from tests.deploy.rcdeploy_process import RunningProcess, rcdeploy


def test_up_runs_deployment_until_ctrl_c(app_folder: Path, socket_folder: Path) -> None:
    with start_app() as app:
        arm = last_number(app.until("all 2 components are ready", "eye sees a new arm"))
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
    assert sorted(path.name for path in socket_folder.iterdir()) == [".deployments", "token"]
    assert list((socket_folder / ".deployments").iterdir()) == []


def test_param_command_reads_and_sets_running_parameters(app_folder: Path) -> None:
    with start_app() as app:
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
        saved = app_folder / "arm" / "etc" / "config.saved.yaml"
        assert done.stdout == (
            f"arm: rate = 30\nkept in {saved.resolve()}\n"
            "app.ddsl:6 has `set rate = 20;`, which overrides the saved value at the next start\n"
            "to write it there: rcdeploy param set app arm rate=30 --ddsl\n"
        )
        text = (app_folder / "app.ddsl").read_text()
        there = rcdeploy("app.ddsl", "param", "set", "arm", "rate=30", "--ddsl")
        assert there.stdout == f"arm: rate = 30\nwritten to {(app_folder / 'app.ddsl').resolve()}\n"
        assert (app_folder / "app.ddsl").read_text() == text.replace("rate = 20", "rate = 30")
        lists = ("weights=2, 3", "weights[1]=4.5", 'names=["a, b", c]')
        assert rcdeploy("param", "set", "app", "arm", *lists, "--ddsl").returncode == 0
        shown = rcdeploy("param", "get", "app", "arm", "weights", "names").stdout
        assert shown == '[2.0, 4.5]\n["a, b", "c"]\n'
        written = (app_folder / "app.ddsl").read_text()
        assert "set weights = {2, 3};" in written
        assert "set weights[1] = 4.5;" in written
        assert 'set names = {"a, b", "c"};' in written
        assert rcdeploy("check", "app.ddsl").returncode == 0
        again = rcdeploy("param", "set", "app", "arm", "rate=30", "--ddsl", "--save").stdout
        assert "overrides" not in again
        assert '"rate": 30.0\n' in saved.read_text()
        assert '"weights": [2.0, 4.5]\n' in saved.read_text()
        data = json.loads(rcdeploy("param", "list", "app", "arm", "--format", "json").stdout)
        assert data["arm"][0]["value"] == "30.0"
        for wrong, hint in (
            (("get", "app", "arm", "rat"), "did you mean `rate`?"),
            (("get", "app", "amr", "rate"), "did you mean `arm`?"),
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
        assert "does not answer within 2 s" in stuck.stderr
        app.process.send_signal(signal.SIGINT)
        assert app.end() == 0


def test_up_restarts_killed_component_and_client_reconnects(app_folder: Path) -> None:
    with start_app() as app:
        first = last_number(app.until("eye sees a new arm"))
        os.kill(first, signal.SIGKILL)
        app.until("arm: killed by SIGKILL, restarting in 0.1 s")
        second = last_number(app.until("eye sees a new arm"))
        assert second != first
        rows = status()["components"]
        assert [(row["name"], row["restarts"]) for row in rows] == [("arm", 1), ("eye", 0)]
        stopped = rcdeploy("app.ddsl", "stop")
        assert (stopped.returncode, stopped.stdout) == (0, "app: requested by `rcdeploy stop`\n")
        assert app.end() == 0


def test_killed_rcdeploy_lets_components_finalize(app_folder: Path, socket_folder: Path) -> None:
    with start_app() as app:
        app.until("all 2 components are ready")
        token = f"{status()['domain']}.{app.process.pid}"
        running = reaper.find_processes(token)
        assert len(running) == 3  # with the fork server
        app.process.kill()
        app.end()
        reaper._wait_for_exit(running, 30)
        assert reaper.find_processes(token) == []
    assert sorted(path.name for path in socket_folder.iterdir()) == [".deployments", "token"]
    # Its name is free at once, although it was not released.
    with start_app("--duration", "0") as again:
        assert again.end() == 0


def test_component_joins_named_domain_of_deployment(app_folder: Path) -> None:
    with start_app("--domain", "lab", "--duration", "1000") as app:
        app.until("all 2 components are ready")
        command = [sys.executable, "main.py", "--name", "guest", "--domain", "lab"]
        with RunningProcess(*command, where=app_folder / "eye") as guest:
            guest.until("eye sees a new arm")
            guest.process.terminate()
            assert guest.end() == 0
        app.process.terminate()
        assert app.end() == 0
