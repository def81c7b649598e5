"""The check of InnerModel files: nodes with values, and findings with locations."""

import math
from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_innermodel
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.scene.scene import lower_body
from robocomp_dsl.model import innermodel
from robocomp_dsl.model.innermodel import InnerModel


def checked(folder: Path, text: str) -> tuple[InnerModel, Report]:
    path = folder / "world.xml"
    path.write_text(f"<innerModel>{text}</innerModel>")
    report = Report()
    found = check_innermodel(path, Workspace(environ={}), report)
    assert found is not None
    return found, report


def single_node(folder: Path, text: str) -> innermodel.Node:
    found, report = checked(folder, text)
    assert [d.message for d in report] == []
    (node,) = found.root.children
    return node


@pytest.mark.parametrize(
    ("text", "kind", "values"),
    [
        (
            '<transform id="a"/>',
            innermodel.Transform,
            {"tx": 0, "rz": 0, "engine": "static", "mass": 0},
        ),
        ('<TRANSFORM id="a" tx="-1.5e2"/>', innermodel.Transform, {"tx": -150, "tag": "transform"}),
        ('<rotation id="a" ry=" 1.5 "/>', innermodel.Transform, {"ry": 1.5, "tag": "rotation"}),
        (
            '<joint id="a"/>',
            innermodel.Joint,
            {"axis": "z", "min": -math.inf, "max": math.inf, "home": None},
        ),
        ('<joint id="a" axis="X" port="10067"/>', innermodel.Joint, {"axis": "x", "port": 10067}),
        (
            '<prismaticjoint id="a" position="5"/>',
            innermodel.PrismaticJoint,
            {"position": 5, "offset": 0},
        ),
        (
            '<plane id="a"/>',
            innermodel.Plane,
            {"size": (2500, 2500, 25), "repeat": 1000, "collide": False},
        ),
        ('<plane id="a" size="200"/>', innermodel.Plane, {"size": (200, 200, 2)}),
        ('<plane id="a" size="200,100"/>', innermodel.Plane, {"size": (200, 100, 1)}),
        (
            '<plane id="a" size="200, 100 ,5" collide="1"/>',
            innermodel.Plane,
            {"size": (200, 100, 5)},
        ),
        ('<mesh id="a" file="x.obj" scale="2,3"/>', innermodel.Mesh, {"scale": (2, 3, 2)}),
        ('<mesh id="a" file="x.obj"/>', innermodel.Mesh, {"scale": (1, 1, 1), "render": "normal"}),
        ('<differentialrobot id="a" noise="0.1"/>', innermodel.Base, {"noise": 0.1, "port": 0}),
        (
            '<laser id="a" measures="360" angle="3.14"/>',
            innermodel.Laser,
            {"measures": 360, "min": 0},
        ),
        ('<rgbd id="a" width="640" focal="480"/>', innermodel.Camera, {"width": 640, "focal": 480}),
        ('<axes id="a" length="30"/>', innermodel.Axes, {"length": 30, "width": 15, "lengthx": -1}),
        ('<display id="a" port="5"/>', innermodel.Plane, {"port": 5, "tag": "display"}),
    ],
)
def test_innermodel_node_has_values_and_defaults(
    tmp_path: Path, text: str, kind: type[innermodel.Node], values: dict[str, object]
) -> None:
    node = single_node(tmp_path, text)
    assert type(node) is kind
    assert {name: getattr(node, name) for name in values} == values


