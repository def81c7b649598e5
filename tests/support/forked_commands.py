"""Commands of `rcgen` without the time that Python takes to import what they need.

In: the modules to import. Out: commands that do the same as `rcgen`, each in a process of its own
with its own standard streams, working directory and environment: a fork of one that has imported
the modules already. A language server starts within 50 ms instead of a second.
"""

from __future__ import annotations

import gc
import importlib
import json
import os
import select
import signal
import socket
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

_REQUEST_BYTES = 1 << 20

CONNECT = """\
import json, os, socket, sys
with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as connection:
    connection.connect(sys.argv[1])
    request = {"arguments": sys.argv[2:], "folder": os.getcwd(), "environment": dict(os.environ)}
    socket.send_fds(connection, [json.dumps(request).encode()], [0, 1, 2])
    code = connection.recv(16)
os._exit(int(code or b"1"))
"""
"""Hands its streams over and ends with the exit code of the command."""


@contextmanager
def forked_commands(*modules: str) -> Iterator[list[str]]:
    """The command line prefix that replaces `rcgen`."""
    with tempfile.TemporaryDirectory(prefix="rc-") as folder:  # paths of sockets must be short
        address = str(Path(folder, "fork"))
        command = [sys.executable, "-m", __name__, address, *modules]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
            assert process.stdin is not None
            assert process.stdout is not None
            assert process.stdout.readline() == b"ready\n"
            yield [sys.executable, "-I", "-S", "-c", CONNECT, address]
            process.stdin.close()  # on which it ends
        assert process.returncode == 0


def _serve(address: str) -> None:
    """Fork for each connection until standard input is closed."""
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # the kernel reaps children
    with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as listener:
        listener.bind(address)
        listener.listen()
        gc.freeze()
        sys.stdout.write("ready\n")
        sys.stdout.flush()
        while sys.stdin not in (readable := select.select([listener, sys.stdin], [], [])[0]):
            assert readable
            connection, _ = listener.accept()
            with connection:
                if not os.fork():
                    listener.close()
                    _answer(connection)


def _answer(connection: socket.socket) -> None:
    """Run the command in another fork and send its exit code."""
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    data, streams, _, _ = socket.recv_fds(connection, _REQUEST_BYTES, 3)
    child = os.fork()
    if not child:
        connection.close()
        _run(json.loads(data), streams)
    for stream in streams:
        os.close(stream)
    _, status = os.waitpid(child, 0)
    connection.send(b"%d" % os.waitstatus_to_exitcode(status))
    os._exit(0)


def _run(request: dict[str, object], streams: list[int]) -> None:
    """Run `rcgen` in this process."""
    from robocomp_dsl.cli.rcgen.main import main  # noqa: PLC0415 - imported before the fork

    for number, stream in enumerate(streams):
        os.dup2(stream, number)
        os.close(stream)
    os.chdir(str(request["folder"]))
    os.environ.clear()
    os.environ.update(request["environment"])  # type: ignore[call-overload]
    sys.argv = ["rcgen", *request["arguments"]]  # type: ignore[misc]
    code = 1
    try:
        main()
    except SystemExit as leaving:
        code = leaving.code if isinstance(leaving.code, int) else int(bool(leaving.code))
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)


if __name__ == "__main__":
    for name in ("robocomp_dsl.cli.rcgen.main", *sys.argv[2:]):
        importlib.import_module(name)
    _serve(sys.argv[1])
