"""Settings of a simulated skin that change while it runs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.hardware.devices.skin_parameters import require_known_taxels, taxel_ids
from robocomp_dsl.runtime.parameters import ParameterRejected
from robocomp_dsl.tactile.skin.manager import Compensation
from robocomp_dsl.tactile.skin.sensor import Imperfections
from tests.simulation.served_worlds import served
from tests.simulation.skin.skin_world import SkinWorld, table


def test_skin_frames_come_at_their_rate(skin_world: SkinWorld) -> None:
    skin_world.go(0.1)
    skin_world.set_up(rate=200.0)
    skin_world.frames.clear()
    skin_world.go(0.1)
    assert len(skin_world.frames) == 20
    apart = np.diff([frame.time for frame in skin_world.frames])  # whole steps of 2 ms
    assert set(apart.round(4).tolist()) == {0.004, 0.006}


def test_skin_publishes_shear_and_raw_on_request(skin_world: SkinWorld) -> None:
    frame = skin_world.go(0.5)
    assert (len(frame.shearX), len(frame.raw)) == (146, 0)
    skin_world.set_up(shear=False, raw=True)
    frame = skin_world.go(0.02)
    assert [len(component) for component in (frame.shearX, frame.shearY, frame.shearZ)] == [0, 0, 0]
    assert frame.raw.dtype == np.uint8
    counts = np.round(frame.force / 0.05)
    assert frame.raw.tolist() == (240 - counts).astype(int).tolist()
    assert counts.max() > 0


def test_skin_wider_kernel_spreads_same_force(skin_world: SkinWorld) -> None:
    narrow = skin_world.go(0.5)
    skin_world.set_up(sigma=0.010)
    wide = skin_world.go(0.5)
    assert np.count_nonzero(wide.force) > 2 * np.count_nonzero(narrow.force)
    assert wide.force.sum() == pytest.approx(0.981, rel=0.02)


def test_skin_sensor_errors_are_as_configured(skin_world: SkinWorld) -> None:
    full = skin_world.go(0.5).force
    loaded = int(np.argmax(full))
    skin_world.set_up(imperfections=Imperfections(broken=(100 + loaded,)))
    assert skin_world.go(0.02).force[loaded] == 0
    skin_world.set_up(imperfections=Imperfections(threshold=0.05))
    felt = skin_world.go(0.02).force
    assert (felt[full < 0.05] == 0).all()
    assert felt[loaded] == pytest.approx(full[loaded], rel=0.01)
    skin_world.set_up(imperfections=Imperfections(saturation=0.03))
    assert skin_world.go(0.02).force.max() == pytest.approx(0.03)
    skin_world.set_up(imperfections=Imperfections(noise=0.01))
    noisy = np.array([skin_world.go(0.02).force for _ in range(20)])
    assert 0.005 < noisy[:, loaded].std() < 0.02
    with skin_world.simulation.lock:
        skin_world.simulation.noise.set(0.0)
    quiet = np.array([skin_world.go(0.02).force for _ in range(20)])
    assert quiet[:, loaded].std() < 1e-4


def test_skin_compensation_removes_drift_and_initial_load(
    tmp_path: Path,
) -> None:
    skin_world = SkinWorld(served(tmp_path, table(mass=3.0)))
    drifting = Imperfections(drift=0.5)
    skin_world.go(0.5)
    skin_world.set_up(compensation=Compensation(), raw=True, imperfections=drifting)
    assert skin_world.go(4.9).force.sum() == 0  # skin_world calibrates itself for 5 s
    assert skin_world.go(0.5).force.sum() == 0  # the cube was there: skin_world is the baseline
    lift = skin_world.types.Pose3D(0.0, 300.0, 0.0, 0.0, 0.0, 0.0)
    skin_world.ports["InnerModelManager"].setPoseFromParent("weight", lift)
    skin_world.simulation.set_physics(False)
    skin_world.ports["Skin"].calibrate(1.0)
    skin_world.go(1.1)
    skin_world.simulation.set_physics(True)
    assert skin_world.go(0.02).force.sum() == 0
    frame = skin_world.go(1.0)
    assert frame.force.sum() == pytest.approx(29.43, rel=0.3)  # small forces are below its floor
    assert np.count_nonzero(frame.force) >= 16
    with pytest.raises(skin_world.types.HardwareFailedException, match="above 0"):
        skin_world.ports["Skin"].calibrate(-1.0)
    with pytest.raises(skin_world.types.HardwareFailedException, match="finite"):
        skin_world.ports["Skin"].calibrate(float("nan"))


def test_skin_touches_are_published_while_present_and_once_at_end(skin_world: SkinWorld) -> None:
    skin_world.go(1.0)
    lift = skin_world.types.Pose3D(0.0, 100.0, 0.0, 0.0, 0.0, 0.0)
    skin_world.ports["InnerModelManager"].setPoseFromParent("weight", lift)
    skin_world.simulation.set_physics(False)
    skin_world.touches.clear()
    skin_world.go(0.5)
    assert [len(touch.contacts) for touch in skin_world.touches][-1] == 0
    assert [bool(touch.contacts) for touch in skin_world.touches].count(False) == 1


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


def test_skin_refuses_unknown_dead_taxels(skin_world: SkinWorld) -> None:
    geometry = skin_world.simulation.skin.geometry
    require_known_taxels("100-110, 500", geometry)
    with pytest.raises(ParameterRejected, match=r"no taxel 7, 99$"):
        require_known_taxels("7, 99-101", geometry)
