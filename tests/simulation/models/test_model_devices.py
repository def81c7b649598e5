"""What of a model file is served, and with which limits."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.generate.simulator.served_interfaces import not_served, served
from robocomp_dsl.hardware.description.findings import ModelFileError
from robocomp_dsl.hardware.description.scene import Scene
from robocomp_dsl.simulation.models.model_scene import ModelDescription, describe
from robocomp_dsl.simulation.world.simulation import Simulation, SimulationOptions
from tests.simulation.model_worlds import ARM, BOT


def described(folder: Path, text: str, name: str = "robot.xml") -> ModelDescription:
    (folder / name).write_text(text)
    return describe(folder / name, "model.xml")


def settings(folder: Path, text: str, name: str = "robot.xml") -> dict[str, dict[str, Any]]:
    description = described(folder, text, name)
    return {device["id"]: device["settings"] for device in description.scene["devices"]}


def test_model_devices_have_ports(tmp_path: Path) -> None:
    description = described(tmp_path, ARM)
    assert description.findings == []
    ports = [(port.port, port.interface, port.ids) for port in served(description.scene)]
    assert ports == [
        ("JointMotor", "JointMotor", ["elbow", "shoulder", "grip"]),
        ("arm", "ControlBoard", ["elbow", "shoulder"]),
        ("ControlBoard", "ControlBoard", ["grip"]),
        ("eye", "CameraSimple", ["eye"]),
        ("far", "CameraSimple", ["far"]),
        ("CameraRGBDSimple", "CameraRGBDSimple", ["eye"]),
        ("wrist", "IMU", ["wrist"]),
        ("TouchSensor", "TouchSensor", ["palm"]),
        ("InnerModelManager", "InnerModelManager", [""]),
        ("Simulation", "Simulation", [""]),
    ]
    assert not_served(description.scene) == [
        ("follower", "followingjoint"),
        ("hinge", "passivejoint"),
    ]


def test_model_limits_come_from_joints_actuators_and_numbers(tmp_path: Path) -> None:
    found = settings(tmp_path, ARM)
    shoulder, elbow, grip = (found[name] for name in ("shoulder", "elbow", "grip"))
    assert shoulder["force"] == 20.0
    assert elbow["force"] == 12.0
    assert grip["force"] == 40.0
    assert elbow["speed"] == 3.5
    assert elbow["home"] == -1.0
    assert (elbow["low"], elbow["high"]) == pytest.approx((-2.0944, 0.0), abs=1e-4)
    assert (grip["low"], grip["high"], grip["home"]) == (0.0, 0.05, 0.01)
    assert elbow["armature"] == 0.02
    assert (elbow["board"], grip["board"]) == ("arm", "")


def test_model_from_urdf_has_motors_for_all_joints(tmp_path: Path) -> None:
    found = settings(tmp_path, BOT, "bot.urdf")
    assert (found["lift"]["force"], found["turn"]["force"]) == (200.0, 40.0)
    assert (found["lift"]["speed"], found["turn"]["speed"]) == (0.25, 2.0)
    assert (found["lift"]["low"], found["lift"]["high"]) == (0.0, 0.5)


def model(joints: str, more: str = "") -> str:
    body = '<geom size="0.1" mass="1"/>'
    return f"<mujoco><worldbody><body>{joints}{body}</body></worldbody>{more}</mujoco>"


HINGE = '<joint name="j" armature="1" actuatorfrcrange="-7 7"/>'
MOTOR = '<actuator><motor joint="j" ctrlrange="-{0} {0}"/></actuator>'
FORCES = [
    (model(HINGE), 7.0),
    (model(HINGE, MOTOR.format(9)), 7.0),
    (model(HINGE, MOTOR.format(3)), 3.0),
    (model('<joint name="j" armature="1"/>'), 50.0),
    (model('<joint name="j" armature="1" type="slide"/>'), 500.0),
    (
        model('<joint name="j" armature="1" type="slide"/>').replace('mass="1"', 'mass="100"'),
        1962.0,
    ),
]


@pytest.mark.parametrize(("text", "force"), FORCES)
def test_model_force_limits_are_read(tmp_path: Path, text: str, force: float) -> None:
    """What is not given holds twice the weight, and 50 N·m or 500 N at least."""
    assert settings(tmp_path, text)["j"]["force"] == pytest.approx(force)


def test_model_devices_without_name_get_one(tmp_path: Path) -> None:
    text = model('<joint/><joint axis="1 0 0"/>').replace("<body>", "<camera/><body>")
    description = described(tmp_path, text)
    assert [device["id"] for device in description.scene["devices"]] == [
        "body1.joint0",
        "body1.joint1",
        "camera0",
    ]


def test_model_joint_in_two_tuples_stays_in_first(tmp_path: Path) -> None:
    tuples = "".join(
        f'<tuple name="{name}"><element objtype="joint" objname="j"/></tuple>' for name in "ab"
    )
    description = described(tmp_path, model(HINGE, f"<custom>{tuples}</custom>"))
    assert description.scene["devices"][0]["settings"]["board"] == "a"
    assert [finding.message for finding in description.findings] == [
        "`j` is in `b` and stays on the board `a`"
    ]


def test_model_reports_invalid_speed(tmp_path: Path) -> None:
    text = model(HINGE, '<custom><numeric name="speed_j" data="-1"/></custom>')
    description = described(tmp_path, text)
    assert description.scene["devices"][0]["settings"]["speed"] == pytest.approx(6.2832, abs=1e-4)
    assert "speed_j" in description.findings[0].message


@pytest.mark.parametrize(("values", "received"), [("", []), ('armature="0.1"', ["too light"])])
def test_model_adds_inertia_to_joint_of_strong_motor(
    tmp_path: Path, values: str, received: list[str]
) -> None:
    """Else no controller could hold it at that step; told where the file says otherwise."""
    description = described(tmp_path, model(f'<joint name="j" {values}/>', MOTOR.format(900)))
    assert description.scene["devices"][0]["settings"]["armature"] == pytest.approx(1.8, abs=0.01)
    assert [finding.message[:9] for finding in description.findings] == received


def test_model_devices_with_shared_names_are_renamed(tmp_path: Path) -> None:
    """Joints are called as in the file, whatever else is; all nodes have names of their own."""
    text = model('<joint name="a" armature="1"/><site name="a"/><camera name="a"/>').replace(
        "<body>", '<body name="a">'
    )
    description = described(tmp_path, text)
    frames = [frame["id"] for frame in description.scene["frames"]]
    assert frames == ["root", "a#2.at", "a#2", "a", "a#3"]
    assert [(device["id"], device["frame"]) for device in description.scene["devices"]] == [
        ("a", "a#2"),
        ("a#4", "a"),
    ]


BAD_KEYS = ('qpos="1 2"', 'ctrl="1 2 3"', 'qpos="nan"')


@pytest.mark.parametrize("key", BAD_KEYS)
def test_model_reports_key_frame_of_wrong_size(tmp_path: Path, key: str) -> None:
    text = model(HINGE, f'<keyframe><key name="k" {key}/></keyframe>')
    with pytest.raises(ModelFileError, match="key"):
        described(tmp_path, text)


def test_model_imu_has_noise_of_its_sensors(tmp_path: Path) -> None:
    quiet = '<gyro site="wrist"/>\n    <accelerometer site="wrist"/>'
    noisy = '<gyro site="wrist" noise="0.02"/><accelerometer site="wrist" noise="0.3"/>'
    found = settings(tmp_path, ARM.replace(quiet, noisy))["wrist"]
    assert found == {"site": "wrist", "noise": 0.3, "gyronoise": 0.02}
    assert settings(tmp_path, ARM)["wrist"] == {"site": "wrist"}


def test_model_gyroscope_alone_is_no_imu(tmp_path: Path) -> None:
    text = ARM.replace('<accelerometer site="wrist"/>', "")
    assert "wrist" not in settings(tmp_path, text)


COUPLINGS = [
    ("1 1 1 -1", {"arm": [1.0, 1.0, 1.0, -1.0]}, []),
    ("1 1 1 1", {}, ["no 2 x 2 matrix"]),
    ("1 0 0", {}, ["no 2 x 2 matrix"]),
]


@pytest.mark.parametrize(("numbers", "couplings", "received"), COUPLINGS)
def test_model_joints_share_motors(
    tmp_path: Path, numbers: str, couplings: dict[str, list[float]], received: list[str]
) -> None:
    text = ARM.replace("<custom>", f'<custom><numeric name="coupling_arm" data="{numbers}"/>')
    description = described(tmp_path, text)
    assert description.scene["model"].get("couplings", {}) == couplings
    assert [finding.message[18:33] for finding in description.findings] == received


def test_model_tendon_motors_keep_their_command(tmp_path: Path) -> None:
    """They are on no board; what the key frame commands them is what they do."""
    tendon = '<tendon><fixed name="t"><joint joint="grip" coef="1"/></fixed></tendon><actuator>'
    text = ARM.replace("<actuator>", tendon).replace(
        "</actuator>", '<motor name="pull" tendon="t"/></actuator>'
    )
    text = text.replace('name="home"', 'name="home" ctrl="0.5 0.5 0.5 0.5 0.7"')
    description = described(tmp_path, text)
    assert [finding.message for finding in description.findings] == [
        "not on one joint, so on no control board; they keep the commands of the start: `pull`"
    ]
    assert description.scene["model"]["held"] == {"pull": 0.7}
    file = {"model": description.scene["model"] | {"file": "robot.xml"}}
    it = Simulation(
        Scene.of_data(description.scene | file, tmp_path), SimulationOptions(step=0.001)
    )
    it.advance(0.01)
    assert it.world.data.actuator("pull").ctrl[0] == 0.7


TRANSMISSIONS = [  # names of joints, the matrix, what is said
    ("bend swing", "1 1 1 -1", ""),
    ("bend swing", "1 1 1 1", "a transmission that cannot be turned round"),
    ("bend swing", "1 1 1", "needs a `transmission_\u2026` of 2 x 2 numbers"),
    ("bend bend", "1 1 1 -1", "must name the 2 joints of the board"),
    ("bend grip", "1 1 1 -1", "must name the 2 joints of the board"),
]


@pytest.mark.parametrize(("names", "matrix", "message"), TRANSMISSIONS)
def test_model_boards_may_command_joints_outside_model(
    tmp_path: Path, names: str, matrix: str, message: str
) -> None:
    custom = (
        f'<text name="joints_arm" data="{names}"/>'
        f'<numeric name="transmission_arm" data="{matrix}"/>'
        '<numeric name="range_bend" data="-0.5 0.25"/>'
    )
    description = described(tmp_path, ARM.replace("</custom>", f"{custom}</custom>"))
    received = [
        finding.message for finding in description.findings if "joints_arm" in finding.message
    ]
    devices = {device["id"]: device["settings"] for device in description.scene["devices"]}
    if message:
        assert message in received[0]
        assert "elbow" in devices
        return
    assert received == []
    assert description.scene["model"]["transmissions"] == {"arm": [1.0, 1.0, 1.0, -1.0]}
    assert devices["bend"]["joint"] == "elbow"
    assert (devices["bend"]["low"], devices["bend"]["high"]) == (-0.5, 0.25)
    assert "low" not in devices["swing"]
