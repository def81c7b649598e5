"""Real editors: their programs, their project folder, and the end of their processes.

In: a command. Out: what it printed. A tool that is missing is a failure where everything was to be
installed (CI), and a reason to skip elsewhere.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NoReturn

import pytest

from tests.support import samples
from tests.support.waiting import wait_until

EDITORS = Path(__file__).parents[2] / "editors"
DEADLINE_S = 90
SERVER = """#!/bin/sh
echo $$ >> '{pids}'
exec '{python}' -c 'from robocomp_dsl.cli.rcgen.main import main; main()' "$@"
"""


class Project:
    """A folder with the samples and a `.venv` that holds a server, which leaves its process id."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.pids = folder / "server.pids"
        samples.write(folder)
        program = folder / ".venv" / "bin" / "rcgen"
        program.parent.mkdir(parents=True)
        program.write_text(SERVER.format(pids=self.pids, python=sys.executable))
        program.chmod(0o755)

    def path(self, name: str) -> Path:
        return self.folder / name

    def assert_no_server_left(self) -> None:
        """Every started server has ended, or ends within the deadline."""
        started = self.pids.read_text().split() if self.pids.exists() else []
        assert started, "no server was started"
        pids = [int(pid) for pid in started]
        wait_until(
            lambda: not any(_alive(pid) for pid in pids),
            lambda: f"servers are left: {[pid for pid in pids if _alive(pid)]}",
            DEADLINE_S,
        )


def run(
    command: Sequence[str | Path],
    folder: Path,
    home: Path,
    env: Mapping[str, str] | None = None,
    deadline: float = DEADLINE_S,
) -> str:
    """What `command` printed, which must succeed in time; its processes end with it."""
    homes = {name: str(home) for name in ("HOME", *_XDG)}
    process = subprocess.Popen(
        [str(part) for part in command],
        cwd=folder,
        env={**os.environ, **homes, **(env or {})},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )
    try:
        out, _ = process.communicate(timeout=deadline)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        out, _ = process.communicate()
        pytest.fail(f"{command[0]} did not end in time:\n{out}")
    assert process.returncode == 0, out
    return out


def need(name: str) -> str:
    """The path of a program; without it the test fails in CI and is skipped otherwise."""
    return shutil.which(name) or missing(name)


def missing(what: str) -> NoReturn:
    """Fail in CI, skip otherwise, because `what` is missing."""
    reason = f"{what} is not installed: `make test-editors` installs what these tests need"
    if os.environ.get("CI"):
        pytest.fail(reason)
    pytest.skip(reason)


_XDG = ("XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME", "XDG_CACHE_HOME")


def _alive(pid: int) -> bool:
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state != "Z"
