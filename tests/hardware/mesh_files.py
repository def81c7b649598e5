"""Mesh files of OpenSceneGraph and Autodesk 3D Studio, written byte by byte."""

import struct

import numpy as np

POINTS = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 2.0, 0.0), (0.0, 0.0, 3.0)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


def chunk(kind: int, content: bytes) -> bytes:
    """A chunk of a `.3ds` file."""
    return struct.pack("<HI", kind, 6 + len(content)) + content


def chunk_mesh(frame: np.ndarray | None = None) -> bytes:
    """The chunk of a tetrahedron with its own frame (4, 4)."""
    points = struct.pack("<H12f", 4, *(value for point in POINTS for value in point))
    faces = struct.pack("<H16H", 4, *(value for face in FACES for value in (*face, 7)))
    parts = chunk(0x4110, points) + chunk(0x4120, faces)
    if frame is not None:
        parts += chunk(0x4160, struct.pack("<12f", *frame[:3].T.ravel()))
    return chunk(0x4100, parts)


def three_ds(objects: dict[str, bytes], nodes: bytes = b"") -> bytes:
    """A `.3ds` file of named objects."""
    named = (chunk(0x4000, name.encode() + b"\0" + mesh) for name, mesh in objects.items())
    keyframes = chunk(0xB000, nodes) if nodes else b""
    return chunk(0x4D4D, chunk(0x3D3D, b"".join(named)) + keyframes)


def node(
    name: str,
    number: int,
    *,
    parent: int = 0xFFFF,
    place: tuple[float, ...] = (0, 0, 0),
    turn: tuple[float, ...] = (0, 0, 0, 1),
    scale: tuple[float, ...] = (1, 1, 1),
    pivot: tuple[float, ...] = (0, 0, 0),
) -> bytes:
    """The place of an object: `turn` is an angle and an axis."""

    def track(kind: int, values: tuple[float, ...]) -> bytes:
        head = struct.pack("<HIII", 0, 0, 0, 1) + struct.pack("<IH", 0, 1)  # one key, one spline
        return chunk(kind, head + struct.pack(f"<f{len(values)}f", 0.5, *values))

    head = name.encode() + b"\0" + struct.pack("<HHH", 0, 0, parent)
    parts = chunk(0xB030, struct.pack("<H", number)) + chunk(0xB010, head)
    parts += chunk(0xB013, struct.pack("<3f", *pivot))
    return chunk(0xB002, parts + track(0xB020, place) + track(0xB021, turn) + track(0xB022, scale))


def geometry(primitives: str, points: str = "") -> str:
    """A geometry of an `.osg` file."""
    rows = points or "\n".join(" ".join(map(str, point)) for point in POINTS)
    return f"""Geode {{
  UniqueID Geode_1
  Geometry {{
    PrimitiveSets 1
    {{
      {primitives}
    }}
    VertexArray UniqueID Vec3Array_2 Vec3Array 4
    {{
      {rows}
    }}
    NormalArray Vec3Array 1 {{ 9 9 9 }}
  }}
}}
"""


TRIANGLES = "DrawElementsUShort TRIANGLES 12\n{\n0 2 1 0 1 3\n0 3 2 1 2 3\n}"
TETRAHEDRA = {"a.3ds": three_ds({"Box": chunk_mesh()}), "a.osg": geometry(TRIANGLES).encode()}
"""The tetrahedron in both formats."""
