"""Meshes with degenerate geometry in worlds and models: one of them does not prevent the rest."""

from pathlib import Path

import mujoco
import pytest

from robocomp_dsl.hardware.description.scene import Frame, Mesh, Scene
from robocomp_dsl.simulation.models.model_file import load_model
from robocomp_dsl.simulation.scene.scene_spec import build_spec

CORNERS = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\n"
NO_AREA = "is its bounding box: its faces have no area"
BOX, MESH = mujoco.mjtGeom.mjGEOM_BOX, mujoco.mjtGeom.mjGEOM_MESH

DEGENERATE = {
    "repeated corner": (CORNERS + "f 1 1 2\nf 2 2 3\n", NO_AREA, BOX, (1, 2, 3)),
    "collinear": (CORNERS + "v 2 0 0\nf 1 2 5\n", NO_AREA, BOX, (2, 2, 3)),
    "one face": (CORNERS + "f 1 2 3\n", "", BOX, (1, 2, 0)),
    "far unused point": (CORNERS + "v 9e5 9e5 9e5\nf 1 2 3\nf 1 2 4\n", "", MESH, (1, 2, 3)),
    "one face without area": (CORNERS + "f 1 2 3\nf 1 2 4\nf 2 2 4\n", "", MESH, (1, 2, 3)),
    "lines": (CORNERS + "f 1 2\n", "its faces are not read", BOX, (1, 2, 3)),
}


@pytest.mark.parametrize("name", DEGENERATE)
def test_scene_mesh_with_degenerate_faces_is_built(tmp_path: Path, name: str) -> None:
    """MuJoCo rejected the whole world: `mesh surface area is too small`."""
    text, message, kind, size = DEGENERATE[name]
    (tmp_path / "m.obj").write_text(text)
    mesh = Mesh("m", "root", str(tmp_path / "m.obj"), scale=(1000, 1000, 1000), collide=True)
    spec, notes = build_spec(Scene((Frame("root", ""),), meshes=(mesh,)))
    assert [message in note for note in notes] == [True] * bool(message)
    model = spec.compile()
    assert model.geom_type.tolist() == [kind]
    assert sorted(2 * model.geom_aabb[0, 3:]) == pytest.approx(sorted(size), rel=0.5, abs=1e-4)


@pytest.mark.parametrize("name", DEGENERATE)
def test_model_mesh_with_degenerate_faces_is_built(tmp_path: Path, name: str) -> None:
    text, message, kind, _ = DEGENERATE[name]
    (tmp_path / "m.obj").write_text(text)
    (tmp_path / "r.urdf").write_text(
        "<robot name='r'><link name='a'><visual><geometry><mesh filename='m.obj'/></geometry>"
        "</visual></link></robot>"
    )
    loaded = load_model(tmp_path / "r.urdf")
    assert [message in note.message for note in loaded.findings] == [True] * bool(message)
    assert loaded.model.geom_type.tolist() == [kind]


def test_model_mesh_of_impossible_scale_is_marker(tmp_path: Path) -> None:
    (tmp_path / "m.obj").write_text(CORNERS + "f 1 2 3\nf 1 2 4\n")
    (tmp_path / "r.urdf").write_text(
        "<robot name='r'><link name='a'><visual><geometry><mesh filename='m.obj' scale='1e300 1 1'"
        "/></geometry></visual></link></robot>"
    )
    loaded = load_model(tmp_path / "r.urdf")
    assert "is a small marker: no world holds it with the scale 1e+300" in str(loaded.findings[0])
    assert (loaded.model.ngeom, loaded.model.nsite) == (0, 1)
