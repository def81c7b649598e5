"""A generated component whose interfaces import ROS types, beside a node of rospy."""

from __future__ import annotations

import os
import subprocess
import sys
import uuid
from collections.abc import Iterator
from pathlib import Path

import pytest
from click.testing import CliRunner

from robocomp_dsl.cli.rcgen.main import program
from tests.middleware.ros1.ros1_peers import Master, RospyPeer, needs_ros1
from tests.middleware.ros2.test_ros_component import FILES, WORKER
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.peers, needs_ros1]
DEFINITIONS = "/usr/share"
"""Where Debian installs `std_msgs/msg/String.msg`."""


@pytest.fixture
def lamp(
    tmp_path: Path, master: Master, rospy: RospyPeer, monkeypatch: pytest.MonkeyPatch
) -> Iterator[None]:
    """The running component."""
    monkeypatch.setenv("ROS_PACKAGE_PATH", DEFINITIONS)
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    arguments = ["component", str(tmp_path / "lamp.cdsl"), "-o", str(tmp_path / "lamp")]
    result = CliRunner().invoke(program, arguments)
    assert result.exit_code == 0, result.output
    (tmp_path / "lamp" / "specificworker.py").write_text(WORKER)
    options = {
        "--middleware": ["ros1"],
        "--domain": [f"test-{uuid.uuid4().hex[:12]}"],
        "--address": ["Lamp=ros1:/lamp/switch", "Voice=ros1:/lamp/voice"],
        "--connect": [f"Switch=ros1:/{rospy.name}/set", f"Ear=ros1:/{rospy.name}/out"],
        "--transport": [f"ros1.master={master.uri}"],
    }
    words = [word for option, values in options.items() for v in values for word in (option, v)]
    process = subprocess.Popen(
        [sys.executable, "main.py", *words],
        cwd=tmp_path / "lamp",
        env=os.environ | {"PYTHONPATH": str(Path(__file__).parents[3])},
    )
    yield
    process.terminate()
    assert process.wait(30) == 0


@pytest.mark.usefixtures("lamp")
def test_generated_component_exchanges_topics_services_and_parameters_with_rospy(
    rospy: RospyPeer, master: Master
) -> None:
    assert rospy.command("call", "/lamp/switch", True) == [True, "lamp asked rospy"]
    rospy.command("subscribe", "/lamp/voice", "std_msgs/String")
    rospy.command("advertise", f"/{rospy.name}/in", "std_msgs/String")
    master.run("rosparam", "set", "/lamp/brightness", "0.75")

    def heard() -> list[str]:
        rospy.command("publish", f"/{rospy.name}/in", {"data": "hello"})
        return [each["data"] for each in rospy.command("received", "/lamp/voice")]

    wait_until(lambda: "lamp heard hello at 0.75" in heard())
