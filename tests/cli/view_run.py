"""`rcgen view` as a program."""

import os
import subprocess
import sys
from dataclasses import dataclass


@dataclass(frozen=True)
class Result:
    code: int
    out: str
    err: str


def view(*arguments: str) -> Result:
    """Run it to its end, in the current folder."""
    start = "from robocomp_dsl.cli.rcgen.main import main; main()"
    process = subprocess.run(
        [sys.executable, "-c", start, "view", *arguments],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
        env=os.environ | {"COLUMNS": "100", "NO_COLOR": "1"},
    )
    return Result(process.returncode, process.stdout, process.stderr)
