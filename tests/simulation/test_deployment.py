"""A simulator and a patrol component in a deployment, with every kind of clock."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.patrol_deployment import CDSL, DDSL, PDSL, SECONDS, WORKER, WORLD
from tests.simulation.served_worlds import CLIENT, rcgen, run
from tests.support.waiting import wait_until

DEADLINE = 120.0

RCDEPLOY = Path(sys.executable).with_name("rcdeploy")


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with both components, as the commands make them."""
    home_folder = tmp_path_factory.mktemp("home")
    (home_folder / "room.xml").write_text(WORLD)
    (home_folder / "patrol").mkdir()
    (home_folder / "patrol" / "patrol.cdsl").write_text(CDSL)
    (home_folder / "patrol" / "patrol.pdsl").write_text(PDSL)
    for command in (("simulator", "room.xml"), ("component", "patrol/patrol.cdsl")):
        done = rcgen(*command, cwd=home_folder)
        assert (done.returncode, done.stderr) == (0, "")
    (home_folder / "patrol" / "specificworker.py").write_text(WORKER)
    return home_folder


def wait_for(condition: Callable[[], bool], process: subprocess.Popen[str], message: str) -> None:
    """Wait for the condition while rcdeploy runs."""

    def holds() -> bool:
        if process.poll() is not None:
            pytest.fail(f"rcdeploy ended early:\n{process.communicate()[0]}")
        return condition()

    wait_until(holds, message, DEADLINE)


@contextmanager
def deployed(
    home: Path, name: str, clock: str, settings: str = "", last: float = SECONDS, more: str = ""
) -> Iterator[tuple[subprocess.Popen[str], Path]]:
    """The running deployment, and the file that the patrol writes; ends in order."""
    written = home / f"{name}.txt"
    ddsl = home / f"{name}.ddsl"
    ddsl.write_text(DDSL.format(clock=clock, settings=settings, file=written, last=last, more=more))
    command = [str(RCDEPLOY), str(ddsl), "up", "--name", name, "--domain", name, "--no-table"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        yield process, written
        process.send_signal(signal.SIGINT)
        message, _ = process.communicate(timeout=DEADLINE)
        assert process.returncode == 0, message
        assert "failed" not in message
    finally:
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
            try:
                process.communicate(timeout=DEADLINE)
            finally:
                process.kill()


def times(written: Path) -> list[float]:
    """The moments that are written down so far."""
    if not written.exists():
        return []
    whole = written.read_text().rpartition("\n")[0]
    return [float(line.partition(";")[0]) for line in whole.splitlines()]


def status(name: str) -> str:
    command = [str(RCDEPLOY), "status", name]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout


def recorded(home: Path, name: str, seed: int, last: float = SECONDS, more: str = "") -> bytes:
    """What the patrol saw in lock-step."""
    settings = f"set speed = 0; set seed = {seed};"
    clock = "clock sim lockstep;"
    with deployed(home, name, clock, settings, last, more) as (process, written):
        wait_for(lambda: (times(written) or [0])[-1] >= last, process, f"{last:g} s")
    return written.read_bytes()


def test_simulator_in_lockstep_is_determined_by_seed(home: Path) -> None:
    first, again, other = (
        recorded(home, f"step-{os.getpid()}-{number}", seed)
        for number, seed in enumerate((7, 7, 8))
    )
    assert first == again
    assert first != other
    lines = first.decode().splitlines()
    moments = [float(line.split(";")[0]) for line in lines]
    assert moments == [round(n * 0.02, 9) for n in range(len(moments))]
    near = np.array([float(line.split(";")[1]) for line in lines])
    assert near[0] > 1900
    assert near.min() < 950, "it has not come to the wall"
    assert len({line.split(";", 2)[2] for line in lines}) == len(lines)


def test_simulator_in_lockstep_accepts_changes_of_world_and_time(home: Path) -> None:
    first, again = (
        recorded(home, f"meddle-{os.getpid()}-{number}", 3, 3.0, "set meddle = true;")
        for number in range(2)
    )
    assert first == again
    rows = [line.split(";", 2) for line in first.decode().splitlines()]
    moments = np.array([float(row[0]) for row in rows])
    assert moments[1:][np.diff(moments) < 0].tolist() == [1.0, 0.0], "restored, then reset"
    near = [{float(r[0]): float(r[1]) for r in rows[a:b]} for a, b in time_segments(moments)]
    before, restored, anew = (
        [found[t] for t in (1.02, 1.2, 1.5, 1.98)] if 1.98 in found else [] for found in near
    )
    assert len(before) == len(restored) == len(anew) == 4
    assert before != restored, "the wall is gone again"


def time_segments(moments: np.ndarray) -> list[tuple[int, int]]:
    """From where to where time goes on."""
    breaks = (np.flatnonzero(np.diff(moments) < 0) + 1).tolist()
    return list(zip([0, *breaks], [*breaks, len(moments)], strict=True))


HAND = """
hand = proxy(i.SIMULATION, "Simulation")
wait_until(lambda: hand.getState().time > 1)
hand.pause()
now = hand.getState().time
assert abs(hand.step(50) - now - 0.1) < 1e-9
state = hand.getState()
assert state.paused and state.realTimeFactor == 0
snapshot = hand.snapshot()
hand.setSpeed(2.0)
hand.resume()
wait_until(lambda: hand.getState().realTimeFactor > 0 and hand.getState().time > state.time + 1)
hand.pause()
hand.restore(snapshot)
assert abs(hand.getState().time - state.time) < 1e-9
hand.resume()
wait_until(lambda: hand.getState().time > state.time + 0.5)
hand.pause()
hand.reset()
assert hand.getState().time == 0
hand.resume()
middleware.close()
print("held")
"""


@pytest.mark.parametrize("clock", ["clock sim;", "clock sim lockstep;"])
def test_simulator_leads_clock_with_simulated_time(home: Path, clock: str) -> None:
    name = f"sim-{len(clock)}-{os.getpid()}"
    with deployed(home, name, clock, last=1000) as (process, written):
        wait_for(lambda: bool(times(written)), process, "the first line")
        wait_for(lambda: "times real time" in status(name), process, "the factor")
        wait_for(lambda: " 0.00 times" not in status(name), process, "a factor")
        message = run(home / "room_simulator", CLIENT + HAND, "zenoh", name, "room_simulator")
        assert message == "held\n"
        backwards = lambda: sum(np.diff(times(written)) < 0) >= 2  # noqa: E731
        wait_for(backwards, process, "time that begins anew twice")
    moments = np.array(times(written))
    assert moments * 200 == pytest.approx(np.round(moments * 200)), "moments of the source"
    first, second = moments[1:][np.diff(moments) < 0][:2]
    assert first > 1.0, "a snapshot is gone back to"
    assert second < first, "a reset is a new beginning"


def test_simulator_is_driven_on_wall_clock(home: Path) -> None:
    name = f"wall-{os.getpid()}"
    with deployed(home, name, "") as (process, written):
        wait_for(lambda: len(times(written)) > 1, process, "the first lines")
        done = lambda: times(written)[-1] - times(written)[0] >= SECONDS  # noqa: E731
        wait_for(done, process, f"{SECONDS:g} s")
        assert "simulated time" not in status(name)
    near = [float(line.split(";")[1]) for line in written.read_text().splitlines()]
    assert min(near) < 1400 < max(near), "it drives towards the wall"
