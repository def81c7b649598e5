"""Every tag of InnerModel with all its attributes, and their defaults."""

import math
from pathlib import Path

import pytest

from robocomp_dsl.check.innermodel.tags import TAGS
from robocomp_dsl.check.passes import check_innermodel
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model import innermodel
from robocomp_dsl.model.innermodel import InnerModel

INF = math.inf
MOVED = 'tx="1" ty="2" tz="3"'
TURNED = 'rx="0.1" ry="0.2" rz="0.3"'
PLANE = 'texture="a.png" repeat="2" size="9,8,7" nx="1" ny="2" nz="3" px="4" py="5" pz="6"'
STICKS = 'length="1" width="2" lengthx="3" widthx="4" lengthy="5" widthy="6" lengthz="7" widthz="8"'
ENDS = 'lx="1" ly="1" lz="1" hx="1" hy="1" hz="1"'
STILL: dict[str, object] = {"tx": 0, "ty": 0, "tz": 0, "rx": 0, "ry": 0, "rz": 0}
SHEET: dict[str, object] = {
    "texture": "", "repeat": 1000, "size": (2500, 2500, 25), "nx": 0, "ny": 0, "nz": 0,
    "px": 0, "py": 0, "pz": 0, "collide": False,
}  # fmt: skip
FRAME = STILL | {"engine": "static", "mass": 0}
DRIVEN = STILL | {"port": 0, "noise": 0, "collide": False}
IMAGE: dict[str, object] = {"width": 0, "height": 0, "focal": 0}

# tag, all its attributes (RoboComp's, and noise), their defaults
HISTORY: list[tuple[str, str, dict[str, object]]] = [
    ("transform", f'{MOVED} {TURNED} engine="bullet" mass="2"', FRAME),
    ("translation", f'{MOVED} engine="static" mass="2"', FRAME),
    ("rotation", f'{TURNED} engine="bullet" mass="2"', FRAME),
    ("plane", f'{PLANE} collide="1"', SHEET),
    (
        "mesh",
        f'file="a.osg" scale="1,2,3" render="wireframe" {MOVED} {TURNED} collide="1"',
        STILL | {"scale": (1, 1, 1), "render": "normal", "collide": False},
    ),
    (
        "joint",
        f'{ENDS} {MOVED} {TURNED} min="-1" max="1" port="9" axis="x" home="0.5"',
        STILL | {"min": -INF, "max": INF, "port": 0, "axis": "z", "home": None},
    ),
    (
        "prismaticjoint",
        'min="-1" max="1" position="1" offset="2" port="9" axis="y" home="0.5"',
        {
            "min": -INF,
            "max": INF,
            "position": None,
            "offset": 0,
            "port": 0,
            "axis": "z",
            "home": None,
        },
    ),
    (
        "touchsensor",
        'type="1" nx="1" ny="0" nz="0" min="0" max="5" port="9"',
        {"nx": 0, "ny": 0, "nz": 0, "min": -INF, "max": INF, "port": 0},
    ),
    ("differentialrobot", f'{MOVED} {TURNED} port="9" noise="0.1" collide="1"', DRIVEN),
    ("omnirobot", f'{MOVED} {TURNED} port="9" noise="0.1" collide="1"', DRIVEN),
    (
        "rgbd",
        'width="640" height="480" focal="525" noise="1.5" port="9" ifconfig="9000,9001"',
        IMAGE | {"noise": 0, "port": 0, "ifconfig": ""},
    ),
    (
        "laser",
        'port="9" min="100" max="30000" angle="3.14" measures="9" noise="9" ifconfig="9"',
        {"port": 0, "min": 0, "max": 0, "angle": 0, "measures": 0, "noise": 0, "ifconfig": ""},
    ),
    ("camera", 'width="640" height="480" focal="525"', IMAGE),
    (
        "imu",
        'noise="0.1" gyronoise="0.01" port="9"',
        {"port": 0, "noise": 0, "gyronoise": 0},
    ),
    ("pointcloud", "", {}),
    ("display", f'{PLANE} collide="0" port="9"', SHEET | {"port": 0}),
    ("axes", STICKS, {"length": 200, "width": 15, "lengthx": -1, "widthx": -1}),
]


