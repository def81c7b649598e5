"""`InnerModel` used by several threads: a change is one step for all of them."""

from __future__ import annotations

import random
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from types import FrameType

import numpy as np
import pytest

from robocomp_dsl.innermodel import InnerModel, InnerModelError
from tests.innermodel.random_trees import pose_matrix

CHAIN = """\
<innerModel>
  <transform id="a"><transform id="b" ty="100"><transform id="c" tz="50"><laser id="laser"/>
  </transform></transform></transform>
</innerModel>
"""
FIRST = (100.0, 200.0, 300.0, 0.1, 0.2, 0.3)
SECOND = (-500.0, 600.0, -700.0, 1.4, -1.5, 1.6)
POINT = (10.0, 20.0, 30.0)
WRITES = 300


@pytest.fixture(autouse=True)
def _switches_in_every_method() -> Iterator[None]:
    """New threads give way to others at random lines of the code under test."""
    rng = random.Random(1)

    def trace(frame: FrameType, event: str, _: object) -> object:
        if "robocomp_dsl" not in frame.f_code.co_filename:
            return None
        if event == "line" and rng.random() < 0.02:
            time.sleep(1e-5)
        return trace

    threading.settrace(trace)
    yield
    threading.settrace(None)  # type: ignore[arg-type]


def expected_point(pose: tuple[float, ...]) -> list[float]:
    """`POINT` of the laser in the root, if `a` has this pose."""
    rest = pose_matrix(0, 100, 50, 0, 0, 0)
    return (pose_matrix(*pose) @ rest @ (*POINT, 1.0))[:3].tolist()


def while_changing(change: Callable[[], None], *reads: Callable[[], None]) -> None:
    """Run `change` many times in one thread and every read in another; raise their errors."""
    errors: list[BaseException] = []
    done = threading.Event()

    def run(step: Callable[[], None], repeat: Callable[[int], bool]) -> None:
        count = 0
        try:
            while repeat(count):
                step()
                count += 1
        except BaseException as error:
            errors.append(error)

    readers = [
        threading.Thread(target=run, args=(read, lambda _: not done.is_set())) for read in reads
    ]
    writer = threading.Thread(target=run, args=(change, lambda n: n < WRITES and not errors))
    for thread in (*readers, writer):
        thread.start()
    writer.join()
    done.set()
    for thread in readers:
        thread.join()
    if errors:
        raise errors[0]


def test_innermodel_reader_never_sees_half_a_transform() -> None:
    model = InnerModel.fromString(CHAIN)
    model.updateTransformValues("a", *FIRST)
    points = [expected_point(FIRST), expected_point(SECOND)]
    poses = iter(FIRST if n % 2 else SECOND for n in range(WRITES))
    seen = [0, 0]

    def read_point() -> None:
        point = model.transform("root", POINT, "laser")
        near = [np.abs(point - known).max() < 1e-6 for known in points]
        assert any(near), point
        seen[near.index(True)] += 1

    def read_node() -> None:
        node = model.getTransform("a")
        assert (node.tx, node.ty, node.tz, node.rx, node.ry, node.rz) in (FIRST, SECOND)

    def read_text() -> None:
        saved = InnerModel.fromString(model.toString()).transform("root", POINT, "laser")
        assert any(np.abs(saved - known).max() < 1e-6 for known in points)

    def change() -> None:
        pose = next(poses)
        model.updateTransformValues("a", *pose)
        point = model.transform("root", POINT, "laser")  # not what a reader has cached before
        assert point == pytest.approx(expected_point(pose), abs=1e-6)

    while_changing(change, read_point, read_point, read_node, read_text)
    assert sum(seen) > 10


def test_innermodel_lock_makes_several_calls_one_step() -> None:
    model = InnerModel.fromString(CHAIN)
    shifts = iter(range(WRITES))

    def change() -> None:
        shift = next(shifts)
        with model.lock:
            model.updateTranslationValues("a", shift, 0, 0)
            model.updateTranslationValues("c", -shift, 0, 50)

    def read() -> None:
        assert model.transform("root", "laser") == pytest.approx([0, 100, 50])
        with model.lock:
            shift = model.getTransform("a").tx
            assert model.getTransform("c").tx == -shift

    while_changing(change, read, read)


def test_innermodel_nodes_come_and_go_beside_readers() -> None:
    model = InnerModel.fromString(CHAIN)
    steps = iter(range(WRITES))

    def change() -> None:
        if next(steps) % 2:
            model.removeNode("new")
        else:
            model.newTransform("new", "static", "b", tx=5)

    def read() -> None:
        with suppress(InnerModelError):
            assert model.transform("b", "new") == pytest.approx([5, 0, 0])
        keys = model.getIDKeys()
        assert len(keys) in {5, 6}
        assert len(model.copy()) in {5, 6}

    while_changing(change, read, read)


def test_innermodel_is_imported_without_simulation_and_toolchain() -> None:
    names = ("mujoco", "lark", "jinja2", "yaml", "click", "zenoh", "robocomp_dsl.simulation")
    program = (
        "import sys; from robocomp_dsl.innermodel import InnerModel\n"
        f"InnerModel.fromString({CHAIN!r}).transform('a', (0, 0, 0), 'laser')\n"
        f"print([name for name in {names} if name in sys.modules])"
    )
    run = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        check=True,
        cwd=Path(__file__).parents[2],
    )
    assert run.stdout == "[]\n"
