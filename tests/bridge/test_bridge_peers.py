"""The bridge of `docs/how-to/bridge.md` between programs of YARP and ROS 1 and a component."""

from __future__ import annotations

import json
import math
import os
import re
import shutil
import subprocess
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.bridge.bridge_run import Peer, generate, running
from tests.cli.rcgen_run import Rcgen
from tests.middleware.yarp.yarp_tools import Tools, free_port, needs_yarp
from tests.support.waiting import wait_until

PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "bridge.md"
SYSTEM_PYTHON = "/usr/bin/python3"
LOOPBACK = "127.0.0.1"


def has_rospy() -> bool:
    """Whether ROS 1 is installed: the master and rospy."""
    if not (shutil.which("rosmaster") and Path(SYSTEM_PYTHON).exists()):
        return False
    probe = [SYSTEM_PYTHON, "-c", "import rospy, sensor_msgs.msg"]
    return subprocess.run(probe, capture_output=True, check=False).returncode == 0


pytestmark = [
    pytest.mark.peers,
    needs_yarp,
    pytest.mark.skipif(not has_rospy(), reason="needs rosmaster and rospy of ROS 1 (Debian)"),
]


class Ros:
    """A ROS master, and programs of ROS that end with the test."""

    def __init__(self) -> None:
        self._number = free_port()
        self._started: list[subprocess.Popen[str]] = []
        self.uri = f"http://{LOOPBACK}:{self._number}"

    def start(self, *command: str) -> subprocess.Popen[str]:
        """Start a program; the system's Python must not see modules of this environment."""
        process = subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            env={**os.environ, "PYTHONPATH": "", "PATH": f"/usr/bin:{os.environ['PATH']}"},
        )
        self._started.append(process)
        return process

    def start_master(self) -> None:
        """Start the master, always at the same address."""
        self._master = self.start("rosmaster", "--core", "-p", str(self._number))

    def restart_master(self) -> None:
        """End the master, and start another, which knows no nodes."""
        self.end(self._master)
        self.start_master()

    def start_node(self) -> subprocess.Popen[str]:
        """Start the node of rospy."""
        return self.start(SYSTEM_PYTHON, str(Path(__file__).with_name("rospy_node.py")))

    @staticmethod
    def end(process: subprocess.Popen[str]) -> None:
        """End a program at once."""
        process.kill()
        process.communicate()

    def close(self) -> None:
        """End all programs."""
        for process in self._started:
            if process.poll() is None:
                process.kill()
            process.wait()


@pytest.fixture
def ros(monkeypatch: pytest.MonkeyPatch) -> Iterator[Ros]:
    """A ROS master that all programs of the test find."""
    found = Ros()
    monkeypatch.setenv("ROS_MASTER_URI", found.uri)
    monkeypatch.setenv("ROS_HOSTNAME", LOOPBACK)
    found.start_master()
    yield found
    found.close()


@pytest.fixture
def tools(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Tools]:
    """YARP's own programs, with a name server of YARP."""
    home = tmp_path / "yarp-home"
    home.mkdir()
    found = Tools(home, free_port())
    monkeypatch.setenv("YARP_CONFIG_HOME", str(home))
    monkeypatch.delenv("YARP_NAMESPACE", raising=False)
    found.start_name_server()
    wait_until(lambda: answers(found))
    yield found
    found.close()


def answers(tools: Tools) -> bool:
    """Whether the name server registers and finds ports."""
    return tools.run("exists", "/root").returncode == 0


def collected(process: subprocess.Popen[str]) -> list[str]:
    """The lines of a process's output, which grow."""
    lines: list[str] = []

    def read() -> None:
        assert process.stdout is not None
        for line in process.stdout:
            lines.append(line)  # noqa: PERF402 - each at once

    threading.Thread(target=read, daemon=True).start()
    return lines


@pytest.fixture
def bridge_folder(rcgen: Rcgen, tmp_path: Path) -> Path:
    """The bridge of the page, with a function."""
    (text,) = re.findall(r"```bdsl\n(.*?)```", PAGE.read_text(), re.DOTALL)
    folder = generate(rcgen, tmp_path, text, "rover.bdsl")
    worker_file = folder / "specificworker.py"
    stub = worker_file.read_text()
    worker_file.write_text(stub.replace("return super().calibrated(angles)", "return angles - 1"))
    return folder


class Writer:
    """`yarp write`, which writes the same angles again and again."""

    def __init__(self, tools: Tools) -> None:
        self.process = tools.start("write", "/rover/wheels:o")

    def write(self) -> None:
        """Write one message."""
        assert self.process.stdin is not None
        self.process.stdin.write("90.0 180.0\n")
        self.process.stdin.flush()


def test_bridge_of_page_joins_yarp_program_ros_node_and_component(
    bridge_folder: Path, domain: str, peer: Callable[..., Peer], ros: Ros, tools: Tools
) -> None:
    states = collected(ros.start_node())
    commands = collected(tools.start("read", "/rover/command:i"))
    writer = Writer(tools)
    with running(bridge_folder, "--domain", domain) as worker:
        interface = type(worker.angles_proxy).INTERFACE
        program = peer("zenoh", shares_domain=True)
        angles = program.subscribe(interface, "angles", "rover.angles")

        def has_arrived() -> bool:
            writer.write()
            return bool(states and angles and len(commands) > 2)

        wait_until(has_arrived)
        state = json.loads(states[0])
        assert state["name"] == ["left", "right"]
        assert state["position"] == pytest.approx([math.pi / 2 - 1, math.pi - 1])
        assert angles[0].tolist() == pytest.approx([math.pi / 2, math.pi])
        command = next(line for line in commands if line.startswith("speed"))
        assert re.fullmatch(r"speed 0\.5 \d+\s*", command)


def test_bridge_continues_after_restart_of_programs_and_name_servers(
    bridge_folder: Path, domain: str, ros: Ros, tools: Tools
) -> None:
    node, writer = ros.start_node(), Writer(tools)
    reader = tools.start("read", "/rover/command:i")
    states, commands = collected(node), collected(reader)

    def is_passing() -> bool:
        writer.write()
        return bool(states and commands)

    with running(bridge_folder, "--domain", domain):
        wait_until(is_passing)
        ros.end(node)
        writer.process.kill()
        node, writer = ros.start_node(), Writer(tools)
        states = collected(node)
        commands.clear()
        wait_until(is_passing)
        ros.restart_master()
        ros.end(node)
        node = ros.start_node()
        states = collected(node)
        commands.clear()
        wait_until(is_passing)
        tools.restart_name_server()
        wait_until(lambda: answers(tools))
        writer.process.kill()
        reader.kill()
        writer, reader = Writer(tools), tools.start("read", "/rover/command:i")
        commands = collected(reader)
        states.clear()
        wait_until(is_passing)