def read(folder: Path, text: str) -> tuple[InnerModel, Report]:
    for positions in ("a", "b", "left_forearm.txt"):
        (folder / positions).write_text("0.005 0 0.005 0 0 1\n")
    path = folder / "world.xml"
    path.write_text(f"<innerModel>{text}</innerModel>")
    report = Report()
    found = check_innermodel(path, Workspace(environ={}), report)
    assert found is not None
    return found, report


def messages(report: Report) -> list[str]:
    return [f"{d.code.id} {d.span.text}" for d in report]


@pytest.mark.parametrize(("tag", "attributes", "defaults"), HISTORY, ids=[h[0] for h in HISTORY])
def test_innermodel_tag_accepts_all_historical_attributes(
    tmp_path: Path, tag: str, attributes: str, defaults: dict[str, object]
) -> None:
    # a touch sensor without a shape is an error
    content = '<plane id="s" collide="1"/>' if tag == "touchsensor" else ""
    for written in (tag, tag.upper()):
        found, report = read(tmp_path, f'<{written} id="a" {attributes}>{content}</{written}>')
        assert messages(report) == []
        assert len(found.root.children) == 1
    file = ' file="a.osg"' if tag == "mesh" else ""
    found, report = read(tmp_path, f'<{tag} id="a"{file}>{content}</{tag}>')
    assert messages(report) == []
    (node,) = found.root.children
    assert {name: getattr(node, name) for name in defaults} == defaults


def test_innermodel_tag_table_is_complete() -> None:
    new = {"motor", "skin", "patch", "taxel", "gps", "ultrasound", "battery"}
    assert {tag for tag, _, _ in HISTORY} == set(TAGS) - new
    for tag, attributes, _ in HISTORY:
        named = {item.split("=")[0] for item in attributes.split()} | {"id"}
        assert named == set(TAGS[tag].attributes), tag


HOLDERS = "transform rotation translation joint touchsensor prismaticjoint differentialrobot"


@pytest.mark.parametrize("tag", [*HOLDERS.split(), "omnirobot"])
def test_innermodel_frame_tags_accept_children(tmp_path: Path, tag: str) -> None:
    found, report = read(tmp_path, f'<{tag} id="a"><imu id="b"/></{tag}>')
    assert messages(report) == (["RC784 <touchsensor"] if tag == "touchsensor" else [])
    assert len(list(found.nodes())) == 3


@pytest.mark.parametrize(
    ("text", "name", "value"),
    [
        ('<transform id="a" tx="0.5 m"/>', "tx", 500),
        ('<transform id="a" tx="-5cm"/>', "tx", -50),
        ('<transform id="a" rz="90 deg"/>', "rz", math.pi / 2),
        ('<transform id="a" mass="300 g"/>', "mass", 0.3),
        ('<joint id="a" min="-45deg"/>', "min", -math.pi / 4),
        ('<prismaticjoint id="a" max="0.2 m"/>', "max", 200),
        ('<laser id="a" angle="180 deg"/>', "angle", math.pi),
        ('<plane id="a" py="1.5 m"/>', "py", 1500),
    ],
)
def test_innermodel_attributes_accept_units(
    tmp_path: Path, text: str, name: str, value: float
) -> None:
    found, report = read(tmp_path, text)
    assert messages(report) == []
    assert getattr(found.root.children[0], name) == pytest.approx(value)


@pytest.mark.parametrize("text", ["5 deg", "5 km", "m", "1 m m", "90 rad", "inf m"])
def test_innermodel_check_reports_wrong_unit(tmp_path: Path, text: str) -> None:
    _, report = read(tmp_path, f'<transform id="a" tx="{text}"/>')
    assert messages(report) == [f'RC803 "{text}"']


SKIN = """
<transform id="arm"><skin id="s" rate="100" port="7">
  <patch id="ringed" x0="20" x1="100" r0="32" r1="0.026 m" rings="33, 60,0.087 m" count="8"
         rz="-90 deg" gain="0.05" floor="2" saturation="240"/>
  <patch id="measured" file="left_forearm.txt" firstid="300"/>
  <patch id="lone" x0="0" x1="70" r0="30" r1="30" firstid="700">
    <taxel x="10" theta="90 deg"/><taxel id="top" x="20" theta="0"/>
  </patch>
  <patch id="points" firstid="800"><taxel x="1" y="2" z="3" nz="1"/></patch>
</skin></transform>
"""


