"""`rcdeploy` as an operator uses it: single components, a full disk, logs of earlier runs."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

from robocomp_dsl.deploy.supervisor import reaper
from tests.deploy.laser_app import APP, last_number, start_app, status
from tests.deploy.rcdeploy_process import PROGRAM, RunningProcess, rcdeploy, start_rcdeploy
from tests.support.waiting import wait_until


def test_rcdeploy_stops_and_starts_components_by_name_and_by_hand(app_folder: Path) -> None:
    with start_app() as app:
        first = last_number(app.until("eye sees a new arm"))
        worker = app_folder / "arm" / "specificworker.py"
        worker.write_text(worker.read_text().replace("arm begins", "new arm begins"))
        (app_folder / "app.ddsl").write_text(APP.replace("rate = 20", "rate = 30"))
        done = rcdeploy("app.ddsl", "restart", "arm")
        assert (done.returncode, done.stderr) == (0, "")
        second = status()["components"][0]["pid"]
        assert done.stdout == f"arm: stopped\narm: ready (pid {second})\n"
        app.until("new arm begins with abc 30.0 fast")
        assert last_number(app.until("eye sees a new arm")) == second != first

        stopped = rcdeploy("stop", "arm")
        assert stopped.stdout == "arm: stopped\nstill running without it: eye\n"
        (shown,) = json.loads(rcdeploy("status", "--format", "json").stdout)
        assert [c["state"] for c in shown["components"]] == ["exited", "ready"]
        lines = rcdeploy("plan", "app.ddsl").stdout.splitlines()
        (line,) = [line for line in lines if "--name arm" in line]
        with RunningProcess("sh", "-c", line, where=Path("/")) as by_hand:
            by_hand.until("new arm begins with abc 30.0 fast")
            third = last_number(app.until("eye sees a new arm"))
            assert third not in (first, second)
            os.kill(third, signal.SIGTERM)
            assert by_hand.end() == 0

        (app_folder / "app.ddsl").write_text(APP.replace("rate = 20", "raet = 20"))
        refused = rcdeploy("start", "app", "arm")
        assert refused.returncode == 1
        assert "app.ddsl has errors; nothing was changed" in refused.stdout
        (app_folder / "app.ddsl").write_text(APP)
        assert rcdeploy("start").returncode == 0
        app.until("new arm begins with abc 20.0 fast")
        app.process.terminate()
        assert app.end() == 0


def test_up_runs_on_full_disk_and_ends_with_its_reader(app_folder: Path) -> None:
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


def test_logs_command_shows_runs_after_end_and_crash(app_folder: Path) -> None:
    with start_app() as app:
        app.until("eye sees a new arm")
        with start_rcdeploy("logs", "-f", "--json") as follower:
            follower.until("eye sees a new arm")
            app.process.terminate()
            assert app.end() == 0
            assert follower.end() == 0
    followed = [json.loads(line) for line in follower.lines]
    assert [r["sequence"] for r in followed] == list(range(1, len(followed) + 1))
    assert [r["text"] for r in followed[-2:]] == ["eye finalizes", "arm finalizes"]
    with start_app() as app:
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
