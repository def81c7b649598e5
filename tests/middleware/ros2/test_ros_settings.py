"""What a user can get wrong at the start, and what the message says."""

from __future__ import annotations

import importlib.util
import socket
from pathlib import Path

import pytest

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.registry import UnknownMiddleware, open_transport
from robocomp_dsl.runtime.middleware.ros_common.settings import domain_id
from robocomp_dsl.runtime.middleware.transport import Transport, TransportContext


def _open(middleware: str, tmp_path: Path, component: str = "lamp", **settings: str) -> Transport:
    context = TransportContext(component, "test", tmp_path, pytest.fail, {}, settings)
    return open_transport(middleware, context)


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
    return port


def test_setting_that_rmw_zenoh_lacks_is_refused(tmp_path: Path) -> None:
    with pytest.raises(MiddlewareError, match=r"no setting `router`; known: connect, domain_id"):
        _open("rmw_zenoh", tmp_path, router="tcp/127.0.0.1:7447")


def test_setting_connect_that_is_no_address_is_refused(tmp_path: Path) -> None:
    with pytest.raises(MiddlewareError, match=r"cannot open a session .connect localhost,"):
        _open("rmw_zenoh", tmp_path, connect="localhost")


def test_component_name_that_ros_forbids_is_refused(tmp_path: Path) -> None:
    with pytest.raises(MiddlewareError, match="component: `2nd-lamp` is not a valid ROS name"):
        _open("rmw_zenoh", tmp_path, component="2nd-lamp")


def test_router_that_does_not_answer_is_reported(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    address = f"tcp/127.0.0.1:{_free_port()}"
    _open("rmw_zenoh", tmp_path, connect=address).close()
    (text,) = caplog.messages
    assert text.startswith(f"no zenoh router answers at {address}")


@pytest.mark.parametrize(
    ("settings", "environment", "number"),
    [
        ({}, {}, 0),
        ({}, {"ROS_DOMAIN_ID": "7"}, 7),
        ({"domain_id": "12"}, {"ROS_DOMAIN_ID": "7"}, 12),
    ],
)
def test_domain_id_is_the_setting_or_that_of_ros(
    settings: dict[str, str], environment: dict[str, str], number: int
) -> None:
    assert domain_id("ros2", settings, environment) == number


@pytest.mark.parametrize("text", ["-1", "233", "lab", "1.5"])
def test_domain_id_that_ros_lacks_is_refused(text: str) -> None:
    with pytest.raises(MiddlewareError, match=f"ros2.domain_id: `{text}` is no ROS domain"):
        domain_id("ros2", {"domain_id": text}, {})
    with pytest.raises(MiddlewareError, match=f"ROS_DOMAIN_ID: `{text}` is no ROS domain"):
        domain_id("ros2", {}, {"ROS_DOMAIN_ID": text})


@pytest.mark.parametrize(("middleware", "module"), [("ros2", "rclpy"), ("dds", "cyclonedds")])
def test_middleware_without_its_modules_tells_how_to_install_them(
    middleware: str, module: str, tmp_path: Path
) -> None:
    if importlib.util.find_spec(module):
        pytest.skip(f"{module} is installed")
    with pytest.raises(UnknownMiddleware, match=rf"needs {module}.*pip install 'robocomp_dsl\["):
        _open(middleware, tmp_path)