@pytest.mark.parametrize(
    ("text", "findings"),
    [
        ('<trasform id="a"/>', ["RC801 `trasform` did you mean `transform`?"]),
        ('<innermodel id="a"/>', ["RC801 `innermodel` "]),
        ('<transform id="a" TX="1"/>', ["RC802 `TX` did you mean `tx`?"]),
        ('<translation id="a" x="1"/>', ["RC802 `x` did you mean `tx`?"]),
        ('<camera id="a" port="1"/>', ["RC802 `port` ignored"]),
        ('<transform id="a" tx="0,5"/>', ['RC803 `"0,5"` ']),
        ('<transform id="a" tx=""/>', ['RC803 `""` ']),
        ('<transform id="a" tx="nan"/>', ['RC803 `"nan"` ']),
        ('<transform id="a" rx="inf"/>', ['RC803 `"inf"` ']),
        ('<transform id="a" rx="1e999"/>', ['RC803 `"1e999"` ']),
        ('<joint id="a" min="-inf" max="INF"/>', []),
        ('<joint id="a" axis="w"/>', ['RC803 `"w"` ']),
        ('<joint id="a" port="1.5"/>', ['RC803 `"1.5"` ']),
        (
            '<mesh id="a" file="x" render="wirefram"/>',
            ['RC803 `"wirefram"` did you mean `wireframe`?'],
        ),
        ('<plane id="a" size="1,2,3,4"/>', ['RC803 `"1,2,3,4"` ']),
        ('<plane id="a" collide="true"/>', ['RC803 `"true"` ']),
        ('<imu id="a"/><imu id="a"/>', ['RC804 `"a"` choose another id']),
        ('<imu id="root"/>', ['RC804 `"root"` choose another id']),
        ("<imu/>", ["RC805 `imu` nothing can refer to it"]),
        ('<include path="gone.xml"/>', ['RC806 `"gone.xml"` ']),
        ("<include/>", ["RC806 `include` "]),
        ('<include path="world.xml"/>', ['RC806 `"world.xml"` ']),
        ('<imu id="a"><imu id="b"/></imu>', ["RC807 `imu` "]),
        ('<joint id="a" min="2" max="1"/>', ["RC808 `<joint` "]),
        ('<motor id="a"/>', ["RC808 `<motor` "]),
        ('<mesh id="a"/>', ["RC808 `<mesh` "]),
        ('<mesh id="a" file="x" scale="0"/>', ["RC808 `<mesh` "]),
        ('<plane id="a" size="inf"/>', ["RC808 `<plane` "]),
        ('<plane id="a" size="-216,279,10"/>', []),  # a mirrored picture
        ('<mesh id="a" file="x" scale="-1,1,1"/>', []),
        ('<transform id="a" mass="-5"/>', ["RC808 `<transform` "]),
    ],
)
def test_innermodel_check_reports_findings(tmp_path: Path, text: str, findings: list[str]) -> None:
    _, report = checked(tmp_path, text)
    assert [f"{d.code.id} `{d.span.text}` {d.label}" for d in report] == findings


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ('<translation id="a" x="1" y="-2"/>', {"tx": 1, "ty": -2, "tz": 0}),
        ('<rotation id="a" x="0.5"/>', {"rx": 0.5, "ry": 0}),
        ('<translation id="a" x="1" tx="2"/>', {"tx": 2}),
        ('<transform id="a" x="1"/>', {"tx": 0, "rx": 0}),  # either may be meant
        ('<plane id="a" x="1"/>', {"nx": 0, "px": 0}),
        ('<transform id="a" TX="7" Mass="3"/>', {"tx": 7, "mass": 3}),
        ('<translation id="a" x="wide"/>', {"tx": 0}),
    ],
)
def test_innermodel_check_corrects_unknown_attribute(
    tmp_path: Path, text: str, values: dict[str, object]
) -> None:
    found, report = checked(tmp_path, text)
    assert "RC802" in {d.code.id for d in report}
    (node,) = found.root.children
    assert {name: getattr(node, name) for name in values} == values


def test_innermodel_check_drops_invalid_nodes_and_keeps_others(tmp_path: Path) -> None:
    found, report = checked(
        tmp_path,
        '<transform id="a" tx="x" ty="7"><foo><imu id="lost"/></foo><imu id="a"/><imu/></transform>'
        '<plane id="p"/>',
    )
    assert report.has_errors
    names = [(n.id, p.id if p else "") for n, p in found.nodes()]
    assert names == [("root", ""), ("a", "root"), ("a#2", "a"), ("imu#1", "a"), ("p", "root")]
    (first, _) = found.root.children
    assert isinstance(first, innermodel.Transform)
    assert (first.tx, first.ty) == (0, 7)


def test_innermodel_check_resolves_includes(tmp_path: Path) -> None:
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "robot.xml").write_text(
        '<innermodel><include path="arm.xml"/><imu id="imu"/></innermodel>'
    )
    (tmp_path / "parts" / "arm.xml").write_text('<innermodel><joint id="elbow"/></innermodel>')
    (tmp_path / "hand.xml").write_text('<innermodel><joint id="finger"/></innermodel>')
    found, report = checked(
        tmp_path,
        '<transform id="base"><include path="parts/robot.xml"/></transform>'
        '<include path="/home/robocomp/robots/hand.xml"/>',
    )
    assert [d.message for d in report] == []
    names = [(n.id, p.id if p else "") for n, p in found.nodes()]
    assert names == [
        ("root", ""),
        ("base", "root"),
        ("elbow", "base"),
        ("imu", "base"),
        ("finger", "root"),
    ]
    paths = {n.id: n.span.source.path.name for n, _ in found.nodes()}
    assert paths["elbow"] == "arm.xml"


