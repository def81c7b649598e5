"""The MuJoCo model and the transform tree of one scene are the same geometry."""

import mujoco
import numpy as np
import pytest

from robocomp_dsl.hardware.description.scene import Box, Device, Frame, Mesh, Motion, Scene
from robocomp_dsl.hardware.devices.errors import SceneError
from robocomp_dsl.hardware.kinematics.transforms import TransformTree
from robocomp_dsl.simulation.models.mesh_marker import marked_meshes
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.simulation.scene.scene_shapes import rotation_to_normal
from robocomp_dsl.simulation.scene.scene_spec import build_spec
from robocomp_dsl.simulation.world.simulation import Simulation

ROOT = Frame("root", "")


def random_scene(seed: int, count: int) -> Scene:
    random = np.random.default_rng(seed)
    frames = [ROOT]
    for i in range(count):
        parent = frames[int(random.integers(max(0, i - 6), len(frames)))].id
        place = tuple(random.uniform(-300, 300, 3).tolist())
        turn = tuple(random.uniform(-3, 3, 3).tolist())
        axis = "xyz"[int(random.integers(3))]
        motion = None
        match i % 3:
            case 1:
                motion = Motion("hinge", axis, -3, 3)  # type: ignore[arg-type]
            case 2:
                motion = Motion("slide", axis, -500, 500, offset=12.5)  # type: ignore[arg-type]
                turn = (0.0, 0.0, 0.0)
        frames.append(Frame(f"f{i}", parent, place, turn, motion))
    return Scene(tuple(frames))


@pytest.mark.parametrize("seed", range(4))
def test_scene_spec_bodies_match_transform_tree(seed: int) -> None:
    scene = random_scene(seed, 60)
    spec, notes = build_spec(scene)
    model = spec.compile()
    data = mujoco.MjData(model)
    tree = TransformTree(scene.frames)
    random = np.random.default_rng(seed)
    assert notes == []
    for move in range(4):
        for frame in scene.frames:
            if move and frame.motion:
                hinge = frame.motion.kind == "hinge"
                value = float(random.uniform(-2, 2)) * (1 if hinge else 100)
                tree.set_joint(frame.id, value)
                joint = model.joint(frame.id)
                data.qpos[joint.qposadr[0]] = value if hinge else value * axes.MM
        mujoco.mj_kinematics(model, data)
        for frame in scene.frames[1:]:
            body = model.body(frame.id).id
            found = axes.matrix(data.xpos[body], data.xmat[body])
            assert found[:3, :3] == pytest.approx(tree.matrix(frame.id, "root")[:3, :3], abs=1e-9)
            assert found[:3, 3] == pytest.approx(tree.matrix(frame.id, "root")[:3, 3], abs=1e-6)


def test_scene_spec_joint_has_limits_and_start_value() -> None:
    hinge = Frame("h", "root", turn=(0, 0.5, 0), motion=Motion("hinge", "y", -1.0, 2.0))
    slide = Frame("s", "h", (0, 0, 40), motion=Motion("slide", "z", 0, 300, offset=15))
    free = Frame("f", "s", motion=Motion("hinge", "z"))
    model = build_spec(Scene((ROOT, hinge, slide, free)))[0].compile()
    assert model.joint("h").range == pytest.approx([-1, 2])
    assert model.joint("s").range == pytest.approx([0, 0.3])
    assert not model.joint("f").limited[0]
    assert model.qpos0 == pytest.approx([0.5, 0.025, 0])


def test_scene_spec_base_drives_on_floor() -> None:
    base = Frame("robot", "root", (1000, 0, 0), drives=True)
    model = build_spec(Scene((ROOT, base)))[0].compile()
    data = mujoco.MjData(model)
    for name, value in (("x", 0.5), ("z", 0.25), ("alpha", 0.3)):
        data.joint(f"robot.{name}").qpos = value
    mujoco.mj_kinematics(model, data)
    body = model.body("robot").id
    pose = axes.pose(data.xpos[body], data.xmat[body])
    assert (pose.x, pose.z, pose.alpha) == pytest.approx((1500, 250, 0.3))
    for _ in range(100):
        mujoco.mj_step(model, data)
    assert data.xpos[body, 2] == pytest.approx(0)  # nothing pulls it through the floor


@pytest.mark.parametrize(
    "normal", [(0, 0, -1), (0, 0, 1), (1, 0, 0), (0, -1, 0), (1, 2, 3), (0, 0, 5), (1e-9, 0, 1)]
)
def test_scene_spec_plane_stands_along_normal(normal: tuple[float, float, float]) -> None:
    turned = rotation_to_normal(normal)
    assert turned @ [0, 0, -1] == pytest.approx(np.array(normal) / np.linalg.norm(normal), abs=1e-6)
    assert turned @ turned.T == pytest.approx(np.eye(3), abs=1e-9)
    assert np.linalg.det(turned) == pytest.approx(1)


