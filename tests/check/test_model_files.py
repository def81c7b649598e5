"""`rcgen check` of model files, URDF and MJCF, by themselves."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.languages import check_file, check_syntax
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.simulation.robots.catalog import ROBOTS, description

SOLID = '<geom type="box" size="0.1 0.1 0.1"/>'


def mjcf(bodies: str, head: str = '<compiler angle="radian"/>', tail: str = "") -> str:
    return f"<mujoco>\n{head}\n<worldbody>\n{bodies}\n</worldbody>\n{tail}</mujoco>\n"


def urdf(joint: str, inertial: str = "1") -> str:
    return f"""<robot name="r">
<link name="base"/>
<link name="arm"><inertial><mass value="{inertial}"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="elbow" type="revolute"><parent link="base"/><child link="arm"/>
<axis xyz="0 0 1"/>{joint}</joint>
</robot>
"""


def checked(path: Path, text: str) -> list[Diagnostic]:
    path.write_text(text)
    report = Report()
    check_file(path, Workspace(), report)
    return report.sorted()


MJCF = {
    "clean": (mjcf(f'<body name="a"><joint name="j" range="-1 1"/>{SOLID}</body>'), []),
    "degrees": (
        mjcf(f'<body name="a"><joint name="j" range="-90 90"/>{SOLID}</body>'),
        [("RC893", 4, "the range of `j` is -90 to 90 rad: is it in degrees?")],
    ),
    "radians": (
        mjcf(f'<body name="a"><joint name="j" range="-1.5 1.5"/>{SOLID}</body>', ""),
        [("RC893", 4, 'is `<compiler angle="radian"/>` missing?')],
    ),
    "nameless": (
        mjcf(f'<body name="a"><joint range="-1 1"/>{SOLID}</body>'),
        [("RC893", 4, "a joint of `a` has no name")],
    ),
    "large": (
        mjcf('<body name="a"><joint name="j"/><geom size="300" mass="1"/></body>'),
        [("RC893", 4, "`a` and what it carries are 600 m large: are lengths in mm?")],
    ),
    "small": (
        mjcf('<body name="a"><joint name="j"/><geom size="0.0001" mass="1"/></body>'),
        [("RC893", 4, "only 0.2 mm large")],
    ),
    "heavy": (
        mjcf('<body name="a"><joint name="j"/><geom size="0.1" mass="3000"/></body>'),
        [("RC893", 4, "`a` weighs 3000 kg: is its mass in g?")],
    ),
    "inertia": (
        mjcf(
            '<body name="a"><joint name="j"/><geom size="0.1"/>'
            '<inertial pos="0 0 0" mass="1" diaginertia="100 100 100"/></body>'
        ),
        [("RC893", 4, "the inertia of `a` is that of a body of 10 m")],
    ),
    "frame": (
        mjcf(
            f'<body name="a"><joint name="j" range="-1 1"/>{SOLID}</body>',
            tail='<keyframe><key name="home" qpos="2"/></keyframe>',
        ),
        [("RC893", 4, "the key frame `home` has `j` at 2, outside its limits -1 to 1")],
    ),
    "weightless": (
        mjcf('<body name="a"><joint name="j"/></body>'),
        [("RC652", 4, "`a` moves and has no mass")],
    ),
    "mesh": (
        mjcf(
            '<body name="a"><joint name="j"/><geom type="mesh" mesh="shell"/></body>',
            '<asset><mesh name="shell" file="gone.stl"/></asset>',
        ),
        [("RC652", 2, "gone.stl"), ("RC652", 4, "no mass"), ("RC893", 4, "only")],
    ),
    "twice": (
        mjcf(f'<body name="a">{SOLID}</body>\n<body name="a">{SOLID}</body>'),
        [("RC651", 5, "repeated name 'a' in body")],
    ),
    "limits": (
        mjcf(f'<body name="a"><joint name="j" range="1 -1"/>{SOLID}</body>'),
        [("RC893", 4, "the range of `j` is 1 to -1, so it is not limited")],
    ),
    "open": ("<mujoco>\n<worldbody>\n</mujoco>\n", [("RC651", 3, "mismatched tag")]),
    "unknown": (mjcf('<body nam="a"/>'), [("RC651", 4, "unrecognized attribute: 'nam'")]),
}
URDF = {
    "clean": (urdf('<limit lower="-1" upper="1" effort="5" velocity="2"/>'), []),
    "degrees": (
        urdf('<limit lower="-90" upper="90" effort="5" velocity="2"/>'),
        [("RC893", 5, "the range of `elbow` is -90 to 90 rad")],
    ),
    "motor": (
        urdf('<limit lower="-1" upper="1"/>'),
        [
            ("RC893", 5, "no `effort` in the `<limit>` of `elbow`"),
            ("RC893", 5, "no `velocity` in the `<limit>` of `elbow`"),
        ],
    ),
    "mass": (
        urdf('<limit lower="-1" upper="1" effort="5" velocity="2"/>', "0"),
        [("RC652", 3, "`arm` weighs 0 kg"), ("RC652", 3, "`arm` moves and has no mass")],
    ),
    "parent": (
        urdf('<limit lower="-1" upper="1" effort="5" velocity="2"/>').replace(
            'parent link="base"', 'parent link="bass"'
        ),
        [("RC651", 5, "the parent of the joint `elbow`, `bass`, is no link")],
    ),
}


@pytest.mark.parametrize("suffix", [".mjcf", ".xml"])
@pytest.mark.parametrize("case", MJCF)
def test_check_file_reports_findings_of_mjcf(tmp_path: Path, case: str, suffix: str) -> None:
    text, expected = MJCF[case]
    _compare(checked(tmp_path / f"robot{suffix}", text), expected)


@pytest.mark.parametrize("suffix", [".urdf", ".xml"])
@pytest.mark.parametrize("case", URDF)
def test_check_file_reports_findings_of_urdf(tmp_path: Path, case: str, suffix: str) -> None:
    text, expected = URDF[case]
    _compare(checked(tmp_path / f"robot{suffix}", text), expected)


def _compare(found: list[Diagnostic], expected: list[tuple[str, int, str]]) -> None:
    for diagnostic, (code, line, message) in zip(found, expected, strict=True):
        assert diagnostic.code.id == code
        assert diagnostic.span.start_position[0] == line
        assert message in diagnostic.message


def test_check_file_reads_files_that_mjcf_includes(tmp_path: Path) -> None:
    (tmp_path / "hand.xml").write_text(f'<mujoco><body name="a">{SOLID}</body></mujoco>')
    include = '<include file="hand.xml"/>'
    (finding,) = checked(tmp_path / "r.mjcf", mjcf(f'<body name="a">{SOLID}</body>{include}'))
    assert "repeated name 'a'" in finding.message


@pytest.mark.parametrize("name", ROBOTS)
def test_check_file_finds_nothing_in_models_of_shipped_robots(name: str) -> None:
    report = Report()
    file = description(name).model_file
    assert file is not None
    check_file(file, Workspace(), report)
    check_syntax(file, Workspace(), report)
    assert report.sorted() == []


def test_check_file_reports_a_missing_model(tmp_path: Path) -> None:
    report = Report()
    check_file(tmp_path / "gone.mjcf", Workspace(), report)
    assert ["does not exist" in finding.message for finding in report] == [True]
