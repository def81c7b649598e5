"""Skin goes on through all that happens to a world, and is set up while it runs."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.hardware.devices.skin import SkinFrame, SkinSettings
from robocomp_dsl.hardware.devices.skin_parameters import require_known_taxels, taxel_ids
from robocomp_dsl.hardware.kinematics.transforms import TransformTree
from robocomp_dsl.runtime.parameters import ParameterRejected
from robocomp_dsl.runtime.time.clock_interface import Tick
from robocomp_dsl.runtime.time.clock_source import ClockSource
from robocomp_dsl.runtime.time.simulated_clock import SimulatedClock
from robocomp_dsl.tactile.skin.manager import Compensation
from robocomp_dsl.tactile.skin.sensor import Imperfections
from tests.simulation.served_worlds import Served, served
from tests.simulation.skin.test_skin_servant import table

TWO_PATCHES = """\
        <taxel x="300" z="0" ny="1"/>
      </patch>
      <patch id="coarse" firstid="500" gain="0.1" ty="0 mm" tx="10" rz="180 deg">
        <taxel x="-300" ny="-1"/>
      </patch>"""


class Touched(Served):
    """A table with skin and a cube on it, and what is heard of it."""

    def __init__(self, it: Served) -> None:
        super().__init__(it.simulation, it.ports, it.types)
        object.__setattr__(self, "frames", [])
        object.__setattr__(self, "touches", [])
        frames = SimpleNamespace(frame=self.frames.append, has_subscribers=lambda: True)
        touches = SimpleNamespace(contacts=self.touches.append, has_subscribers=lambda: True)
        it.ports["Skin"].publish(frames, touches)

    frames: list[Any]
    touches: list[Any]

    def go(self, seconds: float) -> Any:
        """Let time pass; the last frame that was heard."""
        self.simulation.advance(seconds)
        self.simulation.dispatch_events()
        return self.frames[-1]

    def set_up(self, **values: Any) -> None:
        with self.simulation.lock:
            self.simulation.set_skin(SkinSettings(**values))


@pytest.fixture
def it(tmp_path: Path) -> Touched:
    return Touched(served(tmp_path, table().replace("      </patch>", TWO_PATCHES, 1)))


def numbers(it: Touched) -> list[int]:
    return [frame.sequence for frame in it.frames]


def test_skin_patches_share_frame_of_first(it: Touched) -> None:
    geometry = it.ports["Skin"].getGeometry()
    assert geometry.id.tolist() == [*range(100, 245), 500]
    assert [patch.gain for patch in geometry.patches] == pytest.approx([0.05, 0.1])
    last = [getattr(geometry, axis)[-1] for axis in ("x", "y", "z", "nx", "ny", "nz")]
    assert last == pytest.approx([0.31, 0, 0, 0, 1, 0], abs=1e-6)


TILTED = """\
<innerModel>
  <transform id="arm" tx="100" ty="200" tz="-50" rx="0.3" ry="-0.8" rz="0.5">
    <joint id="bend" axis="x" min="-1" max="1" tz="40">
      <translation id="inner" ty="10"/>
      <skin id="touch">
        <patch id="ringed" x0="20" x1="100" r0="32" r1="26" rings="33,87" count="4"
               tx="5" ty="-8" tz="12" rx="1.1" ry="0.2" rz="-0.4"/>
        <patch id="lone" firstid="200" rz="90 deg"><taxel x="3" y="4" z="5" ny="1"/></patch>
      </skin>
    </joint>
  </transform>
