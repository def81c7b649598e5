"""Imports the runtime, then forks into components on request: `python server.py DESCRIPTOR`.

In: requests at the socket DESCRIPTOR (`messages`). Out: child processes that run programs, and
their exit codes. It has one thread, so that a fork is safe, and ends with its socket. Its children
stay: the reaper of the deployment ends them if rcdeploy was killed.
"""

from __future__ import annotations

import gc
import importlib
import os
import signal
import socket
import sys
import warnings
from typing import Any

PRELOADED = (
    "robocomp_dsl.extras",
    "robocomp_dsl.runtime",
    "robocomp_dsl.runtime.component.runner",
    "robocomp_dsl.runtime.entry_point",
    "robocomp_dsl.runtime.middleware.configured",
    "robocomp_dsl.runtime.middleware.zenoh.description",
    "robocomp_dsl.runtime.middleware.zenoh.transport",
    "robocomp_dsl.runtime.parameters.shown",
    "robocomp_dsl.runtime.parameters.yaml_text",
    "robocomp_dsl.runtime.presence.zenoh_presence",
    "robocomp_dsl.runtime.types",
)
"""What every component imports. None of them starts a thread."""


def main() -> None:
    """Serve until the socket is closed."""
    for number in (signal.SIGINT, signal.SIGHUP, signal.SIGQUIT):
        signal.signal(number, signal.SIG_IGN)
    connection = socket.socket(fileno=int(sys.argv[1]))
    connection.set_inheritable(False)
    for name in PRELOADED:
        importlib.import_module(name)
    from robocomp_dsl.runtime.fork_server import messages  # noqa: PLC0415 - its path is set now
    from robocomp_dsl.runtime.fork_server.command_line import set_command_line  # noqa: PLC0415

    if not set_command_line(sys.orig_argv, os.environ):
        return  # rcdeploy starts processes without it
    # The objects so far live as long as the process: the collector would touch, and copy, them all.
    gc.collect()
    gc.freeze()
    tops = sorted({name.partition(".")[0] for name in sys.modules})
    messages.send(connection, {"ready": True, "modules": tops})
    while received := messages.receive(connection):
        request, descriptors = received
        if "reap" in request:
            reply: dict[str, Any] = {"reaped": request["reap"], "code": _reap(request["reap"])}
        else:
            reply = {"started": request["start"], **_start(request, descriptors, connection)}
            messages.close_all(descriptors)
        messages.send(connection, reply)


def _start(
    request: dict[str, Any], descriptors: list[int], connection: socket.socket
) -> dict[str, int]:
    """Fork; `pid` when the child has its session and environment, or `errno`."""
    read_end, write_end = os.pipe()
    try:
        with warnings.catch_warnings():
            # Python 3.12 warns of the threads of numerical libraries, which handle a fork.
            warnings.simplefilter("ignore", DeprecationWarning)
            pid = os.fork()
    except OSError as error:
        os.close(read_end)
        os.close(write_end)
        return {"errno": error.errno or 0}
    if pid == 0:
        connection.detach()  # the child closes the descriptor; it must not be closed twice
        _run_child(request, descriptors, write_end)
    os.close(write_end)
    with open(read_end, "rb") as pipe:  # noqa: PTH123 - a descriptor
        failure = pipe.read()
    if failure:
        os.waitpid(pid, 0)
        return {"errno": int(failure)}
    return {"pid": pid}


def _run_child(request: dict[str, Any], descriptors: list[int], pipe: int) -> None:
    from robocomp_dsl.runtime.fork_server.forked_program import become, run  # noqa: PLC0415

    try:
        become(request, descriptors, pipe)
    except OSError as error:
        os.write(pipe, str(error.errno or 0).encode())
        os._exit(127)
    os.close(pipe)
    run(request["argv"])


def _reap(pid: int) -> int | None:
    """The exit code of a child that has exited, -N after signal N; None if it is unknown."""
    try:
        return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    except ChildProcessError:
        return None


if __name__ == "__main__":
    main()
