"""Connections over middlewares that carry ROS types only."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from robocomp_dsl.cli.rcgen.main import program

IDSL = """
import "std_srvs/srv/SetBool.srv";
import "std_msgs/msg/String.msg";
module Robot
{
  interface Lamp { std_srvs::SetBool_Response set(std_srvs::SetBool_Request request); };
  interface Voice { void say(std_msgs::String text); };
  interface Adder { int add(int a, int b); };
  interface Ticks { void tick(int number); };
};
"""
SERVER = """
import "Robot.idsl";
Component server
{
  Communications { implements Lamp, Adder; publishes Voice, Ticks; };
  language Python;
};
"""
CLIENT = """
import "Robot.idsl";
Component client
{
  Communications { requires Lamp, Adder; subscribesTo Voice, Ticks; };
  language Python;
};
"""


def _check(folder: Path, connection: str, middleware: str) -> str:
    """What `rcgen check` says of a deployment with this connection."""
    files = {"Robot.idsl": IDSL, "server.cdsl": SERVER, "client.cdsl": CLIENT}
    files["app.ddsl"] = f"""
import "server.cdsl";
import "client.cdsl";
Deployment app
{{
  component server;
  component client {{ after server; }};
  connect {connection} over {middleware};
}};
"""
    for name, text in files.items():
        (folder / name).write_text(text)
    return CliRunner().invoke(program, ["check", str(folder / "app.ddsl")]).output


@pytest.mark.parametrize(
    "connection", ["client.Lamp -> server.Lamp", "server.Voice -> client.Voice"]
)
def test_connection_of_ros_types_is_carried(tmp_path: Path, connection: str) -> None:
    assert "RC55" not in _check(tmp_path, connection, "rmw_zenoh")


@pytest.mark.parametrize(
    ("connection", "text"),
    [
        (
            "client.Adder -> server.Adder",
            "`add` of `Adder` needs the request and response of one imported `.srv`",
        ),
        (
            "server.Ticks -> client.Ticks",
            "`tick` of `Ticks` needs a parameter that is one imported `.msg`",
        ),
    ],
)
def test_connection_of_other_types_is_a_finding(tmp_path: Path, connection: str, text: str) -> None:
    output = _check(tmp_path, connection, "ros2")
    assert f"`ros2` carries ROS types only: {text}" in output


def test_connection_of_a_service_over_topics_only_is_a_finding(tmp_path: Path) -> None:
    assert "`dds` has no services" in _check(tmp_path, "client.Lamp -> server.Lamp", "dds")


def _check_external(folder: Path, extern: str, connection: str) -> str:
    """What `rcgen check` says of a component that is connected to a ROS 1 node."""
    (folder / "Robot.idsl").write_text(IDSL)
    (folder / "client.cdsl").write_text(CLIENT)
    (folder / "app.ddsl").write_text(f"""
import "client.cdsl";
Deployment app
{{
  component client;
  extern node over ros1 at "/node" {extern};
  connect {connection};
}};
""")
    return CliRunner().invoke(program, ["check", str(folder / "app.ddsl")]).output


@pytest.mark.parametrize(
    ("extern", "connection"),
    [
        ("publishes Voice", "node.Voice -> client.Voice"),
        ("implements Lamp", "client.Lamp -> node.Lamp"),
    ],
)
def test_ros_1_node_with_ros_types_is_connected(
    tmp_path: Path, extern: str, connection: str
) -> None:
    assert "RC55" not in _check_external(tmp_path, extern, connection)


@pytest.mark.parametrize(
    ("extern", "connection", "operation"),
    [
        ("publishes Ticks", "node.Ticks -> client.Ticks", "tick"),
        ("implements Adder", "client.Adder -> node.Adder", "add"),
    ],
)
def test_ros_1_node_with_other_types_is_a_finding(
    tmp_path: Path, extern: str, connection: str, operation: str
) -> None:
    output = _check_external(tmp_path, extern, connection)
    assert f"programs of ROS know ROS types only: `{operation}`" in output


@pytest.mark.parametrize(
    "connection", ["client.Adder -> server.Adder", "server.Ticks -> client.Ticks"]
)
def test_components_exchange_other_types_over_ros_1(tmp_path: Path, connection: str) -> None:
    assert "RC55" not in _check(tmp_path, connection, "ros1")
