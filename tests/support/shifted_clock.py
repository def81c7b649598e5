"""A shifted wall clock for processes that load a library with LD_PRELOAD; monotonic clocks stay.

In: a folder, and an offset that may change while the processes run. Out: the environment variables
that the processes need.
"""

from __future__ import annotations

import struct
import subprocess
from pathlib import Path

SOURCE = Path(__file__).with_name("shifted_clock.c")
COMPILER = "cc"
LIBRARY, OFFSET = "clock.so", "clock"
"""Names of the library and of the file with the offset."""


def compile_clock(folder: Path) -> None:
    """Compile the library into `folder`; its clock is not shifted yet."""
    command = (COMPILER, "-O2", "-shared", "-fPIC", "-o", str(folder / LIBRARY), str(SOURCE))
    subprocess.run(command, check=True)
    set_clock_offset(folder, 0.0)


def set_clock_offset(folder: Path, seconds: float) -> None:
    """Shift the clock of the processes at once."""
    path = folder / OFFSET
    with path.open("r+b" if path.exists() else "wb") as file:  # it is mapped: not replaced
        file.write(struct.pack("=q", int(seconds * 1e9)))


def clock_environment(folder: str | Path) -> dict[str, str]:
    """The variables of a process that sees the files in `folder`."""
    return {"LD_PRELOAD": f"{folder}/{LIBRARY}", "CLOCK_OFFSET_FILE": f"{folder}/{OFFSET}"}
