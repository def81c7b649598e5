"""Meshes that only OpenSceneGraph reads, converted by its program `osgconv` if that is installed.

In: a path of an `.ive` or `.osgb` file, whose binary formats depend on the version of the library.
Out: the bytes of an STL file with all transforms applied, or `MeshError`.
"""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from pathlib import Path

from robocomp_dsl.hardware.formats.surface import MeshError
from robocomp_dsl.regular_file import read_bytes

PROGRAM = "osgconv"
_LONGEST_S = 60.0


def converted_to_stl(path: Path) -> bytes:
    """The mesh at `path` as STL. Raises `MeshError`, also if the program is not installed."""
    program = shutil.which(PROGRAM)
    if program is None:
        raise MeshError(
            f"`{path.suffix}` files need OpenSceneGraph's `{PROGRAM}`"
            " (Debian: apt install openscenegraph); or convert the mesh to .obj"
        )
    with tempfile.TemporaryDirectory() as folder:
        result = Path(folder, "mesh.stl")
        try:
            done = subprocess.run(  # noqa: S603 - a program of the user's path, on the user's file
                [program, str(path.absolute()), str(result)],
                stdin=subprocess.DEVNULL,
                capture_output=True,
                timeout=_LONGEST_S,
                check=False,
            )
        except subprocess.TimeoutExpired:
            raise MeshError(f"`{PROGRAM}` has not converted it in {_LONGEST_S:g} s") from None
        except OSError as error:
            raise MeshError(f"`{PROGRAM}` cannot run: {error.strerror or error}") from None
        if not result.is_file():
            raise MeshError(f"`{PROGRAM}` cannot convert it{_reason(done)}")
        return read_bytes(result)


def _reason(done: subprocess.CompletedProcess[bytes]) -> str:
    lines = (done.stderr + done.stdout).decode("utf-8", "replace").split("\n")
    first = next((line.strip() for line in lines if line.strip()), "")
    return f": {first}" if first else f": exit code {done.returncode}"