TAXEL = "0 0 0.01 0 0 1\n"
"""One row of a file of positions."""


def test_innermodel_skin_has_patches_and_taxels(tmp_path: Path) -> None:
    (tmp_path / "left_forearm.txt").write_text(TAXEL)
    found, report = read(tmp_path, SKIN)
    assert messages(report) == []
    nodes = {node.id: node for node, _ in found.nodes()}
    assert (nodes["s"].rate, nodes["s"].port) == (100, 7)  # type: ignore[attr-defined]
    ringed, lone = nodes["ringed"], nodes["lone"]
    assert isinstance(ringed, innermodel.Patch)
    assert ringed.rings == (33, 60, 87)
    assert (ringed.r1, ringed.count, ringed.saturation) == (26, 8, 240)
    assert isinstance(lone, innermodel.Patch)
    first, top = lone.children
    assert isinstance(first, innermodel.Taxel)
    assert first.theta == pytest.approx(math.pi / 2)
    assert top.id == "top"
    assert len(nodes) == 10


def test_innermodel_check_reports_second_skin_of_frame(tmp_path: Path) -> None:
    second = '</skin><skin id="t"><patch id="p"><taxel nx="1"/></patch></skin>'
    _, report = read(tmp_path, SKIN.replace("</skin>", second))
    found = [item.message for item in report if "already" in item.message]
    assert found == ["this frame already has the skin `s`: move the patches to it"]


CONE = 'x0="0" x1="9" r0="5" r1="5"'


@pytest.mark.parametrize(
    ("inside", "findings"),
    [
        ("", ["RC808 <skin"]),
        ('<patch id="p"/>', ["RC808 <patch"]),
        (f'<patch id="p" {CONE} rings="1" count="2" file="a"/>', ["RC808 <patch"]),
        ('<patch id="p" rings="1" count="2"/>', ["RC808 <patch"]),
        (f'<patch id="p" {CONE} rings="1"/>', ["RC808 <patch"]),
        (f'<patch id="p" {CONE} rings="1" count="2147483647"/>', ["RC808 <patch"]),
        ('<patch id="p" x0="9" x1="0" r0="5" r1="5" rings="1" count="2"/>', ["RC808 <patch"]),
        ('<patch id="p" x0="0" x1="9" r0="5" rings="1" count="2"/>', ["RC808 <patch"]),
        (f'<patch id="p" {CONE} rings="1,two" count="2"/>', ['RC803 "1,two"', "RC808 <patch"]),
        (f'<patch id="p" {CONE}><taxel x="1"/></patch>', ["RC808 <taxel"]),
        ('<patch id="p"><taxel x="1" theta="1"/></patch>', ["RC808 <taxel"]),
        (f'<patch id="p" {CONE}><taxel theta="1" nz="1"/></patch>', ["RC808 <taxel"]),
        ('<patch id="p" file="a" firstid="-1"/>', ["RC808 <patch"]),
        ('<patch id="p" file="gone"/>', ["RC821 <patch"]),
        ('<patch id="p" file="a"/><imu id="i"/>', ["RC807 imu"]),
        ('<patch id="p" file="a"/><taxel x="1"/>', ["RC807 taxel"]),
        ('<patch id="p" file="a"/><include path="a.xml"/>', ["RC807 include"]),
    ],
)
def test_innermodel_check_reports_invalid_skin(
    tmp_path: Path, inside: str, findings: list[str]
) -> None:
    (tmp_path / "a").write_text(TAXEL)
    _, report = read(tmp_path, f'<transform id="a"><skin id="s">{inside}</skin></transform>')
    assert messages(report) == findings


def test_innermodel_check_reports_patch_outside_skin(tmp_path: Path) -> None:
    found, report = read(tmp_path, '<patch id="p" file="a"/><taxel x="1"/><imu id="i"/>')
    assert messages(report) == ["RC807 patch", "RC807 taxel"]
    assert [node.id for node in found.root.children] == ["i"]
