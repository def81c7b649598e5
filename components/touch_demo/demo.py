"""The demo: a finger touches the left arm of NAO, then of the iCub; one reflex withdraws both.

`python demo.py [--robot nao] [--touches 5] [--picture demo.png] [--live]`. Exit code 0 when every
touched arm has withdrawn and all components exited normally. Recordings are written to
`build/touch_demo/`.
"""

from __future__ import annotations

import argparse
import os
import signal
import sys
import time
from contextlib import closing
from pathlib import Path
from shutil import which

try:
    from body import Body
    from deployed import deployed
    from failure import DemoFailed
    from live import Live
    from metrics import words
    from path_planner import NoPath
    from pressing import park, press
    from recording import Place, Press, Recording, save
    from report import report
    from robot_under_test import RobotUnderTest
    from subject import PART, SUBJECTS, Subject
except ModuleNotFoundError as error:
    python = Path(which("rcgen") or "rcgen").resolve().with_name("python3")
    other = python.is_file() and python.parent != Path(sys.executable).parent
    place = f", {python}" if other else ""
    sys.exit(
        f"demo.py cannot run with {sys.executable}, which lacks the module `{error.name}`.\n"
        f"Install the package: {sys.executable} -m pip install 'robocomp_dsl[all]'\n"
        f"or use the Python of the environment that has rcgen{place}."
    )

LIVE_FRAMES = 500
ATTEMPTS = 3


def main() -> int:
    """Run the demo."""
    # Also when a script runs it in the background, which ignores SIGINT.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    options = _arguments()
    subjects = [SUBJECTS[options.robot]] if options.robot else list(SUBJECTS.values())
    try:
        if options.live:
            watch_live(subjects[0], options.port)
            return 0
        began = time.monotonic()
        recordings = [touched(subject, options.touches) for subject in subjects]
        troubles = report(subjects, recordings, options.picture)
        print(f"{time.monotonic() - began:.0f} s in all")
    except (DemoFailed, NoPath) as error:
        print(f"demo: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    for trouble in troubles:
        print(f"demo: {trouble}", file=sys.stderr)
    return 1 if troubles else 0


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description="A finger touches an arm with a skin, and the arm withdraws: on two robots."
    )
    parser.add_argument("--robot", choices=SUBJECTS, help="this one alone")
    parser.add_argument("--touches", type=int, default=5, help="places to touch on each (5)")
    parser.add_argument("--picture", type=Path, default=Path("demo.png"), help="(demo.png)")
    parser.add_argument(
        "--live", action="store_true", help="one robot in the browser, touched until Ctrl-C"
    )
    parser.add_argument("--port", type=int, default=0, help="of the page; 0: any that is free")
    options = parser.parse_args()
    if options.touches < 1:
        parser.error("--touches: one at least")
    if not options.picture.absolute().parent.is_dir():
        parser.error(f"--picture: there is no folder {options.picture.absolute().parent}")
    return options


def touched(subject: Subject, touches: int) -> Recording:
    """Touch one robot at several places, from the start of its deployment to its end."""
    print(f"{subject.name}: starting simulator, arm and reflex ...", flush=True)
    with (
        deployed(subject.ddsl, _name(subject), subject.recording_path.with_suffix(".log")) as alive,
        closing(RobotUnderTest(_name(subject), PART, alive, None)) as stage,
    ):
        rest, places = stage.joints(), stage.places()
        body = Body(subject.world, stage.skin, subject.part)
        body.pose(rest)
        home, presses = body.finger_point, list[Press]()
        for place in [place for place in places if body.is_accessible(place)][:touches]:
            print(f"{subject.name}: touching the {words(place.name)}", flush=True)
            presses.append(pressed(subject.name, stage, body, place))
        park(stage, body, home)
        recording = stage.buffer.recording(subject.name, presses, places=places, rest=rest)
    save(recording, subject.recording_path.with_suffix(".npz"))
    return recording


def pressed(name: str, stage: RobotUnderTest, body: Body, place: Place) -> Press:
    """One touch; repeated if the reflex was frozen meanwhile, as on an overloaded machine."""
    for _ in range(ATTEMPTS - 1):
        touch = press(stage, body, place)
        if not stage.buffer.frozen_since(touch.began):
            return touch
        print(f"{name}: the reflex was frozen meanwhile, data came too late; again", flush=True)
    return press(stage, body, place)


def watch_live(subject: Subject, port: int) -> None:
    """Show one robot in the browser, touched repeatedly until Ctrl-C."""
    with (
        deployed(subject.ddsl, _name(subject), subject.recording_path.with_suffix(".log")) as alive,
        closing(RobotUnderTest(_name(subject), PART, alive, LIVE_FRAMES)) as stage,
    ):
        rest, places = stage.joints(), stage.places()
        body = Body(subject.world, stage.skin, subject.part)
        body.pose(rest)
        page = Live(subject.name, stage.simulation(), stage.skin, stage.buffer, port)
        with closing(page) as live:
            message = f"{live.url} shows {subject.name} and what its skin feels; Ctrl-C ends it"
            print(message, flush=True)
            while True:
                for place in filter(body.is_accessible, places):
                    press(stage, body, place)


def _name(subject: Subject) -> str:
    return f"touch-{subject.ddsl.stem}-{os.getpid()}"


if __name__ == "__main__":
    raise SystemExit(main())