</innerModel>
"""


def test_skin_taxels_match_transform_tree_of_body(tmp_path: Path) -> None:
    it = served(tmp_path, TILTED)
    geometry = it.ports["Skin"].getGeometry()
    (limb,) = geometry.limbs
    turn = np.array([[getattr(limb, f"r{i}{j}") for j in range(3)] for i in range(3)])
    assert np.linalg.det(turn) == pytest.approx(1.0)
    points = np.column_stack((geometry.x, geometry.y, geometry.z)).astype(float)
    in_frame = (points @ turn.T + [limb.x, limb.y, limb.z]) * 1000
    assert in_frame[-1] == pytest.approx([-4, 3, 5], abs=1e-3)
    tree = TransformTree(it.simulation.state.scene.frames)
    world = np.array([tree.transform(tuple(item), limb.body, "root") for item in in_frame])
    part = it.simulation.state.devices["touch"]
    (mount,) = part.mounts
    assert set(mount.covers) == {"inner"}
    body = it.simulation.world.data.body(mount.body)
    there = (points @ mount.axes.T + mount.origin) @ body.xmat.reshape(3, 3).T + body.xpos
    assert there[:, [0, 2, 1]] * 1000 == pytest.approx(world, abs=1e-3)
    cone = np.column_stack((geometry.nx, geometry.ny, geometry.nz))[:-1]
    away = points[:-1].copy()
    away[:, 0] = 0.0
    assert ((away * cone).sum(axis=1) > 0.02).all()  # normals look out


@pytest.mark.parametrize("kind", ["makes", "follows"])
def test_skin_frames_are_published_with_every_clock_source(it: Touched, kind: str) -> None:
    clock = ClockSource(lambda tick: None) if kind == "makes" else SimulatedClock()
    it.simulation.start(clock)
    pace = it.simulation.step_driver
    for k in range(1, 21):
        if isinstance(clock, ClockSource):
            pace._before_tick(0.01 * k, clock.current_tick.epoch)
        else:
            clock.on_tick(Tick(10_000_000 * k, 0, 1.0, False))
        pace.update()
    assert numbers(it) == list(range(1, 11))


def test_skin_has_no_frame_before_the_first(it: Touched) -> None:
    failed = it.types.HardwareFailedException
    with pytest.raises(failed, match="no frame yet"):
        it.ports["Skin"].getFrame()
    with pytest.raises(failed, match="not compensated"):
        it.ports["Skin"].calibrate(1.0)


def test_skin_frame_numbers_continue_after_reset(it: Touched) -> None:
    it.go(0.1)
    it.ports["Simulation"].reset()
    assert it.go(0.1).time == pytest.approx(0.1)
    assert numbers(it) == list(range(1, 11))
    assert {frame.geometry for frame in it.frames} == {1}


def test_skin_snapshot_restores_frames_and_fork_publishes_none(it: Touched) -> None:
    hand = it.ports["Simulation"]
    it.go(0.51)  # half a frame is under way
    saved = hand.snapshot()
    first = [item.force.tobytes() for item in (it.go(0.3), it.go(0.02))]
    fork = hand.fork()
    hand.advance(fork, 0.5)
    count = len(it.frames)
    hand.restore(saved)
    again = [item.force.tobytes() for item in (it.go(0.3), it.go(0.02))]
    assert again == first
    assert len(it.frames) == count + 16
    assert numbers(it) == list(range(1, len(it.frames) + 1))


def test_skin_geometry_version_increases_only_when_taxels_change(it: Touched) -> None:
    nodes, skin = it.ports["InnerModelManager"], it.ports["Skin"]
    it.go(0.1)
    nodes.addTransform("shelf", "static", "root", it.types.Pose3D())
    assert (it.go(0.1).geometry, skin.getGeometry().version) == (1, 1)
    nodes.removeNode("coarse")
    assert skin.getGeometry().version == 2
    frame = it.go(0.1)
    assert (frame.geometry, len(frame.force)) == (2, 145)
    assert frame.force.sum() == pytest.approx(0.981, rel=0.02)
    nodes.moveNode("touch", "shelf")
    assert [limb.body for limb in skin.getGeometry().limbs] == ["shelf"]
    assert it.go(0.1).geometry == 3
    assert it.frames[-1].force.sum() == 0
    it.ports["Simulation"].reset()
    assert it.go(0.1).geometry == 3
    nodes.removeNode("touch")
    assert (skin.getGeometry().version, len(skin.getGeometry().id)) == (4, 0)
    count = len(it.frames)
    it.go(0.1)
    assert len(it.frames) == count
    with pytest.raises(it.types.HardwareFailedException, match="removed"):
        skin.getFrame()
    assert numbers(it) == list(range(1, count + 1))


def test_skin_restored_older_geometry_is_new_version(it: Touched) -> None:
    hand = it.ports["Simulation"]
    it.go(0.1)
    saved = hand.snapshot()
    it.ports["InnerModelManager"].removeNode("coarse")
    it.go(0.1)
    hand.restore(saved)
    frame = it.go(0.1)
    assert (frame.geometry, len(frame.force)) == (3, 146)


def test_failing_skin_subscriber_does_not_stop_the_others(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    it, heard = served(tmp_path, table()), list[int]()

    def fail(frame: SkinFrame) -> None:
        raise RuntimeError("deaf")

    it.simulation.skin.subscribe(fail)
    it.simulation.skin.subscribe(lambda frame: heard.append(frame.sequence))
    it.simulation.advance(0.05)
    it.simulation.dispatch_events()
    assert heard == [1, 2]
    assert "a subscriber failed on frame 1 of the skin" in caplog.text


def test_skin_patch_stays_in_its_skin(it: Touched) -> None:
    with pytest.raises(it.types.InnerModelManagerError, match="stays in its skin"):
        it.ports["InnerModelManager"].moveNode("coarse", "weight")


# -- set up while it runs ---------------------------------------------------------------------


def test_skin_frames_come_at_their_rate(it: Touched) -> None:
    it.go(0.1)
    it.set_up(rate=200.0)
    it.frames.clear()
    it.go(0.1)
    assert len(it.frames) == 20
    apart = np.diff([frame.time for frame in it.frames])  # whole steps of 2 ms
    assert set(apart.round(4).tolist()) == {0.004, 0.006}


def test_skin_publishes_shear_and_raw_on_request(it: Touched) -> None:
    frame = it.go(0.5)
    assert (len(frame.shearX), len(frame.raw)) == (146, 0)
    it.set_up(shear=False, raw=True)
    frame = it.go(0.02)
    assert [len(item) for item in (frame.shearX, frame.shearY, frame.shearZ)] == [0, 0, 0]
    assert frame.raw.dtype == np.uint8
    counts = np.round(frame.force / 0.05)
    assert frame.raw.tolist() == (240 - counts).astype(int).tolist()
    assert counts.max() > 0


def test_skin_wider_kernel_spreads_same_force(it: Touched) -> None:
    narrow = it.go(0.5)
    it.set_up(sigma=0.010)
    wide = it.go(0.5)
    assert np.count_nonzero(wide.force) > 2 * np.count_nonzero(narrow.force)
    assert wide.force.sum() == pytest.approx(0.981, rel=0.02)


def test_skin_sensor_errors_are_as_configured(it: Touched) -> None:
    full = it.go(0.5).force
    loaded = int(np.argmax(full))
    it.set_up(imperfections=Imperfections(broken=(100 + loaded,)))
    assert it.go(0.02).force[loaded] == 0
    it.set_up(imperfections=Imperfections(threshold=0.05))
    felt = it.go(0.02).force
    assert (felt[full < 0.05] == 0).all()
    assert felt[loaded] == pytest.approx(full[loaded], rel=0.01)
    it.set_up(imperfections=Imperfections(saturation=0.03))
    assert it.go(0.02).force.max() == pytest.approx(0.03)
    it.set_up(imperfections=Imperfections(noise=0.01))
    noisy = np.array([it.go(0.02).force for _ in range(20)])
    assert 0.005 < noisy[:, loaded].std() < 0.02
    with it.simulation.lock:
        it.simulation.noise.set(0.0)
    quiet = np.array([it.go(0.02).force for _ in range(20)])
    assert quiet[:, loaded].std() < 1e-4


def test_skin_compensation_removes_drift_and_initial_load(
    tmp_path: Path,
) -> None:
    it = Touched(served(tmp_path, table(mass=3.0)))
    drifting = Imperfections(drift=0.5)
    it.go(0.5)
    it.set_up(compensation=Compensation(), raw=True, imperfections=drifting)
    assert it.go(4.9).force.sum() == 0  # it calibrates itself for 5 s
    assert it.go(0.5).force.sum() == 0  # the cube was there: it is the baseline
    lift = it.types.Pose3D(0.0, 300.0, 0.0, 0.0, 0.0, 0.0)
    it.ports["InnerModelManager"].setPoseFromParent("weight", lift)
    it.simulation.set_physics(False)
    it.ports["Skin"].calibrate(1.0)
    it.go(1.1)
    it.simulation.set_physics(True)
    assert it.go(0.02).force.sum() == 0
    frame = it.go(1.0)
    assert frame.force.sum() == pytest.approx(29.43, rel=0.3)  # small forces are below its floor
    assert np.count_nonzero(frame.force) >= 16
    with pytest.raises(it.types.HardwareFailedException, match="above 0"):
        it.ports["Skin"].calibrate(-1.0)
    with pytest.raises(it.types.HardwareFailedException, match="finite"):
        it.ports["Skin"].calibrate(float("nan"))


def test_skin_touches_are_published_while_present_and_once_at_end(it: Touched) -> None:
    it.go(1.0)
    lift = it.types.Pose3D(0.0, 100.0, 0.0, 0.0, 0.0, 0.0)
    it.ports["InnerModelManager"].setPoseFromParent("weight", lift)
    it.simulation.set_physics(False)
    it.touches.clear()
    it.go(0.5)
    assert [len(touch.contacts) for touch in it.touches][-1] == 0
    assert [bool(touch.contacts) for touch in it.touches].count(False) == 1


@pytest.mark.parametrize(
    ("words", "ids"),
    [("", ()), (" ", ()), ("3", (3,)), ("10-12, 3,3", (3, 10, 11, 12)), ("7 - 7", (7,))],
)
def test_taxel_list_is_parsed(words: str, ids: tuple[int, ...]) -> None:
    assert taxel_ids(words) == ids


@pytest.mark.parametrize("words", ["x", "3,", "-3", "5-3", "1-2-3", "0-999999999", "1.5", "3;4"])
def test_taxel_list_with_errors_is_refused(words: str) -> None:
    with pytest.raises(ParameterRejected, match="is no"):
        taxel_ids(words)


def test_skin_refuses_unknown_dead_taxels(it: Touched) -> None:
    geometry = it.simulation.skin.geometry
    require_known_taxels("100-110, 500", geometry)
    with pytest.raises(ParameterRejected, match=r"no taxel 7, 99$"):
        require_known_taxels("7, 99-101", geometry)