def test_scene_spec_boxes_have_size_along_axes() -> None:
    floor = Box("floor", "root", (4000, 3000, 10), (0, -5, 0), (0, 1, 0), "#102030", collide=True)
    upright = Box("wall", "root", (4000, 2500, 100), (0, 1250, 2000))
    model = build_spec(Scene((ROOT,), (floor, upright)))[0].compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    extents = {}
    for name in ("floor", "wall"):
        geom = model.geom(name).id
        half = np.abs(data.geom_xmat[geom].reshape(3, 3)) @ model.geom_size[geom]
        extents[name] = [*data.geom_xpos[geom], *(2 * half)]
    assert extents["floor"] == pytest.approx([0, 0, -0.005, 4, 3, 0.01], abs=1e-9)
    assert extents["wall"] == pytest.approx([0, 2, 1.25, 4, 0.1, 2.5], abs=1e-9)
    assert model.geom("floor").rgba == pytest.approx([0x10 / 255, 0x20 / 255, 0x30 / 255, 1])
    assert model.geom("floor").contype[0] == 1
    assert model.geom("wall").contype[0] == 0


def cube(tmp_path) -> str:  # type: ignore[no-untyped-def]
    corners = [(x, y, z) for x in (0, 2) for y in (0, 4) for z in (0, 6)]
    faces = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"]
    lines = [f"v {x} {y} {z}" for x, y, z in corners] + [f"f {face}" for face in faces]
    path = tmp_path / "cube.obj"
    path.write_text("\n".join(lines))
    return str(path)


def test_scene_spec_mesh_is_placed_like_in_viewer(tmp_path) -> None:  # type: ignore[no-untyped-def]
    mesh = Mesh("m", "root", cube(tmp_path), (100, 200, 300), scale=(10, 10, 20))
    spec, notes = build_spec(Scene((ROOT,), meshes=(mesh,)))
    assert notes == []
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    points = model.mesh_vert @ data.geom_xmat[0].reshape(3, 3).T + data.geom_xpos[0]
    # x 0..2, y -6..0, z -4..0 of the file, scaled by (10, 10, 20), in mm
    assert points.min(axis=0) == pytest.approx([0.1, 0.3 - 0.08, 0.2 - 0.06], abs=1e-6)
    assert points.max(axis=0) == pytest.approx([0.12, 0.3, 0.2], abs=1e-6)


def test_scene_spec_replaces_mesh_without_faces_by_box(tmp_path) -> None:  # type: ignore[no-untyped-def]
    path = tmp_path / "a.osg"
    path.write_text("VertexArray Vec3Array 2 { 0 0 0 1 2 3 }")
    mesh = Mesh("m", "root", str(path), scale=(100, 100, 100), collide=True)
    spec, notes = build_spec(Scene((ROOT,), meshes=(mesh,)))
    assert notes == ["the mesh `m` (a.osg) is its bounding box: its faces are not read; use .obj"]
    model = spec.compile()
    assert model.geom("m").type[0] == mujoco.mjtGeom.mjGEOM_BOX
    assert model.geom("m").size == pytest.approx([0.05, 0.15, 0.1])
    assert model.geom("m").pos == pytest.approx([0.05, -0.15, 0.1])


@pytest.mark.parametrize(
    ("file", "note"),
    [
        ("gone.obj", ""),  # the search for files reports it
        ("a.xyz", "the mesh `m` (a.xyz) is a small marker: `.xyz` files cannot be read; convert"),
        ("a.obj", "the mesh `m` (a.obj) is a small marker: the file has no points"),
    ],
)
def test_scene_spec_replaces_unreadable_mesh_by_marker(  # type: ignore[no-untyped-def]
    tmp_path, file: str, note: str
) -> None:
    """It was a box of 1 m: its scale in mm."""
    if note:
        (tmp_path / file).write_text("x")
    place = Frame("f", "root", (0, 500, 0))
    mesh = Mesh("m", "f", str(tmp_path / file), (100, 0, 0), scale=(1000, 1000, 1000), collide=True)
    spec, notes = build_spec(Scene((ROOT, place), meshes=(mesh,)))
    assert [text.startswith(note) for text in notes] == [True] * bool(note)
    model = spec.compile()
    assert marked_meshes(model) == {0: "m"}
    assert (model.ngeom, model.nsite) == (0, 1)
    assert model.site_pos[0] == pytest.approx([0.1, 0, 0])
    assert model.site_size[0] == pytest.approx([0.01] * 3)


def test_scene_spec_has_one_note_for_meshes_with_the_same_problem(tmp_path) -> None:  # type: ignore[no-untyped-def]
    files = [tmp_path / f"{i}.xyz" for i in range(9)]
    for file in files:
        file.write_text("x")
    meshes = tuple(Mesh(f"m{i}", "root", str(files[i % 9])) for i in range(40))
    _, notes = build_spec(Scene((ROOT,), meshes=meshes))
    assert len(notes) == 1
    assert notes[0].startswith(
        "9 meshes, `m0` (0.xyz), `m1` (1.xyz), `m2` (2.xyz), `m3` (3.xyz) and 5 more, are each a"
    )


