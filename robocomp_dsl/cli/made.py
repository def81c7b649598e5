"""A generated component put on the disk, for commands that make one of a world."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.write import CannotWrite, write


def put(folder: Path, files: Sequence[OutputFile], ports: int, then: str) -> None:
    """Write `files` and say so, and what to do `then`; leaves with 1 where that cannot be."""
    try:
        changes = write(folder, files)
    except CannotWrite as error:
        options.complain(str(error))
        sys.exit(FINDINGS)
    written = sum(one.pending for one in changes)
    print(f"{folder}: {written} of {len(changes)} files written; {ports} ports")
    print(f"next: {then}")
