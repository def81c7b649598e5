"""The demo: deploys `wander.ddsl`, lets the robot drive, prints a summary and draws its path.

`python demo.py [--seconds 30] [--picture demo.png]`. Exit code 0 when all three components exited
normally and the simulation kept up with the clock.
"""

from __future__ import annotations

import argparse
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from shutil import which

try:
    import yaml
    from observer import Observer
    from picture import draw
    from summary import Look, length, lines, obstacle, read_drive, speed

    from robocomp_dsl.runtime.component.component_interface import LifeState
    from robocomp_dsl.runtime.errors import MiddlewareError
    from robocomp_dsl.simulation.scene.floor_plan import outlines
    from robocomp_dsl.simulation.scene.room import Room
    from robocomp_dsl.simulation.world.world import World
except ModuleNotFoundError as error:
    python = Path(which("rcgen") or "rcgen").resolve().with_name("python3")
    other = python.is_file() and python.parent != Path(sys.executable).parent
    place = f", {python}" if other else ""
    sys.exit(
        f"demo.py cannot run with {sys.executable}, which lacks the module `{error.name}`.\n"
        f"Install the package: {sys.executable} -m pip install 'robocomp_dsl[all]'\n"
        f"or use the Python of the environment that has rcgen{place}."
    )

HERE = Path(__file__).parent
BASE = HERE.parent / "mobile_base"
PATH = HERE.parents[1] / "build" / "wander" / "path.csv"
COMPONENTS = ("mobile_base", "wander", "path_logger")
START_S = 60.0
"""Time limit until the path logger receives data of the robot."""
SLOWEST = 0.98
"""Real-time factor below which the simulation did not keep up."""


class DemoFailed(Exception):
    """The demo cannot continue; the message gives the reason."""


def main() -> int:
    """Run the demo."""
    parser = argparse.ArgumentParser(description="A simulated robot wanders through a room.")
    parser.add_argument("--seconds", type=float, default=30.0, help="of simulated time (30)")
    parser.add_argument("--picture", type=Path, default=Path("demo.png"), help="(demo.png)")
    options = parser.parse_args()
    name = f"demo-{os.getpid()}"
    try:
        with deployed(name) as process:
            first, last = watched(name, options.seconds, process)
        report(first, last, options.picture)
    except DemoFailed as error:
        print(f"demo: {error}", file=sys.stderr)
        return 1
    kept_up = speed(first, last) >= SLOWEST
    if not kept_up:
        print("demo: the simulation did not keep up with the clock", file=sys.stderr)
    return 0 if kept_up else 1


@contextmanager
def deployed(name: str) -> Iterator[subprocess.Popen[bytes]]:
    """The running deployment; at the end it waits until all have exited."""
    program = Path(sys.executable).with_name("rcdeploy")
    command = [program, HERE / "wander.ddsl", "up", "--name", name, "--domain", name, "--no-table"]
    process = subprocess.Popen(list(map(str, command)))  # noqa: S603 - our own words
    try:
        yield process
    finally:
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
        code = process.wait()
    if code:
        raise DemoFailed(f"rcdeploy ended with exit code {code}")


def watched(domain: str, seconds: float, process: subprocess.Popen[bytes]) -> tuple[Look, Look]:
    """Statistics when all components run, and after `seconds` of simulated time."""
    observer = Observer(domain)
    try:
        until(observer, 0.0, START_S, process)
        first = look(observer)
        left = max(seconds - first.simulated, 0.0)
        until(observer, seconds, 3 * left + START_S, process)
        return first, look(observer)
    except MiddlewareError as error:
        raise DemoFailed(f"a component does not answer: {error}") from None
    finally:
        observer.close()


def until(
    observer: Observer, seconds: float, patience: float, process: subprocess.Popen[bytes]
) -> None:
    """Wait until all components run and the path logger has seen this much simulated time."""
    heard, running = observer.path(), [observer.component(name) for name in COMPONENTS]
    deadline = time.monotonic() + patience
    while time.monotonic() < deadline:
        if process.poll() is not None:
            raise DemoFailed(f"rcdeploy ended early, with exit code {process.returncode}")
        try:
            states = {component.getInfo().state for component in running}
            if states == {LifeState.Compute} and heard().time >= seconds:
                return
        except MiddlewareError:
            pass  # not available yet
        time.sleep(0.05)
    raise DemoFailed(f"{seconds:g} s of simulated time did not pass within {patience:.0f} s")


def look(observer: Observer) -> Look:
    """The current statistics."""
    wall, simulated = time.monotonic(), float(observer.path()().time)
    found = {name: observer.component(name).getStatistics() for name in COMPONENTS}
    return Look(wall, simulated, found)


def report(first: Look, last: Look, picture: Path) -> None:
    """Print the summary and draw the picture."""
    config = yaml.safe_load((BASE / "etc" / "config.yaml").read_text(encoding="utf-8"))
    room = Room.read(BASE / config["room"])
    plan = outlines(World(room.spec()).model)
    drive = read_drive(PATH, plan, room.start, config["base"]["radius"])
    print()
    for line in lines(first, last, drive, plan):
        print(line)
    subtitle = (
        f"{length(drive) / 1000:.1f} m driven · nearest obstacle {drive.clearance:.0f} mm "
        f"({obstacle(drive, plan)}) · {speed(first, last):.2f} times real time"
    )
    draw(plan, drive, f"Wandering for {drive.time[-1]:.0f} s", subtitle, picture)
    print(f"{'picture':<44}{picture.resolve()}")


if __name__ == "__main__":
    raise SystemExit(main())