def test_scene_spec_marker_is_not_seen_by_laser() -> None:
    """The box that stood for a mesh was."""
    laser = Device("l", "laser", "root", {"measures": 9, "angle": 1.0, "min": 10, "max": 4000})
    mesh = Mesh("m", "root", "gone.obj", (0, 0, 1000), scale=(1000, 1000, 1000))
    simulation = Simulation(Scene((ROOT,), meshes=(mesh,), devices=(laser,)))
    assert set(simulation.devices["l"].scan().distances) == {4000.0}


def test_scene_spec_builds_flat_mesh_and_flat_plane(tmp_path) -> None:  # type: ignore[no-untyped-def]
    path = tmp_path / "flat.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n")
    shapes = Scene(
        (ROOT,),
        (
            Box("p", "root", (0, float("nan"), float("inf"))),
            Box("c", "root", (1, 1, 1), colour="#x"),
        ),
        (Mesh("m", "root", str(path)),),
    )
    spec, notes = build_spec(shapes)
    assert spec.compile().ngeom == 3
    assert [note.split(":")[0] for note in notes] == [
        "`p` has no size that can be built",
        "`c` is grey",
    ]


def test_scene_spec_refuses_frame_before_its_parent() -> None:
    with pytest.raises(SceneError, match="`a` is in `b`, which is not a frame before it"):
        build_spec(Scene((ROOT, Frame("a", "b"), Frame("b", "root"))))


def test_scene_spec_body_with_physics_falls_and_others_stay() -> None:
    ball = Frame("ball", "root", (0, 1000, 0), physics=True, mass=2.0)
    lamp = Frame("lamp", "root", (500, 1000, 0), mass=2.0, motion=Motion("slide", "y"))
    model = build_spec(Scene((ROOT, ball, lamp)))[0].compile()
    data = mujoco.MjData(model)
    for _ in range(50):
        mujoco.mj_step(model, data)
    assert model.body("ball").mass == pytest.approx(2.0)
    assert data.body("ball").xpos[2] < 0.99
    assert data.body("lamp").xpos[2] == pytest.approx(1.0)


def test_scene_spec_texture_leaves_plane_in_place(tmp_path) -> None:  # type: ignore[no-untyped-def]
    from PIL import Image  # noqa: PLC0415

    picture = Image.new("RGB", (16, 16), (10, 10, 240))
    picture.paste((200, 100, 50), (0, 8, 16, 16))  # below
    picture.save(tmp_path / "a.jpg", quality=95, subsampling=0)
    (tmp_path / "no.jpg").write_text("x")
    extents, materials = [], []
    normals = [(0, 1, 0), (0, 0, -1), (1, 2, 3), (0, 0, 1)]
    for file in ("", "a.jpg"):
        texture = str(tmp_path / file) if file else ""
        boxes = tuple(
            Box(f"b{i}", "root", (4000, 3000, 10), (1, 2, 3), normal, texture=texture, tile=500)
            for i, normal in enumerate(normals)
        )
        spec, notes = build_spec(Scene((ROOT,), boxes))
        assert notes == []
        model = spec.compile()
        data = mujoco.MjData(model)
        mujoco.mj_kinematics(model, data)
        corners = data.geom_xmat.reshape(-1, 3, 3) * model.geom_size[:, None, :]
        extents.append(np.abs(corners).sum(axis=2))
        materials.append(model.geom_matid.tolist())
    assert extents[0] == pytest.approx(extents[1], abs=1e-9)
    assert materials == [[-1] * 4, [0] * 4]
    assert model.mat_texrepeat[0] == pytest.approx([2, 2])
    assert model.tex_data[:3] == pytest.approx([200, 100, 50], abs=6)  # MuJoCo begins below
    for name, messages in (("gone.png", []), ("no.jpg", ["it is no picture"])):
        box = Box("b", "root", (1, 1, 1), texture=str(tmp_path / name))
        _, notes = build_spec(Scene((ROOT,), (box,)))
        assert [note.rpartition(": ")[2] for note in notes] == messages


def test_scene_spec_notes_falling_body_without_mass() -> None:
    _, notes = build_spec(Scene((ROOT, Frame("f", "root", physics=True))))
    assert notes == ["`f` falls and has no mass: it gets 0.001 kg"]


@pytest.mark.parametrize("scale", [(float("inf"), 1, 1), (1e300, 1, 1), (float("nan"), 1, 1)])
def test_scene_spec_replaces_mesh_of_invalid_scale_by_marker(tmp_path, scale) -> None:  # type: ignore[no-untyped-def]
    mesh = Mesh("m", "root", cube(tmp_path), scale=scale)
    spec, notes = build_spec(Scene((ROOT,), meshes=(mesh,)))
    assert "is a small marker: no world holds it with the scale" in notes[0]
    assert marked_meshes(spec.compile()) == {0: "m"}
