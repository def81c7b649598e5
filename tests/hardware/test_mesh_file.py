import shutil
import struct
import subprocess
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.hardware.formats import osgconv
from robocomp_dsl.hardware.formats.mesh_file import read_mesh, read_surface
from robocomp_dsl.hardware.formats.surface import MeshError
from tests.hardware.mesh_files import (
    TETRAHEDRA,
    TRIANGLES,
    chunk,
    chunk_mesh,
    geometry,
    node,
    three_ds,
)
from tests.hardware.test_mesh_scenes import surface_of

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


POINTS_ONLY = struct.pack("<H6f", 2, -1, -2, -3, 4, 5, 6)
THREE_DS = three_ds({"Box": chunk(0x4100, chunk(0x4110, POINTS_ONLY))})
PLY = """\
ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
10 0 0
0 20 0
3 0 1 2
"""


LOOP = "Group {\nUniqueID G\nUse G\n}"


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
        ("b.3ds", TETRAHEDRA["a.3ds"], (1, 2, -3), 4),
        ("b.osg", TETRAHEDRA["a.osg"], (1, 2, -3), 4),
        ("a.ply", PLY.encode(), (10, 20, 0), 1),
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
        ("a.xyz", b"", "`.xyz` files cannot be read; convert it to .obj or .stl"),
        ("mesh", b"", "its suffix names no supported format"),
        ("gone.obj", None, "No such file"),
        ("a.obj", b"v 1 2\n", "the file is damaged"),
        ("a.obj", b"v 0 0 0\nf 1 2 3\n", "the file is damaged (a face names a point that is not"),
        ("a.obj", b"", "the file has no points"),
        ("a.obj", b"v nan 0 0", "a point is NaN"),
        ("a.stl", b"\0" * 60, "the file has no points"),
        ("a.3ds", THREE_DS[:-8], "the file is damaged"),
        ("a.osg", b"VertexArray { 1 2 }", "the file is damaged"),
        ("a.osg", b"Group {", "the file is damaged (its end is missing)"),
        ("a.osg", b"Group { } }", "the file is damaged (its braces do not match)"),
        ("a.osg", b"A {\n" * 300, "the file is damaged (it is nested too deep)"),
        ("a.osg", LOOP.encode(), "the file is damaged (its nodes refer to each other)"),
        ("a.osg", geometry("DrawArrays TRIANGLES 0 9").encode(), "a face names a point that is"),
        ("a.osg", geometry("DrawArrays TRIANGLES 0 -9").encode(), "a primitive of -9 points"),
        ("a.3ds", b"BM" + bytes(50), "it does not begin as a .3ds file"),
        ("a.3ds", three_ds({"a": chunk_mesh()}, node("a", 1, parent=1)), "their own parents"),
        ("a.3ds", three_ds({"a": chunk_mesh(np.zeros((4, 4)))}, node("a", 1)), "has no volume"),
        ("a.ply", b"ply\nformat ascii 1.0\nend_header\n", "the file"),
        ("a.ply", b"nothing", "the file is damaged"),
        ("a.obj", b"version https://git-lfs.github.com/spec/v1\noid x", "run `git lfs pull`"),
        ("a.ive", b"/annex/objects/SHA256E-s2--b.ive\n", "run `git annex get`"),
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


CONVERTERS = {
    "cp": ('#!/bin/sh\nprintf \'%s\' "$(cat "$1")" > "$2"\n', ""),
    "silent": ("#!/bin/sh\nexit 3\n", "`osgconv` cannot convert it: exit code 3"),
    "told": ("#!/bin/sh\necho\necho no plugin >&2\n", "cannot convert it: no plugin"),
}


@pytest.mark.parametrize("kind", CONVERTERS)
def test_mesh_file_ive_is_converted_by_program(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str
) -> None:
    script, message = CONVERTERS[kind]
    program = tmp_path / "osgconv"
    program.write_text(script)
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/bin:/usr/bin")
    path = tmp_path / "a.IVE"
    if not message:
        assert surface_of(path, STL).faces.shape == (1, 3)
        return
    with pytest.raises(MeshError) as error:
        surface_of(path, b"x")
    assert message in str(error.value)


def test_mesh_file_ive_names_missing_program(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(MeshError, match=r"`\.ive` files need OpenSceneGraph's `osgconv` \(Debian"):
        surface_of(tmp_path / "a.ive", b"x")


def test_mesh_file_is_read_again_after_change(tmp_path: Path) -> None:
    assert len(surface_of(tmp_path / "a.obj", OBJ).points) == 4
    assert len(surface_of(tmp_path / "a.obj", "v 1 2 3\n").points) == 1


@pytest.mark.skipif(shutil.which(osgconv.PROGRAM) is None, reason="needs OpenSceneGraph")
@pytest.mark.parametrize("suffix", ["ive", "3ds", "osgt", "osgb", "osg"])
def test_mesh_file_agrees_with_openscenegraph(tmp_path: Path, suffix: str) -> None:
    source, result = tmp_path / "a.osg", tmp_path / f"b.{suffix}"
    matrix = "MatrixTransform {\nMatrix {\n0 2 0 0\n-2 0 0 0\n0 0 2 0\n1 2 3 1\n}\n"
    source.write_text(f"{matrix}{geometry(TRIANGLES)}}}")
    subprocess.run([osgconv.PROGRAM, source, result], check=True, capture_output=True)
    expected, found = read_surface(source), read_surface(result)
    assert found.faces.shape == expected.faces.shape
    corners = (found.points.min(axis=0), found.points.max(axis=0))
    assert corners[0] == pytest.approx(expected.points.min(axis=0), abs=1e-5)
    assert corners[1] == pytest.approx(expected.points.max(axis=0), abs=1e-5)
