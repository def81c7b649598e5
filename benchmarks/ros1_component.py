"""A component on `ros1` that echoes and serves, with the types of ROS, and one that calls it.

python -m benchmarks.ros1_component DOMAIN MASTER     serves, until its input ends
"""

from __future__ import annotations

import sys
from queue import Empty, SimpleQueue
from typing import Any

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import ComponentPorts, open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.presence.port_record import PortRecord

ROS1 = "ros1"
TEXT = "x" * 80


class String(rt.Struct, type_id="std_msgs/msg/String"):
    """As generated."""

    data: rt.String = ""


class SetBoolRequest(rt.Struct, type_id="std_srvs/srv/SetBool_Request"):
    """As generated."""

    data: rt.Bool = False


class SetBoolResponse(rt.Struct, type_id="std_srvs/srv/SetBool_Response"):
    """As generated."""

    success: rt.Bool = False
    message: rt.String = ""


ECHO = rt.Interface("Bench::Echo", rt.Operation("say", rt.Pattern.PUBLISH, {"text": String}))
SWITCH = rt.Interface(
    "Bench::Switch",
    rt.Operation("set", inputs={"request": SetBoolRequest}, returns=SetBoolResponse),
)


def opened(name: str, domain: str, master: str, **addresses: str) -> ComponentPorts:
    """The ports of a component; `addresses` are the ROS names of its own ports."""
    context = ComponentContext(
        name,
        domain,
        CallbackGroup(),
        Statistics(),
        addresses={(ROS1, port): address for port, address in addresses.items()},
        transport_settings={(ROS1, "master"): master},
    )
    return open_ports(ROS1, context)


def endpoint(interface: rt.Interface, name: str, port: str, external: str = "") -> Endpoint:
    """A port; `external` is the ROS name of its peer."""
    records = ()
    if external:
        records = (PortRecord("", interface.name, "ros", port, "", ROS1, external),)
    return Endpoint(interface, name, port, (), Qos(), (ROS1,), records)


def serve(name: str, domain: str, master: str) -> ComponentPorts:
    """A component that answers as `rospy_twoway.py serve NAME`."""
    ports = opened(name, domain, master, Set=f"/{name}/set", Back=f"/{name}/back")
    group = CallbackGroup()
    back = ports.advertise(endpoint(ECHO, name, "Back")).bind(ECHO.operations[0])
    ports.subscribe(endpoint(ECHO, name, "There", f"/{name}/there"), {"say": back}, group)
    reply = {"set": lambda request: SetBoolResponse(request.data, TEXT)}
    ports.serve(endpoint(SWITCH, name, "Set"), reply, group)
    return ports


class Caller:
    """A component that calls a node which serves under `name`, a component or rospy."""

    def __init__(self, own: str, name: str, domain: str, master: str) -> None:
        self._replies: SimpleQueue[String] = SimpleQueue()
        self.ports = opened(own, domain, master, There=f"/{name}/there")
        there = self.ports.advertise(endpoint(ECHO, own, "There"))
        self._say: Any = there.bind(ECHO.operations[0])
        back = endpoint(ECHO, own, "Back", f"/{name}/back")
        self.ports.subscribe(back, {"say": self._replies.put}, CallbackGroup())
        proxy = self.ports.proxy(endpoint(SWITCH, own, "Set", f"/{name}/set"))
        self._set: Any = proxy.bind(SWITCH.operations[0])
        self._message, self._request = String(TEXT), SetBoolRequest(True)
        while not there.has_subscribers():
            pass
        while not self._rings():
            pass

    def _rings(self) -> bool:
        """Whether a message comes back: the connections are open."""
        self._say(self._message)
        try:
            return bool(self._replies.get(timeout=0.5))
        except Empty:
            return False

    def topic(self) -> None:
        """There and back."""
        self._say(self._message)
        self._replies.get(timeout=5)

    def service(self) -> None:
        """A call."""
        self._set(self._request)


def main(name: str, domain: str, master: str) -> None:
    """Serve until the input ends."""
    ports = serve(name, domain, master)
    print("ready", flush=True)
    sys.stdin.read()
    ports.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
