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


@pytest.fixture
def ros(monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """The URI of a ROS master."""
    number = free_port()
    uri = f"http://{LOOPBACK}:{number}"
    monkeypatch.setenv("ROS_MASTER_URI", uri)
    monkeypatch.setenv("ROS_HOSTNAME", LOOPBACK)
    command = ["rosmaster", "--core", "-p", str(number)]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as master:
        yield uri
        master.kill()


@pytest.fixture
def tools(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Tools]:
    """YARP's own programs, with a name server of YARP."""
    home = tmp_path / "yarp-home"
    home.mkdir()
    found = Tools(home, free_port())
    monkeypatch.setenv("YARP_CONFIG_HOME", str(home))
    monkeypatch.delenv("YARP_NAMESPACE", raising=False)
    found.start_name_server()
    yield found
    found.close()


def collected(process: subprocess.Popen[str]) -> list[str]:
    """The lines of a process's output, which grow."""
    lines: list[str] = []

    def read() -> None:
        assert process.stdout is not None
        for line in process.stdout:
            lines.append(line)  # noqa: PERF402 - each at once

    threading.Thread(target=read, daemon=True).start()
    return lines


def test_bridge_of_page_joins_yarp_program_ros_node_and_component(
    rcgen: Rcgen,
    tmp_path: Path,
    domain: str,
    peer: Callable[..., Peer],
    ros: str,
    tools: Tools,
) -> None:
    assert ros
    (text,) = re.findall(r"```bdsl\n(.*?)```", PAGE.read_text(), re.DOTALL)
    folder = generate(rcgen, tmp_path, text, "rover.bdsl")
    worker_file = folder / "specificworker.py"
    stub = worker_file.read_text()
    worker_file.write_text(stub.replace("return super().calibrated(angles)", "return angles - 1"))
    node = subprocess.Popen(
        [SYSTEM_PYTHON, str(Path(__file__).with_name("rospy_node.py"))],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        env={**os.environ, "PYTHONPATH": ""},
    )
    try:
        states = collected(node)
        commands = collected(tools.start("read", "/rover/command:i"))
        writer = tools.start("write", "/rover/wheels:o")
        with running(folder, "--domain", domain) as worker:
            interface = type(worker.angles_proxy).INTERFACE
            program = peer("zenoh", shares_domain=True)
            angles = program.subscribe(interface, "angles", "rover.angles")
            assert writer.stdin is not None

            def write() -> None:
                writer.stdin.write("90.0 180.0\n")  # type: ignore[union-attr]
                writer.stdin.flush()  # type: ignore[union-attr]

            wait_until(lambda: (write(), states and angles and len(commands) > 2)[1])
            state = json.loads(states[0])
            assert state["name"] == ["left", "right"]
            assert state["position"] == pytest.approx([math.pi / 2 - 1, math.pi - 1])
            assert angles[0].tolist() == pytest.approx([math.pi / 2, math.pi])
            command = next(line for line in commands if line.startswith("speed"))
            assert re.fullmatch(r"speed 0\.5 \d+\s*", command)
    finally:
        node.kill()
        node.wait()
        assert node.stdout is not None
        node.stdout.close()
