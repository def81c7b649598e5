"""The demo: a finger touches the left arm of NAO, then of the iCub; one reflex withdraws both.

`python demo.py [--robot nao] [--touches 5] [--picture demo.png] [--live]`. Exit code 0 when every
touched arm has withdrawn and all components ran to the end. What was recorded is kept in
`build/touch_demo/`.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from contextlib import closing
from pathlib import Path

from body import Body
from deployed import deployed
from failure import DemoFailed
from live import Live
from outcome import words
from pressing import park, press
from recording import Place, Press, Recording, save
from report import report
from subject import PART, SUBJECTS, Subject
from watching import Watching
from way import NoWay

LIVE_FRAMES = 500
ATTEMPTS = 3


def main() -> int:
    """Run it."""
    given = _arguments()
    subjects = [SUBJECTS[given.robot]] if given.robot else list(SUBJECTS.values())
    try:
        if given.live:
            watch_live(subjects[0], given.port)
            return 0
        began = time.monotonic()
        recordings = [touched(one, given.touches) for one in subjects]
        troubles = report(subjects, recordings, given.picture)
        print(f"{time.monotonic() - began:.0f} s in all")
    except (DemoFailed, NoWay) as error:
        print(f"demo: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    for one in troubles:
        print(f"demo: {one}", file=sys.stderr)
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
    given = parser.parse_args()
    if given.touches < 1:
        parser.error("--touches: one at least")
    if not given.picture.absolute().parent.is_dir():
        parser.error(f"--picture: there is no folder {given.picture.absolute().parent}")
    return given


def touched(subject: Subject, touches: int) -> Recording:
    """One robot touched at so many places, from the start of its deployment to its end."""
    print(f"{subject.name}: starting simulator, arm and reflex ...", flush=True)
    with (
        deployed(subject.ddsl, _name(subject), subject.kept.with_suffix(".log")) as alive,
        closing(Watching(_name(subject), PART, alive, None)) as stage,
    ):
        rest, places = stage.joints(), stage.places()
        body = Body(subject.world, stage.skin, subject.part)
        body.pose(rest)
        home, presses = body.finger_point, list[Press]()
        for place in places[:touches]:
            print(f"{subject.name}: touching the {words(place.name)}", flush=True)
            presses.append(pressed(subject.name, stage, body, place))
        park(stage, body, home)
        made = stage.heard.recording(subject.name, presses, places=places, rest=rest)
    save(made, subject.kept.with_suffix(".npz"))
    return made


def pressed(name: str, stage: Watching, body: Body, place: Place) -> Press:
    """One touch; again when the reflex was frozen meanwhile, as on a machine that is too busy."""
    for _ in range(ATTEMPTS - 1):
        made = press(stage, body, place)
        if not stage.heard.frozen_since(made.began):
            return made
        print(f"{name}: the reflex was frozen meanwhile, data came too late; again", flush=True)
    return press(stage, body, place)


def watch_live(subject: Subject, port: int) -> None:
    """One robot in the browser, touched again and again until Ctrl-C."""
    with (
        deployed(subject.ddsl, _name(subject), subject.kept.with_suffix(".log")) as alive,
        closing(Watching(_name(subject), PART, alive, LIVE_FRAMES)) as stage,
    ):
        rest, places = stage.joints(), stage.places()
        body = Body(subject.world, stage.skin, subject.part)
        body.pose(rest)
        page = Live(subject.name, stage.simulation(), stage.skin, stage.heard, port)
        with closing(page) as live:
            said = f"{live.url} shows {subject.name} and what its skin feels; Ctrl-C ends it"
            print(said, flush=True)
            while True:
                for place in places:
                    press(stage, body, place)


def _name(subject: Subject) -> str:
    return f"touch-{subject.ddsl.stem}-{os.getpid()}"


if __name__ == "__main__":
    raise SystemExit(main())
