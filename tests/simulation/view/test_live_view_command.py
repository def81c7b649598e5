"""The command `rcgen view --live`, and its page in a real browser."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("viser", reason="needs the extra `view`")

from tests.simulation.served_worlds import CLIENT, rcgen, run
from tests.simulation.view.live_world import WORLD
from tests.support.chromium_tab import URL_LINE, needs_chromium, opened_tab, red
from tests.support.waiting import TIMEOUT_S, wait_until


@contextmanager
def command(*arguments: str, cwd: Path) -> Iterator[subprocess.Popen[str]]:
    """A program that is ended with Ctrl-C, whatever happens."""
    process = subprocess.Popen(
        arguments, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    try:
        yield process
    finally:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(TIMEOUT_S)
        finally:
            process.kill()


VIEW = [
    sys.executable,
    "-c",
    "from robocomp_dsl.cli.rcgen.main import main; main()",
    "view",
    "--live",
]


@pytest.fixture(scope="module")
def simulator(tmp_path_factory: pytest.TempPathFactory) -> Path:
    home = tmp_path_factory.mktemp("live")
    (home / "room.xml").write_text(WORLD)
    done = rcgen("simulator", "room.xml", cwd=home)
    assert done.returncode == 0, done.stderr
    return home / "room_simulator"


def middle(picture: np.ndarray) -> float:
    """Where the red of a picture is, from left to right."""
    seen = (picture[:, :, 0] > 0.6) & (picture[:, :, 1:].max(axis=2) < 0.35)
    return float(np.flatnonzero(seen.any(axis=0)).mean())


@needs_chromium
def test_live_view_shows_driving_robot_in_browser(simulator: Path) -> None:
    domain = f"live-{os.getpid()}"
    main = [sys.executable, "main.py", "--domain", domain]
    with command(*main, cwd=simulator), opened_tab() as tab:
        options = ["room_simulator", "--domain", domain, "--port", "0"]
        with command(*VIEW, *options, cwd=simulator) as view:
            assert view.stdout
            received = re.match(URL_LINE, view.stdout.readline())
            assert received
            tab("Page.enable")
            screen = {"width": 600, "height": 400, "deviceScaleFactor": 1, "mobile": False}
            tab("Emulation.setDeviceMetricsOverride", **screen)
            tab("Page.navigate", url=received[1])
            wait_until(lambda: tab.shows("Let time run", "simulated time"))
            wait_until(lambda: red(tab.picture()) > 0.003)
            before = middle(tab.picture())
            run(simulator, CLIENT + DRIVE, "zenoh", domain, "room_simulator")
            wait_until(lambda: abs(middle(tab.picture()) - before) > 30)
            told_time = lambda: re.search(  # noqa: E731
                r"simulated time ([\d.]+) s", str(tab.value("document.body.innerText"))
            )
            first = told_time()
            assert first
            wait_until(lambda: (now := told_time()) and float(now[1]) > float(first[1]) + 1)


DRIVE = """
proxy(i.DIFFERENTIALROBOT, "robot").setSpeedBase(800.0, 0.0)
middleware.close()
"""


def test_live_view_finds_only_simulation_and_reports_missing_one(simulator: Path) -> None:
    domain = f"alone-{os.getpid()}"
    picture = simulator.parent / "live.png"
    ask = [*VIEW, "--domain", domain, "--screenshot", str(picture), "--size", "320x240"]
    none = subprocess.run([*ask, "nobody"], capture_output=True, text=True, check=False)
    assert none.returncode == 1
    assert "nobody" in none.stderr
    assert domain in none.stderr
    assert "Traceback" not in none.stderr
    main = [sys.executable, "main.py", "--domain", domain, "--name"]
    with command(*main, "one", cwd=simulator):
        done = asked(ask, 0)
        assert done.returncode == 0, done.stderr
        assert picture.stat().st_size > 1000
        with command(*main, "other", cwd=simulator):
            done = asked(ask, 1)
            assert "one and other are running: select one, for example `--live one`" in done.stderr
            assert asked([*ask, "other"], 0).returncode == 0


def asked(ask: list[str], code: int) -> subprocess.CompletedProcess[str]:
    """Run the command again until its exit code is `code`: simulators take a while to start."""

    def attempt() -> subprocess.CompletedProcess[str] | None:
        done = subprocess.run(ask, capture_output=True, text=True, check=False)
        return done if done.returncode == code else None

    return wait_until(attempt, f"the command has not ended with {code}")
