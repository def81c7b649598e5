"""Names of topics and services in ROS 2.

In: a port and the addresses that the user chose. Out: absolute ROS names, or an error. The rules
are those of the ROS 2 design article "Topic and Service name mapping to DDS" and of
`rmw_validate_full_topic_name`.
"""

from __future__ import annotations

from collections.abc import Mapping

from robocomp_dsl.runtime.component.interface import Interface, Operation
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.ros_common.valid_names import address_problem


def absolute_name(name: str, port: str) -> str:
    """`name` with a leading `/`. Raises `MiddlewareError`, naming `port`, if ROS forbids it."""
    problem = address_problem(name)
    if problem:
        raise MiddlewareError(f"{port}: {problem}")
    return f"/{name.lstrip('/')}"


def port_name(at: Endpoint, addresses: Mapping[str, str]) -> str:
    """The name of an own port: its address if the user chose one, else `/<component>/<port>`."""
    return absolute_name(addresses.get(at.port) or f"{at.component}/{at.port}", at.port)


def operation_name(name: str, interface: Interface, operation: Operation) -> str:
    """The topic or service of an operation: that of its port, if the port has no other operation.

    Otherwise `<port name>/<operation>`.
    """
    return name if len(interface.operations) == 1 else f"{name}/{operation.name}"


def node_name(component: str) -> tuple[str, str]:
    """Namespace and name of the ROS node of a component: `/left` and `arm` for `/left/arm`."""
    namespace, _, name = absolute_name(component, "component").rpartition("/")
    return namespace or "/", name