def test_innermodel_check_reports_and_breaks_include_cycle(tmp_path: Path) -> None:
    (tmp_path / "b.xml").write_text('<innermodel><include path="world.xml"/></innermodel>')
    found, report = checked(tmp_path, '<imu id="a"/><include path="b.xml"/>')
    assert [d.message for d in report] == ["the file includes itself through `b.xml`"]
    assert len(list(found.nodes())) == 2


def test_innermodel_check_bounds_number_of_includes(tmp_path: Path) -> None:
    for i in range(7):
        inside = f'<include path="f{i + 1}.xml"/>' * 10 if i < 6 else '<imu id="i"/>' * 10
        (tmp_path / f"f{i}.xml").write_text(f"<innermodel>{inside}</innermodel>")
    _, report = checked(tmp_path, '<include path="f1.xml"/>' * 10)
    assert "RC809" in {d.code.id for d in report}


def test_innermodel_check_limits_nesting_depth(tmp_path: Path) -> None:
    text = "".join(f'<transform id="t{i}">' for i in range(300)) + "</transform>" * 300
    found, report = checked(tmp_path, text)
    assert [d.code.id for d in report] == ["RC807"]
    assert len(list(found.nodes())) == 202


INSIDE = [
    ("", "RC784", "put a `<plane>` or a `<mesh>`"),
    ('<plane id="p"/>', "RC784", 'set `collide="1"` on `p`'),
    ('<transform id="t"><mesh id="m" file="m.obj"/></transform>', "RC784", "on `m`"),
    ('<plane id="p" collide="1"/>', "", ""),
    ('<transform id="t"><mesh id="m" file="m.obj" collide="1"/></transform>', "", ""),
    ('<plane id="p"/><display id="d" collide="1"/>', "", ""),
]


@pytest.mark.parametrize(("inside", "code", "help_text"), INSIDE)
@pytest.mark.parametrize("kind", ["bumper", "force"])
def test_check_innermodel_rejects_touch_sensor_without_shape(
    tmp_path: Path, kind: str, inside: str, code: str, help_text: str
) -> None:
    """Shapes of the robot beside the sensor are not part of it."""
    text = f'<touchsensor id="bump" type="{kind}">{inside}</touchsensor>'
    text = f'<transform id="robot"><plane id="hull" collide="1"/>{text}</transform>'
    _, report = checked(tmp_path, text)
    assert [d.code.id for d in report] == [code] * bool(code)
    for finding in report:
        assert finding.span.text == "<touchsensor"
        assert finding.message == "`bump` would never feel anything: no shape in it collides"
        assert help_text in finding.help


@pytest.mark.parametrize(
    ("joint", "home", "start"),
    [
        ('<joint id="j" axis="x" min="-1" max="1" home="1.5"/>', "1.5", 1.0),
        ('<joint id="j" axis="x" rx="0.5" min="0.2" max="1" home="0"/>', "0", 0.2),
        ('<prismaticjoint id="j" axis="x" min="10" max="50" home="-3"/>', "-3", 10.0),
    ],
)
def test_check_innermodel_warns_of_home_outside_limits(
    tmp_path: Path, joint: str, home: str, start: float
) -> None:
    """As in RoboComp, the joint starts at the nearest limit."""
    found, report = checked(tmp_path, joint)
    message = f"`home` ({home}) is outside `min` … `max`: that of `j` is {start:g}"
    assert [(d.code.id, d.message) for d in report] == [("RC785", message)]
    frame = lower_body(found)["frames"][1]
    assert (frame["turn"] if "turn" in frame else frame["place"])[0] == start
    assert frame["motion"]["home"] == start


@pytest.mark.parametrize("value", ["gear", "force", "velocity"])
def test_check_innermodel_rejects_motor_value_that_is_not_positive(
    tmp_path: Path, value: str
) -> None:
    text = f'<joint id="j"><motor id="m" {value}="-5"/></joint>'
    found, report = checked(tmp_path, text)
    assert [d.message for d in report] == [
        "`force`, `gear` and `velocity` of a motor must be positive"
    ]
    assert value not in lower_body(found)["frames"][1]["motion"]
