"""`JointMotorSimple` and the first `Camera`, for components that were written against them."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.served_worlds import Served, assert_clean, rcgen, served

WORLD = """\
<innerModel>
  <differentialrobot id="robot" tz="100">
    <joint id="neck" axis="y" min="-1" max="1" home="0.25">
      <transform id="l" tx="-30" ty="500">
        <rgbd id="left" width="9" height="6" focal="6"/>
      </transform>
      <transform id="r" tx="30" ty="500">
        <camera id="right" width="9" height="6" focal="6"/>
      </transform>
    </joint>
  </differentialrobot>
  <plane id="wall" nz="-1" pz="1025" size="9000,9000,50" texture="#ff0000"/>
</innerModel>
"""
BOTH = 5
SIZE = 9 * 6


@pytest.fixture
def world(tmp_path: Path) -> Served:
    world_served = served(tmp_path, WORLD, also=("JointMotorSimple", "Camera"))
    world_served.simulation.advance(0.1)
    return world_served


# -- motors ---------------------------------------------------------------------------------------


def simple(world: Served, name: str) -> type:
    """A type of the module that declares the same names as `JointMotor`."""
    return getattr(world.types, f"RoboCompJointMotorSimple_{name}")  # type: ignore[no-any-return]


@pytest.mark.parametrize("name", ["neck", ""])
def test_legacy_motor_reaches_position(world: Served, name: str) -> None:
    """Components that have one motor call it by no name at all."""
    motors = world.ports["JointMotorSimple"]
    motors.setPosition(name, simple(world, "MotorGoalPosition")(0.5, 2.0))
    world.simulation.advance(0.05)
    assert motors.getMotorState(name).isMoving
    world.advance_until(lambda: not motors.getMotorState(name).isMoving)
    assert motors.getMotorState(name).pos == pytest.approx(0.5, abs=2e-3)
    assert isinstance(motors.getMotorState(name), simple(world, "MotorState"))


def test_legacy_motor_turns_at_speed_and_goes_home(world: Served) -> None:
    motors = world.ports["JointMotorSimple"]
    motors.setVelocity("neck", simple(world, "MotorGoalVelocity")(0.4, 5.0))
    world.simulation.advance(0.5)
    assert motors.getMotorState("neck").vel == pytest.approx(0.4, abs=0.01)
    motors.setZeroPos("neck")
    world.simulation.advance(0.05)
    world.advance_until(lambda: not motors.getMotorState("neck").isMoving)
    assert motors.getMotorState("neck").pos == pytest.approx(0.25, abs=2e-3)


def test_legacy_motor_reports_parameters(world: Served) -> None:
    received = world.ports["JointMotorSimple"].getMotorParams("neck")
    assert (received.name, received.minPos, received.maxPos) == ("neck", -1, 1)
    assert received.zeroPos == pytest.approx(0.25)


REFUSED = {
    "an unknown motor": ("elbow", 0.1, 1.0, "UnknownMotorException", "elbow"),
    "beyond the limit": ("neck", 1.5, 1.0, "HardwareFailedException", "limited to -1"),
    "no number": ("neck", math.nan, 1.0, "HardwareFailedException", "NaN"),
    "a negative speed": ("neck", 0.1, -1.0, "HardwareFailedException", "maxSpeed"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_legacy_motor_refuses_invalid_commands(world: Served, case: str) -> None:
    name, position, speed, kind, message = REFUSED[case]
    motors = world.ports["JointMotorSimple"]
    with pytest.raises(simple(world, kind)) as caught:
        motors.setPosition(name, simple(world, "MotorGoalPosition")(position, speed))
    assert message in caught.value.what  # type: ignore[attr-defined]
    assert not motors.getMotorState("neck").isMoving


# -- images ---------------------------------------------------------------------------------------


def test_legacy_camera_has_five_image_formats(world: Served) -> None:
    camera, eye = world.ports["Camera"], world.simulation.devices["left"]
    colours = eye.picture().colour.astype(float)
    red, green, blue = (colours[..., i] for i in range(3))
    assert red.max() > 100
    grey = 0.299 * red + 0.587 * green + 0.114 * blue
    packed, _, _ = camera.getRGBPackedImage(0)
    assert (packed == colours.ravel()).all()
    luminance, _, _ = camera.getYImage(0)
    assert luminance == pytest.approx(grey.ravel(), abs=0.51)
    planes = camera.getYRGBImage(0)[0].reshape(4, 6, 9)
    assert (planes[0].ravel() == luminance).all()
    assert (planes[1:] == [red, green, blue]).all()
    both = camera.getYUVImage(0)[0]
    assert (both[:SIZE] == luminance).all()
    colour = both[SIZE:].reshape(3, 5, 2)  # of every second pixel of every second row
    assert colour[..., 1] == pytest.approx((0.713 * (red - grey) + 128)[::2, ::2], abs=1)
    assert colour[..., 0] == pytest.approx((0.564 * (blue - grey) + 128)[::2, ::2], abs=1)
    small = camera.getYImageCR(0, 2)[0].reshape(3, 4)
    assert small[1, 2] == pytest.approx(grey[2:4, 4:6].mean(), abs=1)


def test_legacy_camera_concatenates_images_of_all_cameras(world: Served) -> None:
    camera = world.ports["Camera"]
    left, right = (camera.getYImage(i)[0] for i in (0, 1))
    assert (camera.getYImage(BOTH)[0] == [*left, *right]).all()
    assert len(camera.getRGBPackedImage(BOTH)[0]) == 2 * 3 * SIZE


def test_legacy_camera_image_contains_head_and_base_state(world: Served) -> None:
    world.ports["JointMotorSimple"].setPosition("", simple(world, "MotorGoalPosition")(0.5, 1.0))
    world.simulation.advance(0.1)
    _, head, base = world.ports["Camera"].getYImage(1)
    assert head.isMoving
    assert 0 < head.motorsState["neck"].pos < 0.5
    assert base.correctedZ == pytest.approx(100, abs=1)


def test_legacy_camera_reports_parameters(world: Served) -> None:
    received = world.ports["Camera"].getCamParams()
    assert (received.name, received.width, received.height, received.focal) == ("left", 9, 6, 6)
    assert (received.numCams, received.leftCamera, received.rightCamera, received.bothCameras) == (
        2,
        0,
        1,
        BOTH,
    )
    assert (received.size, received.FPS, received.talkToBase, received.talkToJointMotor) == (
        SIZE,
        15,
        True,
        True,
    )


def test_legacy_camera_shows_injected_image(world: Served) -> None:
    camera = world.ports["Camera"]
    fed = np.arange(SIZE * 3, dtype=np.uint8)
    before = camera.getRGBPackedImage(1)[0]
    camera.setInnerImage(fed)
    assert (camera.getRGBPackedImage(0)[0] == fed).all()
    assert (camera.getRGBPackedImage(1)[0] == before).all()
    camera.setInnerImage(fed[:SIZE])  # grey
    assert camera.getYImage(0)[0] == pytest.approx(fed[:SIZE], abs=1)
    camera.setInnerImage(fed[:0])
    assert not (camera.getRGBPackedImage(0)[0] == fed).all()


SENSELESS = {
    "a camera that is not there": ("getYImage", (2,), "there is no camera 2: 0 to 1, or 5 for all"),
    "a camera below all": ("getYImage", (-1,), "there is no camera -1"),
    "no divisor": ("getYImageCR", (0, 0), "`div` is 0, it must be 1 to 6"),
    "too large a divisor": ("getYImageCR", (0, 7), "`div` is 7"),
    "log-polar": ("getYLogPolarImage", (0,), "log-polar images are not made"),
    "another size": ("setInnerImage", (np.zeros(7, np.uint8),), "not 7"),
}


@pytest.mark.parametrize("case", SENSELESS)
def test_legacy_camera_reports_invalid_arguments(world: Served, case: str) -> None:
    operation, values, message = SENSELESS[case]
    with pytest.raises(Exception, match=message):
        getattr(world.ports["Camera"], operation)(*values)


def test_legacy_camera_without_robot_has_no_states(tmp_path: Path) -> None:
    text = '<innerModel><camera id="eye" width="8" height="6"/></innerModel>'
    world = served(tmp_path, text, also=("Camera",))
    image, head, base = world.ports["Camera"].getYImage(0)
    assert (len(image), head.motorsState, head.isMoving) == (48, {}, False)
    assert base == world.types.TBaseState()


# -- at the command line --------------------------------------------------------------------------


def test_legacy_interfaces_are_served_on_request(tmp_path: Path) -> None:
    (tmp_path / "head.xml").write_text(WORLD)
    usual = rcgen("simulator", "head.xml", "--dry-run", cwd=tmp_path)
    asked = rcgen(
        *("simulator", "head.xml", "--dry-run", "--also", "Camera", "--also", "JointMotorSimple"),
        cwd=tmp_path,
    )
    assert (usual.returncode, asked.returncode, asked.stderr) == (0, 0, "")
    more = [line.split() for line in asked.stdout.splitlines() if line not in usual.stdout]
    assert more == [
        ["neck", "joint", "JointMotorSimple", "JointMotorSimple"],
        ["left", "rgbd", "Camera", "Camera"],
        ["right", "camera", "Camera", "Camera"],
    ]


@pytest.mark.parametrize(
    ("asked", "code", "message"),
    [("Camera", 0, "world.xml:1:1: warning[RC635]"), ("Lidar", 2, "JointMotorSimple, Camera")],
)
def test_legacy_servants_report_unsupported_operations(
    tmp_path: Path, asked: str, code: int, message: str
) -> None:
    (tmp_path / "world.xml").write_text('<innerModel><imu id="i"/></innerModel>')
    done = rcgen(
        *("simulator", "world.xml", "--dry-run", "--also", asked, "--format", "concise"),
        cwd=tmp_path,
    )
    assert done.returncode == code
    assert message in done.stderr
    assert "Traceback" not in done.stderr


def test_legacy_simulator_is_formatted_as_generated(tmp_path: Path) -> None:
    """Two modules that declare the same types have longer names for them."""
    (tmp_path / "head.xml").write_text(WORLD)
    asked = ("--also", "Camera", "--also", "JointMotorSimple", "-o", "made")
    assert rcgen("simulator", "head.xml", *asked, cwd=tmp_path).returncode == 0
    assert_clean(tmp_path / "made")
