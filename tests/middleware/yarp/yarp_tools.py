"""The programs of a real YARP 3.5, if it is installed."""

from __future__ import annotations

import os
import socket
import subprocess
from pathlib import Path

import pytest

from robocomp_dsl.runtime.middleware.yarp.addresses import PortAddress
from robocomp_dsl.runtime.middleware.yarp.name_client import NameClient, NameServerLost
from tests.middleware.yarp.conftest import LOOPBACK

VENV = Path(__file__).parents[3] / "build" / "yarp-venv"
INSTALLED = (VENV / "bin" / "yarpserver").exists()
needs_yarp = pytest.mark.skipif(
    not INSTALLED, reason="needs YARP 3.5 (Python 3.9): `make test-peers` installs it"
)
needs_thrift_peer = pytest.mark.skipif(
    not (VENV / "bin" / "demo_peer").exists(),
    reason="needs YARP 3.5 and g++: `make test-peers` builds the Thrift peer",
)
TIMEOUT_S = 120.0


def free_port() -> int:
    """A TCP port of loopback that nothing uses."""
    with socket.socket() as probe:
        probe.bind((LOOPBACK, 0))
        port: int = probe.getsockname()[1]
        return port


def binary(name: str) -> str:
    """The program itself; the script beside it would not pass signals on."""
    found = list(VENV.glob(f"lib/python3.9/site-packages/yarp/bin/{name}"))
    return str(found[0] if found else VENV / "bin" / name)


class Tools:
    """Runs programs of YARP with one name server."""

    def __init__(self, home: Path, number: int) -> None:
        self.number = number
        (home / "yarp.conf").write_text(f"{LOOPBACK} {number} yarp\n")
        self.environment = {**os.environ, "YARP_CONFIG_HOME": str(home)}
        self.environment.pop("YARP_NAMESPACE", None)
        self._started: list[subprocess.Popen[str]] = []

    def run(self, *arguments: str, text: str = "") -> subprocess.CompletedProcess[str]:
        """Run `yarp …` until it ends; `text` is its standard input."""
        return subprocess.run(
            [binary("yarp"), *arguments],
            input=text,
            env=self.environment,
            capture_output=True,
            text=True,
            timeout=TIMEOUT_S,
            check=False,
        )

    def start(self, *arguments: str, program: str = "yarp") -> subprocess.Popen[str]:
        """Start a program; it ends with the test."""
        process = subprocess.Popen(
            [binary(program), *arguments],
            env=self.environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        self._started.append(process)
        return process

    @staticmethod
    def line_of(process: subprocess.Popen[str]) -> str:
        """The next line that is no log message of YARP."""
        assert process.stdout is not None
        while (line := process.stdout.readline()).startswith("["):
            pass
        return line

    def start_name_server(self) -> None:
        """Start YARP's name server at the address in `yarp.conf`."""
        options = (
            "--write",
            "--ip",
            LOOPBACK,
            "--socket",
            str(self.number),
            "--portdb",
            ":memory:",
        )
        self._name_server = self.start(*options, "--subdb", ":memory:", program="yarpserver")

    def restart_name_server(self) -> None:
        """End YARP's name server, and start another, which knows no ports."""
        self.stop_name_server()
        self.start_name_server()

    def stop_name_server(self) -> None:
        """End YARP's name server."""
        self._name_server.kill()
        self._name_server.wait()

    def address_of(self, port: str) -> PortAddress:
        """Where a port is, which must be known."""
        found = NameClient((LOOPBACK, self.number)).query(port)
        assert found is not None, f"the name server does not know {port}"
        return found

    def knows(self, port: str) -> bool:
        """Whether the name server replies and knows a port."""
        try:
            return NameClient((LOOPBACK, self.number)).query(port) is not None
        except NameServerLost:
            return False

    def python(self, source: str) -> subprocess.Popen[str]:
        """Start a program that uses YARP's Python bindings."""
        process = subprocess.Popen(
            [str(VENV / "bin" / "python"), "-u", "-c", source],
            env=self.environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        self._started.append(process)
        return process

    def close(self) -> None:
        """End what was started."""
        for process in self._started:
            process.kill()
            process.communicate()
