"""The skin of a simulation: geometry, versions, reset, snapshot and subscribers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.hardware.devices.skin import SkinFrame
from robocomp_dsl.hardware.kinematics.transforms import TransformTree
from robocomp_dsl.runtime.time.clock_interface import Tick
from robocomp_dsl.runtime.time.clock_source import ClockSource
from robocomp_dsl.runtime.time.simulated_clock import SimulatedClock
from tests.simulation.served_worlds import served
from tests.simulation.skin.skin_world import SkinWorld, table


def numbers(skin_world: SkinWorld) -> list[int]:
    return [frame.sequence for frame in skin_world.frames]


def test_skin_patches_share_frame_of_first(skin_world: SkinWorld) -> None:
    geometry = skin_world.ports["Skin"].getGeometry()
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
    skin_world = served(tmp_path, TILTED)
    geometry = skin_world.ports["Skin"].getGeometry()
    (limb,) = geometry.limbs
    turn = np.array([[getattr(limb, f"r{i}{j}") for j in range(3)] for i in range(3)])
    assert np.linalg.det(turn) == pytest.approx(1.0)
    points = np.column_stack((geometry.x, geometry.y, geometry.z)).astype(float)
    in_frame = (points @ turn.T + [limb.x, limb.y, limb.z]) * 1000
    assert in_frame[-1] == pytest.approx([-4, 3, 5], abs=1e-3)
    tree = TransformTree(skin_world.simulation.state.scene.frames)
    world = np.array([tree.transform(tuple(point), limb.body, "root") for point in in_frame])
    part = skin_world.simulation.state.devices["touch"]
    (mount,) = part.mounts
    assert set(mount.covers) == {"inner"}
    body = skin_world.simulation.world.data.body(mount.body)
    there = (points @ mount.axes.T + mount.origin) @ body.xmat.reshape(3, 3).T + body.xpos
    assert there[:, [0, 2, 1]] * 1000 == pytest.approx(world, abs=1e-3)
    cone = np.column_stack((geometry.nx, geometry.ny, geometry.nz))[:-1]
    away = points[:-1].copy()
    away[:, 0] = 0.0
    assert ((away * cone).sum(axis=1) > 0.02).all()  # normals look out


@pytest.mark.parametrize("kind", ["makes", "follows"])
def test_skin_frames_are_published_with_every_clock_source(
    skin_world: SkinWorld, kind: str
) -> None:
    clock = ClockSource(lambda tick: None) if kind == "makes" else SimulatedClock()
    skin_world.simulation.start(clock)
    pace = skin_world.simulation.step_driver
    for k in range(1, 21):
        if isinstance(clock, ClockSource):
            pace._before_tick(0.01 * k, clock.current_tick.epoch)
        else:
            clock.on_tick(Tick(10_000_000 * k, 0, 1.0, False))
        pace.update()
    assert numbers(skin_world) == list(range(1, 11))


def test_skin_has_no_frame_before_the_first(skin_world: SkinWorld) -> None:
    failed = skin_world.types.HardwareFailedException
    with pytest.raises(failed, match="no frame yet"):
        skin_world.ports["Skin"].getFrame()
    with pytest.raises(failed, match="not compensated"):
        skin_world.ports["Skin"].calibrate(1.0)


def test_skin_frame_numbers_continue_after_reset(skin_world: SkinWorld) -> None:
    skin_world.go(0.1)
    skin_world.ports["Simulation"].reset()
    assert skin_world.go(0.1).time == pytest.approx(0.1)
    assert numbers(skin_world) == list(range(1, 11))
    assert {frame.geometry for frame in skin_world.frames} == {1}


def test_skin_snapshot_restores_frames_and_fork_publishes_none(skin_world: SkinWorld) -> None:
    hand = skin_world.ports["Simulation"]
    skin_world.go(0.51)  # half a frame is under way
    saved = hand.snapshot()
    first = [frame.force.tobytes() for frame in (skin_world.go(0.3), skin_world.go(0.02))]
    fork = hand.fork()
    hand.advance(fork, 0.5)
    count = len(skin_world.frames)
    hand.restore(saved)
    again = [frame.force.tobytes() for frame in (skin_world.go(0.3), skin_world.go(0.02))]
    assert again == first
    assert len(skin_world.frames) == count + 16
    assert numbers(skin_world) == list(range(1, len(skin_world.frames) + 1))


def test_skin_geometry_version_increases_only_when_taxels_change(skin_world: SkinWorld) -> None:
    nodes, skin = skin_world.ports["InnerModelManager"], skin_world.ports["Skin"]
    skin_world.go(0.1)
    nodes.addTransform("shelf", "static", "root", skin_world.types.Pose3D())
    assert (skin_world.go(0.1).geometry, skin.getGeometry().version) == (1, 1)
    nodes.removeNode("coarse")
    assert skin.getGeometry().version == 2
    frame = skin_world.go(0.1)
    assert (frame.geometry, len(frame.force)) == (2, 145)
    assert frame.force.sum() == pytest.approx(0.981, rel=0.02)
    nodes.moveNode("touch", "shelf")
    assert [limb.body for limb in skin.getGeometry().limbs] == ["shelf"]
    assert skin_world.go(0.1).geometry == 3
    assert skin_world.frames[-1].force.sum() == 0
    skin_world.ports["Simulation"].reset()
    assert skin_world.go(0.1).geometry == 3
    nodes.removeNode("touch")
    assert (skin.getGeometry().version, len(skin.getGeometry().id)) == (4, 0)
    count = len(skin_world.frames)
    skin_world.go(0.1)
    assert len(skin_world.frames) == count
    with pytest.raises(skin_world.types.HardwareFailedException, match="removed"):
        skin.getFrame()
    assert numbers(skin_world) == list(range(1, count + 1))


def test_skin_restored_older_geometry_is_new_version(skin_world: SkinWorld) -> None:
    hand = skin_world.ports["Simulation"]
    skin_world.go(0.1)
    saved = hand.snapshot()
    skin_world.ports["InnerModelManager"].removeNode("coarse")
    skin_world.go(0.1)
    hand.restore(saved)
    frame = skin_world.go(0.1)
    assert (frame.geometry, len(frame.force)) == (3, 146)


def test_failing_skin_subscriber_does_not_stop_the_others(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    skin_world, received = served(tmp_path, table()), list[int]()

    def fail(frame: SkinFrame) -> None:
        raise RuntimeError("deaf")

    skin_world.simulation.skin.subscribe(fail)
    skin_world.simulation.skin.subscribe(lambda frame: received.append(frame.sequence))
    skin_world.simulation.advance(0.05)
    skin_world.simulation.dispatch_events()
    assert received == [1, 2]
    assert "a subscriber failed on frame 1 of the skin" in caplog.text


def test_skin_patch_stays_in_its_skin(skin_world: SkinWorld) -> None:
    with pytest.raises(skin_world.types.InnerModelManagerError, match="stays in its skin"):
        skin_world.ports["InnerModelManager"].moveNode("coarse", "weight")
