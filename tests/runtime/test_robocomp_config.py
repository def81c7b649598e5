"""RoboComp's own configurations: their format, and the keys that are about connections."""

from __future__ import annotations

import logging
from pathlib import Path

import pytest

from robocomp_dsl.runtime import ComponentSpec
from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.component.settings import ExternalPeer, RunSettings
from robocomp_dsl.runtime.component.spec import CalledPort, ServedPort
from robocomp_dsl.runtime.middleware.configured import with_configured_connections
from robocomp_dsl.runtime.parameters import ConfigError
from robocomp_dsl.runtime.parameters.load import load_connection_keys
from tests.runtime.arm_parameters import error_lines, load

OLD = """\
# Endpoints of the implemented interfaces
CommonBehavior.Endpoints=tcp -p 12238
Arm.Endpoints=tcp -p 10001
BumperTopic.Endpoints = tcp   # a random port

LaserProxy = laser:tcp -h localhost -p 10003
JointMotor0Proxy = jointmotor:tcp -h robot -p 10067
JointMotor1Proxy = jointmotor:tcp -h robot -p 10068
TopicManager.Proxy=IceStorm/TopicManager:default -p 9999

device = /dev/ttyACM\\#0
rate=25   # Hz
verbose = true
InnerModelPath = etc/robot.xml

Ice.Warn.Connections=0
Ice.ACM.Timeout=10
Ice.MessageSizeMax=20004800
Ice.Trace.Network=1
"""
NEW = """\
Proxies.Laser = "laser:tcp -h localhost -p 10003"   # a comment
Proxies.TopicManager = "IceStorm/TopicManager:tcp -p 9998"
Endpoints.Arm = "tcp -p 10001"
Period.Compute = 100
device = "/dev/ttyUSB1"
Ice.Trace.Network = "1"
"""
TOML = """\
device = "/dev/ttyUSB1"
[Proxies]
Laser = "laser:tcp -h localhost -p 10003"
TopicManager = "IceStorm/TopicManager:tcp -p 9998"
[Endpoints]
Arm = "tcp -p 10001"
[Ice.Trace]
Network = "1"
"""


def interface(name: str) -> rt.Interface:
    return rt.Interface(f"RoboComp{name}::{name}", rt.Operation("go"))


def proxy(name: str) -> type[rt.Proxy]:
    return type(f"{name}Proxy", (rt.Proxy,), {"INTERFACE": interface(name), "__slots__": ()})


SPEC = ComponentSpec(
    name="armComp",
    middleware="ice",
    implements=(ServedPort("Arm", interface("Arm")),),
    requires=(
        CalledPort("Laser", proxy("Laser"), "laser_proxy"),
        CalledPort("JointMotor", proxy("JointMotor"), "jointmotor_proxy"),
        CalledPort("JointMotor1", proxy("JointMotor"), "jointmotor1_proxy"),
        CalledPort("Speech", proxy("Speech"), "speech_proxy"),
    ),
    publishes=(CalledPort("ArmPub", proxy("ArmPub"), "armpub_proxy"),),
    subscribes=(ServedPort("Bumper", interface("Bumper")),),
)


def configured(
    tmp_path: Path, text: str, settings: RunSettings | None = None, suffix: str = ""
) -> RunSettings:
    file = tmp_path / f"config{suffix}"
    file.write_text(text)
    return with_configured_connections(settings or RunSettings(), SPEC, file)


def test_old_configuration_connects_ports_on_ice(tmp_path: Path) -> None:
    settings = configured(tmp_path, OLD)
    assert settings.external == {
        "Laser": (ExternalPeer("laser", "ice", "laser:tcp -h localhost -p 10003"),),
        "JointMotor": (ExternalPeer("jointmotor", "ice", "jointmotor:tcp -h robot -p 10067"),),
        "JointMotor1": (ExternalPeer("jointmotor", "ice", "jointmotor:tcp -h robot -p 10068"),),
        "ArmPub": (ExternalPeer("topic ArmPub", "ice", "icestorm:ArmPub"),),
        "Bumper": (ExternalPeer("topic Bumper", "ice", "icestorm:Bumper"),),
    }
    assert settings.addresses == {("ice", "Arm"): "tcp -p 10001", ("ice", "Bumper"): "tcp"}
    assert settings.transport_settings == {
        ("ice", "TopicManager"): "IceStorm/TopicManager:default -p 9999",
        ("ice", "Ice.Trace.Network"): "1",
    }


