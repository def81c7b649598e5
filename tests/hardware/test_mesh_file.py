import struct
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.hardware.formats.mesh_file import MeshError, read_mesh

OBJ = """\
# a corner
v 0 0 0
v 10 0 0
v 0 20 0
v 0 0 30
f 1/1 3/2 2/3
f 1//1 2//1 4//1 3//1
f -4 -1 -2
"""
STL = """\
solid corner
 facet normal 0 0 -1
  outer loop
   vertex 0 0 0
   vertex 0 20 0
   vertex 10 0 0
  endloop
 endfacet
endsolid
"""
OSG = """\
Geode {
  Geometry {
    VertexArray Vec3Array 2
    {
      -1 -2 -3
      4 5 6
    }
  }
}
"""


def chunk(kind: int, content: bytes) -> bytes:
    return struct.pack("<HI", kind, 6 + len(content)) + content


POINTS = struct.pack("<H6f", 2, -1, -2, -3, 4, 5, 6)
THREE_DS = chunk(
    0x4D4D, chunk(0x3D3D, chunk(0x4000, b"Box\0" + chunk(0x4100, chunk(0x4110, POINTS))))
)


def binary_stl() -> bytes:
    triangle = struct.pack("<12fH", 0, 0, -1, 0, 0, 0, 0, 20, 0, 10, 0, 0, 0)
    return bytes(80) + struct.pack("<I", 1) + triangle


@pytest.mark.parametrize(
    ("name", "content", "corner", "faces"),
    [
        # an OBJ file has y up, which the viewer makes z, which is then mirrored: y = -z, z = -y
        ("a.obj", OBJ.encode(), (10, -30, -20), 4),
        ("a.STL", STL.encode(), (10, 20, 0), 1),
        ("b.stl", binary_stl(), (10, 20, 0), 1),
        ("a.osg", OSG.encode(), (4, 5, -6), 0),
        ("a.3ds", THREE_DS, (4, 5, -6), 0),
    ],
)
def test_mesh_file_has_points_and_faces(
    tmp_path: Path, name: str, content: bytes, corner: tuple[float, ...], faces: int
) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    surface = read_mesh(path)
    extremes = surface.points[np.abs(surface.points).argmax(axis=0), [0, 1, 2]]
    assert extremes == pytest.approx(corner)
    assert surface.faces.shape == (faces, 3)
    if faces:
        assert surface.faces.max() < len(surface.points)


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("a.ive", b"", "`.ive` files cannot be read; convert it to .obj or .stl"),
        ("mesh", b"", "its suffix names no supported format"),
        ("gone.obj", None, "No such file"),
        ("a.obj", b"v 1 2\n", "the file is damaged"),
        ("a.obj", b"v 0 0 0\nf 1 2 3\n", "the file is damaged (a face names a point that is not"),
        ("a.obj", b"", "the file has no points"),
        ("a.obj", b"v nan 0 0", "a point is NaN"),
        ("a.stl", b"\0" * 60, "the file has no points"),
        ("a.3ds", THREE_DS[:-8], "the file is damaged"),
        ("a.osg", b"VertexArray { 1 2 }", "the file is damaged"),
    ],
)
def test_mesh_file_with_faults_is_reported(
    tmp_path: Path, name: str, content: bytes | None, message: str
) -> None:
    path = tmp_path / name
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(MeshError) as error:
        read_mesh(path)
    assert message in str(error.value)
