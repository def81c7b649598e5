"""URDF and MJCF files: geometry against MuJoCo's own importer, and everything that can be wrong."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from robocomp_dsl.hardware.description.findings import ModelFileError
from robocomp_dsl.simulation.models.model_file import LoadedModel, load_model
from robocomp_dsl.simulation.models.model_to_transforms import model_transforms
from tests.simulation.models.test_model_to_transforms import assert_trees_agree, random_position

MODELS = Path(__file__).parent / "files"
GEOM = mujoco.mjtGeom


@pytest.mark.parametrize("name", ["arm.urdf", "crane.xml"])
def test_model_file_tree_matches_mujoco_bodies(name: str) -> None:
    loaded = load_model(MODELS / name)
    assert [str(finding) for finding in loaded.findings] == []
    assert_trees_agree(
        loaded.model, model_transforms(loaded.model), np.random.default_rng(0), moves=6
    )


def test_model_file_links_and_joints_match_mujoco_importer() -> None:
    ours = load_model(MODELS / "arm.urdf").model
    text = (MODELS / "arm.urdf").read_text()
    text = text.replace("package://arm_description/meshes/pyramid.stl", "meshes/pyramid.obj")
    text = text.replace('"meshes/', f'"{MODELS}/meshes/').replace(
        "<material",
        '<mujoco><compiler strippath="false" fusestatic="false" discardvisual="false"/></mujoco>'
        "<material",
        1,
    )
    theirs = mujoco.MjModel.from_xml_string(text)
    random = np.random.default_rng(5)
    assert ours.nq == theirs.nq == 6
    for _ in range(5):
        qpos = random_position(ours, random)
        places = []
        for model in (ours, theirs):
            data = mujoco.MjData(model)
            for j in range(6):
                data.qpos[model.joint(ours.joint(j).name).qposadr[0]] = qpos[j]
            mujoco.mj_forward(model, data)
            places.append(data)
        for i in range(1, ours.nbody):
            other = theirs.body(ours.body(i).name).id
            assert places[0].xpos[i] == pytest.approx(places[1].xpos[other], abs=1e-9)
            assert places[0].xmat[i] == pytest.approx(places[1].xmat[other], abs=1e-9)
            if ours.body(i).name != "tip":  # it has no mass, and so no centre
                assert places[0].xipos[i] == pytest.approx(places[1].xipos[other], abs=1e-9)
            assert ours.body_mass[i] == pytest.approx(theirs.body_mass[other], abs=2e-3)
        for name in ("base", "shoulder", "upper", "fore", "wrist"):
            mine, its = ours.body(name).inertia, theirs.body(name).inertia
            assert mine == pytest.approx(its, rel=1e-6)
    assert ours.joint("lift").range == pytest.approx([-1.5, 2])
    assert ours.jnt_limited[ours.joint("pan").id] == 0
    assert ours.jnt_actfrcrange[ours.joint("lift").id] == pytest.approx([-30, 30])
    assert ours.neq == 1


def test_model_file_mimic_joint_follows() -> None:
    model = load_model(MODELS / "arm.urdf").model
    data = mujoco.MjData(model)
    for _ in range(500):
        data.qfrc_applied[model.joint("left").dofadr[0]] = 0.5
        mujoco.mj_step(model, data)
    left, right = (float(data.joint(name).qpos[0]) for name in ("left", "right"))
    assert left > 0.01
    assert right == pytest.approx(left, abs=2e-3)


def test_model_file_meshes_have_size_and_pose_of_file() -> None:
    model = load_model(MODELS / "arm.urdf").model
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    geom = next(i for i in range(model.ngeom) if model.body(model.geom_bodyid[i]).name == "wrist")
    mesh = model.geom_dataid[geom]
    first = model.mesh_vertadr[mesh]
    points = model.mesh_vert[first : first + model.mesh_vertnum[mesh]]
    body = data.body("wrist")
    world = points @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]
    local = (world - body.xpos) @ body.xmat.reshape(3, 3)
    assert local.min(axis=0) == pytest.approx([-0.05, -0.05, 0], abs=1e-6)
    assert local.max(axis=0) == pytest.approx([0.05, 0.05, 0.05], abs=1e-6)


def load(tmp_path: Path, text: str, name: str = "model.xml") -> LoadedModel:
    path = tmp_path / name
    path.write_text(text)
    return load_model(path)


LINK = "<link name='{0}'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>"
LINKS = "".join(LINK.format(name) + "</link>" for name in "ab")
JOINT = "<joint name='j' type='{}'><parent link='{}'/><child link='{}'/>{}</joint>"


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("", 0, "the file holds no element"),
        ("<svg/>", 0, "the outermost element is `<svg>`, a model begins with `<robot>` or `<mujo"),
        ("<robot>", 1, "this is no XML: no element found"),
        ("<robot>\n<link name='a'></robot>", 2, "this is no XML: mismatched tag"),
        ("<robot/>", 1, "the robot has no links"),
        ("<robot>\n<link/></robot>", 2, "a link has no `name`"),
        ("<robot>\n<link name='a'/>\n<link name='a'/></robot>", 3, "there are two links `a`"),
        ("<robot xmlns:xacro='x'>\n<xacro:macro/></robot>", 1, "this is a xacro file"),
        ("<robot>" + "<a>" * 200, 1, "more than 100 elements in each other"),
        (
            f"<robot>{LINKS}\n{JOINT.format('hinge', 'a', 'b', '')}</robot>",
            2,
            "is `hinge`, it must",
        ),
        (f"<robot>{LINKS}\n{JOINT.format('fixed', 'a', 'c', '')}</robot>", 2, "the child of the j"),
        (
            f"<robot>{LINKS}\n{JOINT.format('fixed', 'a', 'b', '')}\n"
            f"{JOINT.format('fixed', 'b', 'a', '').replace(chr(39) + 'j', chr(39) + 'k')}</robot>",
            3,
            "the links form a cycle: `a`, `b`",
        ),
        (
            f"<robot>{LINKS}<link name='c'/>\n{JOINT.format('fixed', 'a', 'b', '')}\n"
            f"{JOINT.format('fixed', 'c', 'b', '').replace(chr(39) + 'j', chr(39) + 'k')}</robot>",
            3,
            "`b` hangs on two joints, `j` and `k`",
        ),
        (
            f"<robot>{LINKS}\n"
            + JOINT.format("revolute", "a", "b", "\n<origin xyz='0 nan 0'/>")
            + "</robot>",
            3,
            '`xyz` of `<origin>` must be 3 finite numbers, not "0 nan 0"',
        ),
        (
            f"<robot>{LINKS}\n"
            + JOINT.format("revolute", "a", "b", "<mimic joint='z'/>")
            + "</robot>",
            2,
            "the joint `j` follows `z`, which is not there",
        ),
        ("<mujoco>\n<worldbody>\n<geom sise='1'/></worldbody></mujoco>", 3, "attribute: 'sise'"),
        ("<mujoco>\n<worldbody>", 2, "not well-formed XML"),
        ("<mujoco>\n<include file='model.xml'/></mujoco>", 2, "already included"),
        (
            "<mujoco><worldbody><body name='a'/>\n<body name='a'/></worldbody></mujoco>",
            2,
            "repeated name 'a' in body",
        ),
        (
            "<mujoco><worldbody><body>\n<joint axis='0 0 0'/><geom size='1'/></body></worldbody>"
            "</mujoco>",
            2,
            "axis too small",
        ),
    ],
)
def test_model_file_reports_faults_with_line(
    tmp_path: Path, text: str, line: int, message: str
) -> None:
    with pytest.raises(ModelFileError) as error:
        load(tmp_path, text)
    assert message in str(error.value)
    assert error.value.findings[0].location.line == line


@pytest.mark.parametrize(
    ("inside", "kind", "line", "message"),
    [
        ("<link name='a'/><link name='b'/>\n@", "mass", 1, "`b` moves and has no mass"),
        (LINKS.replace("value='1'", "value='0'", 1) + "\n@", "mass", 1, "`a` weighs 0 kg"),
        (LINKS.replace("ixx='1'", "ixx='9'") + "\n@", "mass", 1, "is none that a body can have"),
        (LINKS + "\n<link name='c'/>@", "tree", 2, "several links hang on nothing: `a`, `c`"),
        (LINKS + "\n@", "joint", 2, "the joint `j` has no range"),
        (LINKS + "<link name='c'>\n<visual/></link>@", "size", 2, "has no geometry"),
    ],
)
def test_model_file_reports_assumptions(
    tmp_path: Path, inside: str, kind: str, line: int, message: str
) -> None:
    text = inside.replace("@", JOINT.format("revolute", "a", "b", ""))
    found = load(tmp_path, f"<robot name='r'>{text}</robot>").findings
    assert any(
        (finding.kind, finding.location.line) == (kind, line) and message in finding.message
        for finding in found
    ), found


SHOWN = "<robot><link name='a'><visual>\n<geometry><mesh filename='{}' scale='2 1 1'/></geometry>"
SHOWN += "</visual></link></robot>"


@pytest.mark.parametrize("home", ["packages/arm/meshes", "meshes", "work/share/arm/meshes"])
@pytest.mark.parametrize("way", ["option", "variable", "above"])
def test_model_file_finds_packages(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, home: str, way: str
) -> None:
    root = tmp_path / "arm" if home == "meshes" else tmp_path / home.split("/", maxsplit=1)[0]
    mesh = (tmp_path / "arm" if home == "meshes" else tmp_path) / home / "p.obj"
    mesh.parent.mkdir(parents=True)
    mesh.write_text((MODELS / "meshes" / "pyramid.obj").read_text())
    model = tmp_path / "elsewhere" / "urdf" / "r.urdf"
    if way == "above":
        inside = {"meshes": "urdf", "packages/arm/meshes": "arm/urdf"}.get(home, "share/arm/urdf")
        model = root / inside / "r.urdf"
    model.parent.mkdir(parents=True)
    model.write_text(SHOWN.format("package://arm/meshes/p.obj"))
    if way == "variable":
        monkeypatch.setenv("ROS_PACKAGE_PATH", f"/nowhere:{root}")
    loaded = load_model(model, [root] if way == "option" else [])
    assert loaded.findings == []
    assert loaded.model.nmesh == 1


def test_model_file_reports_massless_body_and_missing_texture_of_mjcf(tmp_path: Path) -> None:
    text = (
        "<mujoco><asset>\n<texture name='t' type='2d' file='gone.png'/>"
        "<material name='m' texture='t'/></asset><worldbody><body name='b'><joint/>"
        "<geom size='.1' mass='0' material='m'/></body></worldbody></mujoco>"
    )
    loaded = load(tmp_path, text)
    assert [
        (finding.kind, finding.subject, finding.location.line) for finding in loaded.findings
    ] == [
        ("texture", "t", 2),
        ("mass", "b", 0),
    ]
    assert loaded.model.body_mass[1] > 0


def test_model_file_reads_ascii_stl_for_mjcf(tmp_path: Path) -> None:
    """MuJoCo itself reads only binary ones."""
    text = "<mujoco><asset><mesh name='m' file='{}' scale='2 2 3'/></asset><worldbody><geom "
    text += "type='mesh' mesh='m'/></worldbody></mujoco>"
    mesh = MODELS / "arm_description" / "meshes" / "pyramid.stl"
    with pytest.raises(ValueError, match="ASCII"):
        mujoco.MjModel.from_xml_string(text.format(mesh))
    model = load(tmp_path, text.format(mesh)).model
    points = model.mesh_vert @ _matrix(model.geom_quat[0]).T + model.geom_pos[0]
    assert points.min(axis=0) == pytest.approx([-2, -2, 0], abs=1e-6)
    assert points.max(axis=0) == pytest.approx([2, 2, 3], abs=1e-6)


def _matrix(quaternion: np.ndarray) -> np.ndarray:
    result = np.zeros(9)
    mujoco.mju_quat2Mat(result, quaternion)
    return result.reshape(3, 3)


def test_model_file_reports_overlapping_bodies(tmp_path: Path) -> None:
    ball = "<body name='{0}' pos='{1} 0 0'><freejoint/><geom size='.1'/></body>"
    inside = ball.format("a", 0) + ball.format("b", 0.15) + ball.format("c", 0.4)
    found = load(tmp_path, f"<mujoco><worldbody>{inside}</worldbody></mujoco>").findings
    assert [str(finding) for finding in found] == ["`a` and `b` overlap by 50 mm"]
