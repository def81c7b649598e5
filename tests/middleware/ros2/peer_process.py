"""A program of another project as a peer: started by a test, controlled line by line.

The peer answers each command line with a line of JSON. All peers have: the service `/peer/set`
(std_srvs/SetBool, replies with its own name), an echo from the topic `/peer/in` to `/peer/out`
(std_msgs/String), and the latched topic `/peer/map`. Commands: `call NAME`, `received TOPIC`,
`subscribe TOPIC [latched]`, `raw TOPIC HEX`, `publish TOPIC TEXT`, `subscribers TOPIC`.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.middleware.ros2.ros_network import RosNetwork

ROOT = Path(__file__).parents[3]
PEERS = {"rmw_zenoh": "sdk", "ros2": "rclpy", "dds": "rclpy"}
"""The program that each middleware can reach."""
MODULES = {"sdk": "zenoh_ros2_sdk", "rclpy": "rclpy"}


class PeerProcess:
    """One peer; `program` is a module beside this module."""

    def __init__(self, program: str, *arguments: str) -> None:
        self._process = subprocess.Popen(
            [sys.executable, str(Path(__file__).with_name(f"{program}.py")), *arguments],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            cwd=ROOT,
        )
        assert self._read() == "ready"

    def _read(self) -> Any:
        assert self._process.stdout
        line = self._process.stdout.readline()
        assert line, f"the peer exited with {self._process.wait()}"
        return json.loads(line)

    def command(self, *words: str) -> Any:
        assert self._process.stdin
        self._process.stdin.write(" ".join(words) + "\n")
        self._process.stdin.flush()
        return self._read()

    def close(self) -> None:
        self._process.kill()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout):
            if stream:
                stream.close()


def start_peer(network: RosNetwork) -> PeerProcess:
    """The peer that the middleware of `network` can reach; skips the test without it."""
    program = PEERS[network.kind]
    pytest.importorskip(MODULES[program], reason="`make test-peers` runs it in build/peers-venv")
    port = network.router_address.rpartition(":")[2]
    arguments = [str(network.domain_id), *([port] if port else [])]
    return PeerProcess(f"{program}_peer", *arguments)
