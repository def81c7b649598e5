"""Installs environments on a host, without network there.

In: a connection, an environment and its wheels. Out: `environments/HASH` on the host, complete or
not there at all.
"""

from __future__ import annotations

import time
from collections.abc import Sequence

from robocomp_dsl.deploy.content.host_session import HostSession
from robocomp_dsl.deploy.content.lock import Environment
from robocomp_dsl.deploy.content.transfer import (
    Blob,
    CopyResult,
    Progress,
    find_lacking,
    upload_blobs,
)
from robocomp_dsl.deploy.content.wheel_target import WheelTarget
from robocomp_dsl.deploy.content.wheelhouse import Wheelhouse
from robocomp_dsl.deploy.hosts.connection import HostConnection

CHECKED_IMPORTS = ("robocomp_dsl.runtime", "numpy", "yaml", "zenoh")
"""Modules that must load in a new environment: they show a processor or library that is too old."""


async def find_incomplete(
    session: HostSession, environments: Sequence[Environment]
) -> dict[str, str]:
    """The environments that a host lacks, by hash, and why: `missing`, or what is damaged."""
    names = sorted({environment.hash for environment in environments})
    answer = await session.call("find_incomplete", {"environments": names})
    return dict(answer["environments"])


async def install_environment(
    connection: HostConnection,
    root: str,
    environment: Environment,
    python: WheelTarget,
    wheelhouse: Wheelhouse,
    *,
    progress: Progress | None = None,
) -> CopyResult:
    """Copy the wheels that a host lacks, and install the environment there. Raises `HostError`."""
    started = time.monotonic()
    async with HostSession(connection, root, python.path) as session:
        state = await find_lacking(session, (), wheel_blobs(wheelhouse))
        result = await upload_blobs(connection, session, state, progress)
        await session.call(
            "install_environment",
            {
                "name": environment.hash,
                "python": python.path,
                "uv": wheelhouse.uv.sha256,
                "wheels": [(wheel.path.name, wheel.sha256) for wheel in wheelhouse.wheels],
                "requirements": wheelhouse.requirements(),
                "imports": list(CHECKED_IMPORTS),
            },
        )
    result.seconds = time.monotonic() - started
    return result


def wheel_blobs(wheelhouse: Wheelhouse) -> list[Blob]:
    """The wheels as contents of a host."""
    return [Blob(wheel.sha256, wheel.size, str(wheel.path)) for wheel in wheelhouse.all_wheels]
