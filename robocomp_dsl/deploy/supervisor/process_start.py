"""Starts processes: each by executing its program, or by forking a process that has imported it.

In: a `Process` of the plan and its environment. Out: a `StartedProcess` in a session of its own,
with pipes for its output.
"""

from __future__ import annotations

import os
import subprocess
from collections.abc import Mapping
from typing import IO, Protocol

from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.deploy.supervisor.notify import FOREIGN_VARIABLES
from robocomp_dsl.deploy.supervisor.reaper import DEPLOYMENT_VARIABLE
from robocomp_dsl.deploy.supervisor.scheduling import with_scheduling
from robocomp_dsl.runtime.component.supervisor_pipe import HEARTBEAT_VARIABLE


class StartedProcess(Protocol):
    """A process that was started; `stdout` and `stderr` are the reading ends of its pipes."""

    pid: int
    stdout: IO[bytes]
    stderr: IO[bytes]

    async def exit_code(self) -> int:
        """The exit code of the process, which has exited; -N: signal N ended it."""


class ProcessStarter(Protocol):
    """Starts processes."""

    async def start(
        self, process: Process, environment: Mapping[str, str], heartbeat: int
    ) -> StartedProcess:
        """Start a process with exactly `environment`; it inherits the descriptor `heartbeat`.

        Raises `OSError` if it cannot be started.
        """

    def close(self) -> None:
        """Start no more processes."""


class ExecutedProcess:
    """A child process that executes its program. Raises `OSError` if that is not possible."""

    def __init__(self, process: Process, environment: Mapping[str, str], heartbeat: int) -> None:
        variables = {**environment, HEARTBEAT_VARIABLE: str(heartbeat)}
        self._popen = with_scheduling(process.limits, lambda: _execute(process, variables))
        assert self._popen.stdout is not None  # noqa: S101 - both are pipes
        assert self._popen.stderr is not None  # noqa: S101
        self.pid = self._popen.pid
        self.stdout, self.stderr = self._popen.stdout, self._popen.stderr

    async def exit_code(self) -> int:
        """See `StartedProcess`."""
        return self._popen.wait()


def _execute(process: Process, environment: Mapping[str, str]) -> subprocess.Popen[bytes]:
    return subprocess.Popen(  # noqa: S603 - the command line is the user's own
        process.argv,
        cwd=process.cwd,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
        pass_fds=(int(environment[HEARTBEAT_VARIABLE]),),
    )


class ExecutingStarter:
    """A `ProcessStarter` that executes every program."""

    async def start(
        self, process: Process, environment: Mapping[str, str], heartbeat: int
    ) -> StartedProcess:
        """See `ProcessStarter`."""
        return ExecutedProcess(process, environment, heartbeat)

    def close(self) -> None:
        """See `ProcessStarter`."""


def process_environment(
    process: Process, variables: Mapping[str, str], token: str
) -> dict[str, str]:
    """The environment of a process of the deployment `token`; `variables` are the supervisor's."""
    return {
        "PYTHONUNBUFFERED": "1",
        **{k: v for k, v in os.environ.items() if k not in FOREIGN_VARIABLES},
        **variables,
        **dict(process.env),
        DEPLOYMENT_VARIABLE: token,
    }
