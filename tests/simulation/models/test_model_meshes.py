"""Meshes of URDF and MJCF files that MuJoCo does not read, and those that nothing reads."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from robocomp_dsl.simulation.models.mesh_marker import marked_meshes
from robocomp_dsl.simulation.models.model_to_transforms import model_transforms
from tests.hardware.mesh_files import TETRAHEDRA
from tests.simulation.models.test_model_file import SHOWN, load
from tests.simulation.models.test_model_file import _matrix as rotation_of

GEOM = mujoco.mjtGeom

HUNG = "<mujoco><asset>\n<mesh name='m' file='{}' scale='2 1 1'/></asset><worldbody>"
HUNG += "<geom type='mesh' mesh='m' pos='0 0 1'/></worldbody></mujoco>"
OSG = "VertexArray Vec3Array 2 { 0 0 0 1 2 3 }"
DAE = """<COLLADA xmlns="c"><asset><unit meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array>0 0 0 100 200 300
</float_array></source><vertices><input semantic="POSITION" source="#p"/></vertices></mesh>
</geometry></library_geometries><library_visual_scenes><visual_scene><node>
<translate>0 0 100</translate><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes></COLLADA>"""


@pytest.mark.parametrize("text", [SHOWN, HUNG], ids=["urdf", "mjcf"])
@pytest.mark.parametrize(
    ("file", "content", "half", "centre"),
    [
        ("a.osg", OSG, (1, 1, 1.5), (1, 1, 1.5)),
        ("a.dae", DAE, (1, 1, 1.5), (1, 1, 2.5)),
    ],
)
def test_model_file_replaces_mesh_without_faces_by_box(
    tmp_path: Path,
    text: str,
    file: str,
    content: str,
    half: object,
    centre: object,
) -> None:
    (tmp_path / file).write_text(content)
    loaded = load(tmp_path, text.format(file))
    assert [(finding.kind, finding.location.line) for finding in loaded.findings] == [("mesh", 2)]
    assert "is its bounding box: its faces are not read" in loaded.findings[0].message
    model = loaded.model
    assert model.geom_type[0] == GEOM.mjGEOM_BOX
    assert model.geom_size[0] == pytest.approx(half)
    lifted = [0, 0, 1] if text is HUNG else [0, 0, 0]
    assert model.geom_pos[0] - lifted == pytest.approx(np.ones(3) * centre)


FALLING = HUNG.replace("<geom", "<body><freejoint/><geom").replace("/></world", "/></body></world")


@pytest.mark.parametrize("text", [SHOWN, HUNG, FALLING], ids=["urdf", "mjcf", "falling"])
@pytest.mark.parametrize(
    ("file", "content", "message"),
    [
        ("gone.stl", None, "is a small marker: No such file"),
        ("a.xyz", "x", "is a small marker: `.xyz` files cannot be read; convert it"),
        ("a.dae", "<COLLADA", "is a small marker: the file is damaged"),
    ],
)
def test_model_file_replaces_unreadable_mesh_by_marker(
    tmp_path: Path, text: str, file: str, content: str | None, message: str
) -> None:
    """It was a box of 20 cm, which collided."""
    if content:
        (tmp_path / file).write_text(content)
    loaded = load(tmp_path, text.format(file))
    assert (loaded.findings[0].kind, loaded.findings[0].location.line) == ("mesh", 2)
    assert message in loaded.findings[0].message
    model = loaded.model
    assert list(marked_meshes(model).values()) == [f"{file} 1"]
    assert model.site_pos[0].tolist() == ([0, 0, 0] if text is SHOWN else [0, 0, 1])
    assert not model.geom_contype.any()
    assert (model.geom_rgba[:, 3] == 0).all()
    assert "missing" not in str(list(model_transforms(model).tree))


@pytest.mark.parametrize("file", ["a.3ds", "a.osg"])
@pytest.mark.parametrize("text", [SHOWN, HUNG], ids=["urdf", "mjcf"])
def test_model_file_reads_meshes_of_openscenegraph(tmp_path: Path, text: str, file: str) -> None:
    (tmp_path / file).write_bytes(TETRAHEDRA[file])
    loaded = load(tmp_path, text.format(file))
    assert loaded.findings == []
    model = loaded.model
    assert (model.ngeom, model.nmesh) == (1, 1)
    points = model.mesh_vert @ rotation_of(model.geom_quat[0]).T + model.geom_pos[0]
    lifted = [0, 0, 1] if text is HUNG else [0, 0, 0]
    assert points.max(axis=0) - lifted == pytest.approx([2, 2, 3])  # the scale is 2 1 1
