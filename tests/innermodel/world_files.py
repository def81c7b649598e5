"""Files of a world in a folder, with meshes that worlds refer to."""

from pathlib import Path

CUBE = "".join(f"v {x} {y} {z}\n" for x in (0, 2) for y in (0, 4) for z in (0, 6))
MESHES = {
    "cube.obj": CUBE + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n",
    "flat.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "damaged.obj": "v 1 2\n",
    "points.osg": "VertexArray Vec3Array 2 { 0 0 0 1 2 3 }",
    "letters.stl": "solid a\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 1\nendsolid\n",
}


def place(folder: Path, files: dict[str, str]) -> Path:
    for name, text in (MESHES | files).items():
        (folder / name).write_text(text, encoding="utf-8")
    (folder / "folder").mkdir()
    return folder / "world.xml"
