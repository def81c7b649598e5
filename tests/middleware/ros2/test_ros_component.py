"""A generated component whose interfaces import ROS types, beside a ROS node that others wrote."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from click.testing import CliRunner

from robocomp_dsl.cli.rcgen.main import program
from tests.middleware.ros2.peer_process import PEERS, PeerProcess, start_peer
from tests.middleware.ros2.ros_network import RosNetwork
from tests.support.waiting import wait_until

pytestmark = pytest.mark.peers
FILES = {
    "Lamp.idsl": """
import "std_srvs/srv/SetBool.srv";
import "std_msgs/msg/String.msg";
module RobotLamp
{
  interface Lamp
  {
    std_srvs::SetBool_Response switch(std_srvs::SetBool_Request request);
  };
  interface Switch
  {
    std_srvs::SetBool_Response set(std_srvs::SetBool_Request request);
  };
  interface Voice
  {
    void say(std_msgs::String text);
  };
  interface Ear
  {
    void hear(std_msgs::String text);
  };
};
""",
    "lamp.pdsl": """
ComponentParams lamp
{
    /** Of the lamp. */
    brightness float 0.5 0:1 live;
    pin int 7;
    curve[1:4] float {0, 0.5} 0:1 live;
    names[0:2] string live;
};
""",
    "lamp.cdsl": """
import "Lamp.idsl";
Component lamp
{
  Communications
  {
    implements Lamp;
    requires Switch;
    publishes Voice;
    subscribesTo Ear;
  };
  language Python;
  parameters "lamp.pdsl";
};
""",
}
WORKER = '''
from lamp_generated.genericworker import GenericWorker
from lamp_generated.interfaces import SetBool_Request, SetBool_Response, String


class SpecificWorker(GenericWorker):
    """Passes calls and texts on to the ROS node."""

    def Lamp_switch(self, request: SetBool_Request) -> SetBool_Response:
        reply = self.switch_proxy.set(request)
        return SetBool_Response(reply.success, "lamp asked " + reply.message)

    def Ear_hear(self, text: String) -> None:
        answer = f"lamp heard {text.data} at {self.params.brightness}"
        self.voice_proxy.say(String(answer))

    def did_set_brightness(self, old: float) -> None:
        self.log.info("brightness changed")
'''


@pytest.fixture
def component(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of the generated component."""
    # The definitions of ROS that were installed with it.
    monkeypatch.setenv("AMENT_PREFIX_PATH", sys.prefix)
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    arguments = ["component", str(tmp_path / "lamp.cdsl"), "-o", str(tmp_path / "lamp")]
    result = CliRunner().invoke(program, arguments)
    assert result.exit_code == 0, result.output
    (tmp_path / "lamp" / "specificworker.py").write_text(WORKER)
    return tmp_path / "lamp"


@pytest.fixture
def peer(service_network: RosNetwork) -> Iterator[PeerProcess]:
    process = start_peer(service_network)
    yield process
    process.close()


@pytest.fixture
def lamp(component: Path, service_network: RosNetwork, peer: PeerProcess) -> Iterator[None]:
    """The component, running."""
    kind = service_network.kind
    settings = service_network.settings.items()
    options = {
        "--middleware": [kind],
        "--domain": [service_network.domain],
        "--address": [f"Lamp={kind}:/lamp/switch", f"Voice={kind}:/lamp/voice"],
        "--connect": [f"Switch={kind}:/peer/set", f"Ear={kind}:/peer/out"],
        "--transport": [f"{kind}.{key}={value}" for (_, key), value in settings],
    }
    words = [word for option, values in options.items() for v in values for word in (option, v)]
    process = subprocess.Popen(
        [sys.executable, "main.py", *words],
        cwd=component,
        env=os.environ | {"PYTHONPATH": str(Path(__file__).parents[3])},
    )
    yield
    process.terminate()
    assert process.wait(30) == 0


@pytest.mark.usefixtures("lamp")
def test_generated_component_serves_calls_and_exchanges_topics_with_a_ros_node(
    service_network: RosNetwork, peer: PeerProcess
) -> None:
    name = PEERS[service_network.kind]
    reply = wait_until(lambda: peer.command("call", "/lamp/switch"))
    assert reply == [True, f"lamp asked {name}"]
    assert peer.command("parameter", "/lamp", "curve") == [0.0, 0.5]
    assert peer.command("set_parameter", "/lamp", "curve", "[1.0,0.25,0.0]") == [True, ""]
    assert peer.command("parameter", "/lamp", "curve") == [1.0, 0.25, 0.0]
    assert peer.command("set_parameter", "/lamp", "names", '["a,b","c"]') == [True, ""]
    assert peer.command("parameter", "/lamp", "names") == ["a,b", "c"]
    accepted, reason = peer.command("set_parameter", "/lamp", "curve", "[1.0,7.0]")
    assert not accepted
    assert "curve[1]" in reason
    peer.command("subscribe", "/lamp/voice")
    wait_until(
        lambda: (
            peer.command("publish", "/peer/out", "hello"),
            peer.command("received", "/lamp/voice"),
        )[1]
    )
    assert set(peer.command("received", "/lamp/voice")) == {"lamp heard hello at 0.5"}


@pytest.mark.usefixtures("lamp")
@pytest.mark.parametrize("service_network", ["ros2"], indirect=True)
def test_generated_component_has_its_parameters_as_those_of_its_node(peer: PeerProcess) -> None:
    names = wait_until(lambda: peer.command("parameters", "/lamp"))
    assert {"brightness", "pin"} <= set(names)
    assert peer.command("parameter", "/lamp", "brightness") == 0.5
    assert peer.command("set_parameter", "/lamp", "brightness", "1") == [True, ""]
    assert wait_until(lambda: peer.command("parameter", "/lamp", "brightness")) == 1.0
    accepted, reason = peer.command("set_parameter", "/lamp", "brightness", "7")
    assert not accepted
    assert "brightness" in reason
    accepted, reason = peer.command("set_parameter", "/lamp", "pin", "8")
    assert not accepted
    assert "read-only" in reason
    assert peer.command("parameter", "/lamp", "curve") == [0.0, 0.5]
    assert peer.command("set_parameter", "/lamp", "curve", "[1.0,0.25,0.0]") == [True, ""]
    assert peer.command("parameter", "/lamp", "curve") == [1.0, 0.25, 0.0]
    assert peer.command("set_parameter", "/lamp", "names", '["a,b","c"]') == [True, ""]
    assert peer.command("parameter", "/lamp", "names") == ["a,b", "c"]
    accepted, reason = peer.command("set_parameter", "/lamp", "curve", "[1.0,7.0]")
    assert not accepted
    assert "curve[1]" in reason
    peer.command("subscribe", "/lamp/voice")
    wait_until(
        lambda: (
            peer.command("publish", "/peer/out", "hello"),
            peer.command("received", "/lamp/voice"),
        )[1]
    )
    assert set(peer.command("received", "/lamp/voice")) == {"lamp heard hello at 1.0"}
