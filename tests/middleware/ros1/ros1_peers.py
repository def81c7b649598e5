"""The programs of ROS Noetic, if Debian's `ros-base` is installed: master, rospy, tools."""

from __future__ import annotations

import json
import os
import socket
import subprocess
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.runtime.middleware.ros1.xmlrpc import RosApi, RosApiError
from tests.support.waiting import wait_until

PYTHON = "/usr/bin/python3"
INSTALLED = all(Path("/usr/bin", name).exists() for name in ("rosmaster", "rostopic", "rosservice"))
needs_ros1 = pytest.mark.skipif(
    not INSTALLED, reason="needs Debian's ros-base: `make test-peers` installs it"
)
LOOPBACK = "127.0.0.1"
TIMEOUT_S = 60.0


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind((LOOPBACK, 0))
        return int(probe.getsockname()[1])


class Master:
    """`rosmaster`; `folder` gets its logs."""

    def __init__(self, folder: Path) -> None:
        self.number = free_port()
        self.uri = f"http://{LOOPBACK}:{self.number}"
        self._folder = folder
        self.start()

    @property
    def environment(self) -> dict[str, str]:
        """The variables of programs that use this master."""
        folder = str(self._folder)
        removed = ("PYTHONPATH", "VIRTUAL_ENV", "ROS_IP")
        variables = {key: value for key, value in os.environ.items() if key not in removed}
        return variables | {
            "ROS_MASTER_URI": self.uri,
            "ROS_HOSTNAME": LOOPBACK,
            "ROS_HOME": folder,
            "ROS_LOG_DIR": folder,
            "ROS_PYTHON_LOG_CONFIG_FILE": "",
        }

    def start(self) -> None:
        self._process = subprocess.Popen(
            [PYTHON, "/usr/bin/rosmaster", "--core", "-p", str(self.number)],
            env=self.environment,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        wait_until(lambda: self.ask("getPid"), ignoring=RosApiError)

    def ask(self, method: str, *arguments: Any) -> Any:
        api = RosApi(self.uri, TIMEOUT_S)
        try:
            return api.call(method, "/test", *arguments)
        finally:
            api.close()

    def nodes_of(self, kind: int, name: str) -> list[str]:
        """The nodes that publish (0), subscribe to (1) or serve (2) a name."""
        return next((nodes for each, nodes in self.ask("getSystemState")[kind] if each == name), [])

    def run(self, *command: str) -> str:
        """The output of a tool of ROS."""
        return subprocess.run(
            [PYTHON, f"/usr/bin/{command[0]}", *command[1:]],
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=TIMEOUT_S,
            check=False,
        ).stdout

    def stop(self) -> None:
        self._process.kill()
        self._process.wait()


class RospyPeer:
    """`rospy_peer.py` in a process of its own."""

    def __init__(self, master: Master, name: str) -> None:
        self.name = name
        self._process = subprocess.Popen(
            [PYTHON, str(Path(__file__).with_name("rospy_peer.py")), name],
            env=master.environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        assert self._read() == "ready"

    def _read(self) -> Any:
        assert self._process.stdout
        line = self._process.stdout.readline()
        assert line, f"the peer exited with {self._process.wait()}"
        return json.loads(line)

    def command(self, *words: Any) -> Any:
        assert self._process.stdin
        self._process.stdin.write(json.dumps(words) + "\n")
        self._process.stdin.flush()
        reply = self._read()
        assert not (isinstance(reply, dict) and "error" in reply), reply
        return reply

    def close(self) -> None:
        """End it without the chance to say good-bye to the master."""
        self._process.kill()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout):
            if stream:
                stream.close()