@pytest.mark.parametrize(("text", "suffix"), [(NEW, ""), (TOML, ".toml")])
def test_new_configuration_connects_ports_on_ice(tmp_path: Path, text: str, suffix: str) -> None:
    settings = configured(tmp_path, text, suffix=suffix)
    assert settings.external["Laser"][0].address == "laser:tcp -h localhost -p 10003"
    assert settings.addresses == {("ice", "Arm"): "tcp -p 10001"}
    assert settings.transport_settings == {
        ("ice", "TopicManager"): "IceStorm/TopicManager:tcp -p 9998",
        ("ice", "Ice.Trace.Network"): "1",
    }


@pytest.mark.parametrize("key", ["armComp.Endpoints", "ArmComp.Endpoints", "Arm.Endpoints"])
def test_configuration_names_adapter_of_component_or_interface(tmp_path: Path, key: str) -> None:
    assert configured(tmp_path, f"{key} = tcp -p 7\n").addresses == {("ice", "Arm"): "tcp -p 7"}


def test_command_line_takes_precedence_over_configuration(tmp_path: Path) -> None:
    peer = ExternalPeer("other", "ice", "other:tcp -p 1")
    command_line = RunSettings(
        external={"Laser": (peer,)},
        connections={"JointMotor1": ("motor",)},
        addresses={("ice", "Arm"): "tcp -p 2"},
        transport_settings={("ice", "TopicManager"): "X/TopicManager:tcp -p 3"},
    )
    settings = configured(tmp_path, OLD, command_line)
    assert settings.external["Laser"] == (peer,)
    assert "JointMotor1" not in settings.external
    assert settings.addresses["ice", "Arm"] == "tcp -p 2"
    assert settings.transport_settings["ice", "TopicManager"] == "X/TopicManager:tcp -p 3"


def test_configuration_does_not_connect_ports_on_other_middlewares(tmp_path: Path) -> None:
    command_line = RunSettings(middleware="zenoh", port_middlewares={"Laser": ("ice",)})
    settings = configured(tmp_path, OLD, command_line)
    assert list(settings.external) == ["Laser"]
    assert settings.addresses == {}


def test_parameters_load_reads_old_configuration(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.WARNING):
        params = load(tmp_path, OLD, suffix="")
    assert (params.device, params.rate, params.verbose) == ("/dev/ttyACM#0", 25.0, True)
    assert "ignored keys that are no parameters: InnerModelPath" in caplog.text


@pytest.mark.parametrize("text", [NEW, TOML])
def test_parameters_load_ignores_connection_keys(tmp_path: Path, text: str) -> None:
    params = load(tmp_path, text, suffix=".toml" if text is TOML else "")
    assert params.device == "/dev/ttyUSB1"


def test_parameters_load_reports_position_in_old_configuration(tmp_path: Path) -> None:
    with pytest.raises(ConfigError) as caught:
        load(tmp_path, "device = x\nnonsense\n  rate = fast # Hz\n= 5\n", suffix="")
    assert error_lines(caught.value) == [
        "2:1 a line has the form `key = value`",
        "3:10 `rate` must be a number, not `fast`",
        "4:1 a line has the form `key = value`",
    ]


def test_parameters_load_still_reads_yaml_without_suffix(tmp_path: Path) -> None:
    assert load(tmp_path, "# rate = 5\ndevice: a = b\n", suffix="").device == "a = b"


def test_unreadable_configuration_has_no_connections(tmp_path: Path) -> None:
    assert not load_connection_keys(tmp_path / "missing")
    assert not load_connection_keys(None)
