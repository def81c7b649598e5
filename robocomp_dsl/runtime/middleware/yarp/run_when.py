"""Runs a program when ports of YARP exist: `run_when --timeout 10 /camera:o -- viewer --big`.

In: names of ports, and a command. Out: this process becomes the command; exit code 1 if a port does
not exist in time.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections.abc import Sequence

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.yarp.name_client import (
    NameClient,
    NameServerLost,
    name_server_address,
)

PERIOD_S = 0.2


def missing_ports(names: NameClient, ports: Sequence[str], timeout: float) -> str:
    """Wait until all ports exist; returns what is missing after `timeout` s, else an empty text."""
    deadline = time.monotonic() + timeout
    while True:
        try:
            missing = ", ".join(port for port in ports if names.query(port) is None)
            problem = f"there is no port {missing}" if missing else ""
        except NameServerLost as error:
            problem = f"the name server cannot be reached: {error}"
        if not problem or time.monotonic() >= deadline:
            return problem
        time.sleep(PERIOD_S)


def main(arguments: Sequence[str] | None = None) -> int:
    """Wait, and become the command; returns only if that fails."""
    parser = argparse.ArgumentParser(
        prog="run_when", description="Run a program when ports of YARP exist."
    )
    parser.add_argument("--timeout", type=float, default=10.0, metavar="S", help="default: 10")
    parser.add_argument("--folder", default=".", metavar="DIR", help="run the command there")
    parser.add_argument("ports", nargs="+", metavar="/port")
    words = list(sys.argv[1:] if arguments is None else arguments)
    if "--" not in words or words[-1] == "--":
        parser.error("write `--` and the command after the ports")
    end = words.index("--")
    chosen, command = parser.parse_args(words[:end]), words[end + 1 :]
    try:
        names = NameClient(name_server_address(""))
    except MiddlewareError as error:
        sys.stderr.write(f"error: {error}\n")
        return 1
    if problem := missing_ports(names, chosen.ports, chosen.timeout):
        after = f"after {chosen.timeout:g} s"
        sys.stderr.write(f"error: {problem} {after}; not started: {command[0]}\n")
        return 1
    try:
        os.chdir(chosen.folder)
        os.execvp(command[0], command)  # noqa: S606 - this process becomes the command
    except OSError as error:
        sys.stderr.write(f"error: `{command[0]}` cannot be started: {error}\n")
        return 127


if __name__ == "__main__":
    sys.exit(main())
