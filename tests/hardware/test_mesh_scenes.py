"""Mesh files with scenes: primitives and nodes of `.osg`, `.osgt` and `.3ds`."""

import math
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.hardware.formats.mesh_file import read_surface
from robocomp_dsl.hardware.formats.surface import Surface
from tests.hardware.mesh_files import TRIANGLES, chunk_mesh, geometry, node, three_ds


def surface_of(path: Path, content: bytes | str) -> Surface:
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return read_surface(path)


@pytest.mark.parametrize(
    ("primitive", "triangles"),
    [
        ("DrawArrays TRIANGLES 0 3", {(0, 1, 2)}),
        ("DrawArrays QUADS 0 4", {(0, 1, 2), (0, 2, 3)}),
        ("DrawArrays TRIANGLE_STRIP 0 4", {(0, 1, 2), (2, 1, 3)}),
        ("DrawArrays TRIANGLE_FAN 0 4", {(0, 1, 2), (0, 2, 3)}),
        ("DrawArrays LINES 0 4", set()),
        ("DrawArrayLengths POLYGON 0 1\n{\n4\n}", {(0, 1, 2), (0, 2, 3)}),
        ("DrawElementsUInt QUAD_STRIP 4 { 0 1 2 3 }", {(0, 1, 2), (2, 1, 3)}),
        ("DrawElementsUByte TRIANGLES 6 { 0 0 1 1 2 3 }", {(1, 2, 3)}),
    ],
)
def test_mesh_file_osg_primitives_become_triangles(
    tmp_path: Path, primitive: str, triangles: set[tuple[int, ...]]
) -> None:
    surface = surface_of(tmp_path / "a.osg", geometry(primitive))
    assert {tuple(face) for face in surface.faces.tolist()} == triangles


def test_mesh_file_osg_nodes_place_their_geometry(tmp_path: Path) -> None:
    """Values of OpenSceneGraph 3.6.5 (`osgconv t.osg t.stl`)."""
    matrix = "MatrixTransform {\nMatrix {\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n}\n"
    turned = """PositionAttitudeTransform {
      position 100 0 0
      attitude 0 0 0.7071067811865476 0.7071067811865476
      scale 2 2 2
      pivotPoint 1 0 0
      Use Geode_1
    }"""
    box = "ShapeDrawable {\nBox {\nCenter 0 0 -50\nHalfLengths 1 2 3\n}\n}"
    text = f"Group {{\n{matrix}{geometry(TRIANGLES)}}}\n{turned}\n{box}\n}}"
    points = surface_of(tmp_path / "a.osg", text).points.round(6).tolist()
    assert points[:4] == [[10, 20, 30], [10, 21, 30], [8, 20, 30], [10, 20, 33]]
    assert points[4:8] == [[100, -2, 0], [100, 0, 0], [96, -2, 0], [100, -2, 6]]
    assert np.min(points[8:], axis=0).tolist() == [-1, -2, -53]
    assert np.max(points[8:], axis=0).tolist() == [1, 2, -47]


OSGT = """#Ascii Scene
osg::Group {
  UniqueID 1
  Children 2 {
    osg::MatrixTransform {
      UniqueID 2
      Children 1 {
        osg::Geometry {
          UniqueID 3
          PrimitiveSetList 2 {
            osg::DrawArrays {
              UniqueID 4
              Mode TRIANGLES
              Count 3
            }
            osg::DrawElementsUShort {
              UniqueID 5
              Mode TRIANGLES
              vector 3 {
                0 2 1
              }
            }
          }
          VertexArray TRUE {
            osg::Vec3Array {
              UniqueID 6
              Binding BIND_PER_VERTEX
              vector 3 {
                0 0 0
                1 0 0
                0 2 0
              }
            }
          }
        }
      }
      Matrix {
        1 0 0 0
        0 1 0 0
        0 0 1 0
        0 0 5 1
      }
    }
    osg::Geometry {
      UniqueID 3
    }
  }
}
"""


def test_mesh_file_osgt_nodes_are_shared(tmp_path: Path) -> None:
    surface = surface_of(tmp_path / "a.osgt", OSGT)
    assert surface.faces.tolist() == [[0, 1, 2], [0, 2, 1], [3, 4, 5], [3, 5, 4]]
    assert surface.points[:, 2].tolist() == [5, 5, 5, 0, 0, 0]


def test_mesh_file_3ds_nodes_place_their_object(tmp_path: Path) -> None:
    """The pose in the parent, without the object's own frame; turned clockwise about its axis."""
    frame = np.eye(4)
    frame[:3, 3] = 0, 0, 3
    place = node("a", 1, place=(10, 0, 0), turn=(math.pi / 2, 0, 0, 1), scale=(1, 1, 2))
    child = node("b", 2, parent=1, place=(0, 0, 1), pivot=(0, 2, 0))
    meshes = {"a": chunk_mesh(frame), "b": chunk_mesh(), "c": chunk_mesh()}
    points = surface_of(tmp_path / "a.3ds", three_ds(meshes, place + child)).points.round(5)
    assert points[:4].tolist() == [[10, 0, -6], [10, -1, -6], [12, 0, -6], [10, 0, 0]]
    assert points[4:8].tolist() == [[8, 0, 2], [8, -1, 2], [10, 0, 2], [8, 0, 8]]
    assert points[8:].max(axis=0).tolist() == [1, 2, 3]  # without a node: as stored


def test_mesh_file_3ds_mirrored_object_is_turned_back(tmp_path: Path) -> None:
    meshes = {"a": chunk_mesh(np.diag([-1.0, 1.0, 1.0, 1.0]))}
    points = surface_of(tmp_path / "a.3ds", three_ds(meshes)).points
    assert (points.min(), points[:, 0].min(), points[:, 1].max()) == (-1, -1, 2)
