"""A real process that is a member of a domain; `python domain_process.py ROOT DOMAIN [NAME]`."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).parents[2]


@contextmanager
def domain_process(domain: str, *arguments: str) -> Iterator[subprocess.Popen[str]]:
    """Run `main` in another process until the end of the block."""
    with subprocess.Popen(
        [sys.executable, __file__, str(ROOT), domain, *arguments],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        try:
            assert process.stdout
            assert process.stdout.readline() == "ready\n"
            yield process
        finally:
            process.kill()


def main(domain: str, name: str = "", mode: str = "") -> None:
    """Open a session with a component `name` that answers `add`, and wait for the end of stdin.

    Mode `fork`: a forked child waits, too; `locked`: while it holds the lock of the folder.
    """
    import contextlib  # noqa: PLC0415
    import os  # noqa: PLC0415

    from robocomp_dsl.runtime.connection.endpoint import Endpoint  # noqa: PLC0415
    from robocomp_dsl.runtime.presence.domain_folder import folder_lock  # noqa: PLC0415
    from robocomp_dsl.runtime.presence.domain_session import open_session  # noqa: PLC0415
    from robocomp_dsl.runtime.presence.keys import record_key  # noqa: PLC0415
    from robocomp_dsl.runtime.presence.port_record import PortRecord  # noqa: PLC0415
    from tests.middleware.probe_types import PROBE  # noqa: PLC0415

    opened = open_session(domain, name=name)
    at = Endpoint(PROBE, name or "anonymous", "Probe")
    record = PortRecord("server", PROBE.name, at.component, at.port, PROBE.hash.hex(), "zenoh")
    key = record_key(domain, record)
    token = opened.session.liveliness().declare_token(key)
    if mode == "fork" and os.fork() == 0:
        os.read(0, 1)
        os._exit(0)
    lock = folder_lock(opened.socket.parent) if mode == "locked" else contextlib.nullcontext()
    with lock:
        sys.stdout.write("ready\n")
        sys.stdout.flush()
        sys.stdin.read()
    del token


if __name__ == "__main__":
    sys.path.insert(0, sys.argv[1])
    main(*sys.argv[2:])
