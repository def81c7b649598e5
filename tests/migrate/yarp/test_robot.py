"""Robots of yarprobotinterface as worlds, devices and actions; with findings about the rest."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Callable

import pytest

from robocomp_dsl.migrate.yarp.device_types import DeviceRole, role_of
from tests.migrate.yarp.conftest import MigratedFiles
from tests.migrate.yarp.robot_files import ARM

Migrate = Callable[..., MigratedFiles]


def robot(body: str, attributes: str = 'name="r"') -> dict[str, str]:
    return {"r.xml": f"<robot {attributes}>\n{body}\n</robot>\n"}


def board(name: str, joints: str, kind: str = "fakeMotionControl") -> str:
    return (
        f'<device name="{name}" type="{kind}"><group name="GENERAL">'
        f'<param name="AxisName">{joints}</param></group></device>'
    )


def attach(networks: str, level: int = 5) -> str:
    return (
        f'<action phase="startup" level="{level}" type="attach"><paramlist name="networks">'
        f"{networks}</paramlist></action>"
    )


def boards_of(migrated: MigratedFiles, name: str = "r") -> dict[str, list[str]]:
    """The joints of each control board of the world."""
    root = ET.fromstring(migrated.texts[f"{name}.xml"])
    return {
        each.get("name", ""): [element.get("objname", "") for element in each]
        for each in root.iter("tuple")
    }


def test_robot_files_become_world_with_joints_limits_and_sensors(migrate: Migrate) -> None:
    migrated = migrate(ARM)
    joints = ["shoulder_pitch", "shoulder_roll", "lift", "wrist_yaw"]
    assert boards_of(migrated, "arm") == {"arm": joints}
    world = ET.fromstring(migrated.texts["arm.xml"])
    kinds = {
        each.get("name"): (each.get("type"), each.get("range")) for each in world.iter("joint")
    }
    assert kinds == {
        "shoulder_pitch": ("hinge", "-1.0472 1.0472"),
        "shoulder_roll": ("hinge", "0.174533 1.5708"),
        "lift": ("slide", "0 0.2"),
        "wrist_yaw": ("hinge", "-0.785398 0.785398"),
    }
    speeds = {each.get("name"): each.get("data") for each in world.iter("numeric")}
    assert speeds == {"speed_shoulder_pitch": "1.5708", "speed_lift": "0.5"}
    assert [each.get("site") for each in world.iter("gyro")] == ["imu"]
    assert [each.get("name") for each in world.iter("camera")] == ["eye"]
    assert [each.get("qpos") for each in world.iter("key")] == ["0 0.174533 0 0"]


def test_robot_devices_become_boards_calibrators_and_actions(migrate: Migrate) -> None:
    text = migrate(ARM).texts["arm.ddsl"]
    for line in (
        "device arm_mc_wrapper : control_board { set part = arm; };",
        "device arm_calib : calibrator { set speed = 1.5708; set timeout = 30;",
        "set home.shoulder_pitch = 0.261799; set park.shoulder_pitch = 0.523599;",
        "set home.lift = 0.15; set park.lift = 0.1;",
        "set home.wrist_yaw = 0.785398; set park.wrist_yaw = 0;",
        "attach arm_calib to arm_mc_wrapper;",
        "on startup level 10 calibrate arm_mc_wrapper by arm_calib;",
        "on interrupt1 level 1 park arm_mc_wrapper by arm_calib;",
        "on interrupt3 level 1 abort arm_calib;",
        "on shutdown level 9 detach arm_calib;",
        '//     executable "yarprobotinterface --config ../old/arm.xml";',
    ):
        assert line in text


def test_robot_findings_are_located_in_the_files(migrate: Migrate) -> None:
    assert [each for each in migrate(ARM).findings if "RC985" not in each] == [
        "arm.xml:10 RC979: `hardware/skin.xml` is left out, because it is enabled by `skin touch`",
        "arm.xml:11 RC981: `hardware/imu.xml` is included; `--disable_tags (no_imu)` omitted it",
        "arm-calib.xml:1 RC987: `arm-calib`: the home position 1.571 of `wrist_yaw` is outside of"
        " its limits; 0.7854 is used",
        "imu.xml:2 RC979: `--imu_port` of the command line; `/dev/t` is used",
    ]


@pytest.mark.parametrize("tag", ["touch", "all"])
def test_robot_parts_are_enabled_by_tags(migrate: Migrate, tag: str) -> None:
    migrated = migrate(ARM, tags=(tag,))
    assert "// device arm_skin : embObjSkin;" in migrated.texts["arm.ddsl"]
    assert migrated.has("skin.xml:1 RC984", "`arm_skin` (embObjSkin) has no counterpart")


def test_robot_of_format_1_includes_files_by_attribute(migrate: Migrate) -> None:
    files = {
        "old.xml": '<robot name="old"><params file="pc.xml"/><devices file="hw/mc.xml"/></robot>',
        "pc.xml": "<params/>",
        "hw/mc.xml": f"<devices><!-- a <!-- b -->{board('mc', 'a b')}<params file='pc.xml'/>"
        "</devices>",
    }
    migrated = migrate(files)
    assert boards_of(migrated, "old") == {"mc": ["a", "b"]}
    assert not migrated.has("RC986")


REMAPPER = (
    '<device name="r-mc_remapper" type="controlboardremapper">{}'
    + attach('<elem name="n">motors</elem><elem name="m">gazebo</elem>')
    + "</device>"
)
SERVER = (
    '<device name="nws" type="controlBoard_nws_yarp"><param name="name">/r/torso</param>'
    '<action phase="startup" level="10" type="attach"><param name="device">r-mc_remapper</param>'
    "</action></device>"
)
NETWORKS = (
    '<paramlist name="networks"><elem name="n">0 1 0 1</elem><elem name="m">(2 3 0 1)</elem>'
    "</paramlist>"
)


@pytest.mark.parametrize(
    ("body", "boards"),
    [
        (board("left-mc", "a b"), {"left": ["a", "b"]}),
        (board("motors", "a b") + REMAPPER.format('<param name="axesNames">(b, a)</param>'),
         {"r": ["b", "a"]}),
        (board("motors", "a b c") + REMAPPER.format(NETWORKS) + SERVER,
         {"torso": ["a", "b", "gazebo_0", "gazebo_1"], "motors": ["c"]}),
        (REMAPPER.format('<param name="axesNames">x y</param>') + SERVER, {"torso": ["x", "y"]}),
        (REMAPPER.format(NETWORKS + NETWORKS),
         {"r": ["motors_0", "motors_1", "gazebo_0", "gazebo_1"]}),
        (REMAPPER.format('<paramlist name="networks"><elem name="n">0 x</elem></paramlist>'), {}),
        ('<device name="self" type="controlBoard_nws_yarp"><action phase="startup" level="1"'
         ' type="attach"><param name="device">self</param></action></device>', {}),
        (board("m", '"none" b'), {"m": ["b"]}),
        ('<device name="m" type="fakebot"><param name="joints">2</param></device>',
         {"m": ["m_0", "m_1"]}),
        ('<device name="m" type="remote_controlboard"/>', {}),
        (board("a", "j") + board("b", "j"), {"a": ["j"], "b": ["j_2"]}),
        (board("Simulation", "Clock"), {"Simulation_2": ["Clock"]}),
    ],
)  # fmt: skip
def test_robot_groups_of_joints_become_boards(
    migrate: Migrate, body: str, boards: dict[str, list[str]]
) -> None:
    migrated = migrate(robot(body))
    assert ("r.xml" in migrated.texts) == bool(boards)
    if boards:
        assert boards_of(migrated) == boards


def test_robot_group_of_all_joints_is_left_out_in_favour_of_its_parts(migrate: Migrate) -> None:
    both = board("a-mc", "a") + board("b-mc", "b")
    whole = (
        '<device name="all" type="controlboardwrapper2"><paramlist name="networks">'
        '<elem name="x">0 0 0 0</elem><elem name="y">1 1 0 0</elem></paramlist>'
        + attach('<elem name="x">a-mc</elem><elem name="y">b-mc</elem>')
        + "</device>"
    )
    server = '<device name="nws_{0}" type="controlBoard_nws_yarp">{1}</device>'
    parts = [server.format(k, attach(f'<elem name="x">{k}-mc</elem>')) for k in "ab"]
    migrated = migrate(robot(both + whole + "".join(parts)))
    assert boards_of(migrated) == {"nws_a": ["a"], "nws_b": ["b"]}
    assert migrated.has("RC989", "the joints of `all` belong to `nws_a`, `nws_b`")


def test_robot_without_joints_and_sensors_is_run_by_yarprobotinterface(migrate: Migrate) -> None:
    migrated = migrate(robot('<device name="b" type="bcbBattery"/>'))
    assert list(migrated.texts) == ["r.ddsl"]
    assert 'executable "yarprobotinterface --config ../old/r.xml";' in migrated.texts["r.ddsl"]
    assert migrated.has("r.xml:2 RC984", "`b` (bcbBattery)")


def test_robot_that_reverses_levels_keeps_their_order(migrate: Migrate) -> None:
    calibrator = (
        '<device name="c" type="parametricCalibrator">'
        '<action phase="shutdown" level="2" type="detach"/>'
        '<action phase="shutdown" level="9" type="park"><param name="target">m</param></action>'
        '<action phase="startup" level="3" type="calibrate"><param name="target">m</param></action>'
        "</device>"
    )
    attributes = 'name="r" reverse-shutdown-action-order="true"'
    text = migrate(robot(board("m", "a") + calibrator, attributes)).texts["r.ddsl"]
    assert "on shutdown level 7 detach c;" in text
    assert "on shutdown level 0 park m by c;" in text
    assert "on startup level 3 calibrate m by c;" in text


def test_calibrator_that_a_wrapper_attaches_is_attached(migrate: Migrate) -> None:
    wrapper = (
        '<device name="w" type="controlboardwrapper2"><paramlist name="networks">'
        '<elem name="x">0 0 0 0</elem></paramlist>'
        + attach('<elem name="x">m</elem><elem name="Calibrator">c</elem>')
        + "</device>"
    )
    calibrator = '<device name="c" type="fakeCalibrator"/>'
    assert (
        "attach c to w;" in migrate(robot(board("m", "a") + wrapper + calibrator)).texts["r.ddsl"]
    )


@pytest.mark.parametrize(
    ("body", "finding"),
    [
        ("<devic/>", "r.xml:2 RC976: `<devic>`"),
        ('<device name="a"/>', "r.xml:2 RC977: a device needs `name` and `type`"),
        (2 * '<device name="a" type="x"/>', "RC977: there are two devices `a`"),
        ('<device name="a" type="x"><param>1</param></device>', "RC977: `<param>` without a name"),
        ('<device name="a" type="x"><foo/></device>', "RC976: `<foo>`"),
        ('<device name="a" type="x"><action phase="start" level="1" type="park"/></device>',
         "RC977: an action needs"),
        ('<device name="a" type="x"><action phase="run" level="1" type="park"/></device>',
         "RC988: `park` of `a` in the phase `run`"),
        ('<device name="a" type="x"><action phase="startup" level="1" type="custom"/></device>',
         "RC988: `custom` of `a`"),
        ('<device name="c" type="fakeCalibrator"><action phase="startup" level="1"'
         ' type="calibrate"><param name="target">none</param></action></device>',
         "RC988: `calibrate` of `c`, which is not in the deployment"),
        ('<xi:include href="none.xml"/>', "r.xml:2 RC986: `none.xml`: the file does not exist"),
        ('<xi:include href="r.xml"/>', "RC986: `r.xml` includes itself"),
        ("<xi:include/>", "RC986: an inclusion without `href`"),
        ('<device name="c" type="cartesiancontrollerserver"/>', "RC984: `c` (cartesian"),
        ('<device name="m" type="canmotioncontrol"/>', "RC984: `m` (canmotioncontrol)"),
        (board("m", "a"), "RC987: `m`: limits of joints"),
        ('<device name="m" type="fakebot"><param name="axes">1</param></device>',
         "RC987: `m`: names of joints"),
    ],
)  # fmt: skip
def test_robot_element_is_reported(migrate: Migrate, body: str, finding: str) -> None:
    assert migrate(robot(body)).has(finding)


@pytest.mark.parametrize(
    ("kind", "role"),
    [
        ("fakeMotionControl", DeviceRole.MOTORS),
        ("canBusMotionControl", DeviceRole.MOTORS),
        ("fakebot", DeviceRole.MOTORS),
        ("remote_controlboard", DeviceRole.MOTORS),
        ("controlBoard_nws_ros2", DeviceRole.GROUP),
        ("controlboardwrapper2", DeviceRole.GROUP),
        ("remotecontrolboardremapper", DeviceRole.GROUP),
        ("parametricCalibratorEth", DeviceRole.CALIBRATOR),
        ("cartesiancontrollerserver", DeviceRole.CARTESIAN),
        ("inertial", DeviceRole.IMU),
        ("xsensmtx", DeviceRole.IMU),
        ("fakeFrameGrabber", DeviceRole.CAMERA),
        ("realsense2", DeviceRole.CAMERA),
        ("frameGrabber_nws_yarp", DeviceRole.SERVER),
        ("analogServer", DeviceRole.SERVER),
        ("skinWrapper", DeviceRole.SERVER),
        ("Rangefinder2DWrapper", DeviceRole.SERVER),
        ("multipleanalogsensorsremapper", DeviceRole.SERVER),
        ("bcbBattery", DeviceRole.UNKNOWN),
        ("CanBusBroker", DeviceRole.UNKNOWN),
    ],
)
def test_role_of_types_of_public_robots(kind: str, role: DeviceRole) -> None:
    assert role_of(kind) is role
