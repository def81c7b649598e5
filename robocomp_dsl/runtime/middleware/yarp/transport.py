"""All YARP ports of one component.

A topic is the port `/component/Port:o` at its publisher and `/component/Port:i` at its subscribers,
a service `/component/Port/rpc:i`. Components find each other by the addresses in their records; the
name server is for the programs of YARP.
"""

from __future__ import annotations

import threading
from collections.abc import Callable

from robocomp_dsl.runtime.codec.bottle.layout import Layout
from robocomp_dsl.runtime.codec.bottle.profile import PROFILE_3, PROFILES
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.incoming_port import IncomingPort
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.transport import TransportContext
from robocomp_dsl.runtime.middleware.yarp.addresses import PortAddress, parse_address
from robocomp_dsl.runtime.middleware.yarp.client import YarpServiceClient
from robocomp_dsl.runtime.middleware.yarp.name_client import NameClient, name_server_address
from robocomp_dsl.runtime.middleware.yarp.outgoing import resolver
from robocomp_dsl.runtime.middleware.yarp.port import YarpPort
from robocomp_dsl.runtime.middleware.yarp.port_protocols import Outputs, Receiver
from robocomp_dsl.runtime.middleware.yarp.publisher import OutputLinks, YarpPublisher
from robocomp_dsl.runtime.middleware.yarp.registration import Registration
from robocomp_dsl.runtime.middleware.yarp.service import OperationReceiver
from robocomp_dsl.runtime.presence.port_record import PortRecord

_SETTINGS = ("host", "layout", "layout.PORT", "name_server", "start_name_server", "version")
_LAYOUT = "layout"
_HOST = "127.0.0.1"


def open_transport(context: TransportContext) -> YarpTransport:
    """The transport of one component. Raises `MiddlewareError` for an invalid setting."""
    return YarpTransport(context)


class YarpServer:
    """A served or subscribed port."""

    def __init__(self, address: str, close: Callable[[], None]) -> None:
        self.address = address
        self.close = close


class YarpTransport:
    """See `transport.Transport`."""

    def __init__(self, context: TransportContext) -> None:
        self._context = context
        settings = context.settings
        for key in settings:
            if key not in _SETTINGS and not key.startswith(f"{_LAYOUT}."):
                raise MiddlewareError(
                    f"unknown setting `yarp.{key}`; known: {', '.join(_SETTINGS)}"
                )
        version = settings.get("version", "3")
        if version not in PROFILES:
            raise MiddlewareError(f"`yarp.version={version}`: write 3 or 4, as the other programs")
        starts = settings.get("start_name_server", "false")
        if starts not in {"true", "false"}:
            raise MiddlewareError(f"`yarp.start_name_server={starts}`: write true or false")
        self._layouts = {
            key.removeprefix(_LAYOUT).removeprefix("."): _layout(key, text)
            for key, text in settings.items()
            if key.partition(".")[0] == _LAYOUT
        }
        self._profile = PROFILES.get(version, PROFILE_3)
        self._host = settings.get("host", _HOST)
        self._names = NameClient(name_server_address(settings.get("name_server", "")))
        self._own_name_server: YarpPort | None = None
        if starts == "true":
            from robocomp_dsl.runtime.middleware.yarp.name_server import (  # noqa: PLC0415
                start_unless_running,
            )

            self._own_name_server = start_unless_running(self._names.at)
        self._resolve = resolver(self._names)
        self._registration = Registration(self._names, self._resolve)
        self._lock = threading.Lock()
        self._clients: list[YarpServiceClient] = []
        self.outputs: dict[str, OutputLinks] = {}
        """The outgoing connections of published ports, by port."""
        self.received: dict[str, YarpPort] = {}
        """Served and subscribed ports."""

    def _layout_of(self, at: Endpoint) -> Layout:
        """The layout of the messages of a port: its own, that of its interface, or the common."""
        if own := self._layouts.get(at.port):
            return own
        if at.interface.style == Layout.THRIFT.value:
            return Layout.THRIFT
        return self._layouts.get("", Layout.YARP)

    def serve(self, port: IncomingPort) -> YarpServer:
        """See `Transport`."""
        receiver = OperationReceiver(port, self._layout_of(port.at), is_service=True)
        return self._receive(port.at, receiver, "/rpc:i", [])

    def subscribe(self, port: IncomingPort) -> YarpServer:
        """See `Transport`."""
        publishers = [
            parse_address(record.address, port.at.name)
            for record in port.at.external
            if record.middleware == "yarp"
        ]
        receiver = OperationReceiver(port, self._layout_of(port.at), is_service=False)
        return self._receive(port.at, receiver, ":i", publishers)

    def _receive(
        self,
        at: Endpoint,
        receiver: OperationReceiver,
        suffix: str,
        publishers: list[PortAddress],
    ) -> YarpServer:
        try:
            opened = self._open(at, suffix, receiver, None, publishers)
        except MiddlewareError:
            receiver.close()
            raise

        self.received[at.port] = opened

        def close() -> None:
            self._registration.remove(opened)
            receiver.close()
            opened.close()

        return YarpServer(_record_address(opened), close)

    def _open(
        self,
        at: Endpoint,
        suffix: str,
        receiver: Receiver | None,
        outputs: Outputs | None,
        publishers: list[PortAddress] | None = None,
    ) -> YarpPort:
        """A port of YARP. Raises `MiddlewareError` if it cannot listen."""
        name = f"/{at.component.strip('/')}/{at.port}{suffix}"
        where = (self._host, 0)
        if text := self._context.addresses.get(at.port):
            address = parse_address(text, at.name)
            name = address.name
            if address.number:
                where = address.socket
        is_rpc = suffix == "/rpc:i"
        try:
            port = YarpPort(name, where, receiver, outputs, self._profile, is_rpc=is_rpc)
        except MiddlewareError as error:
            raise MiddlewareError(f"{at.name}: {error}") from None
        self._registration.add(port, publishers)
        return port

    def connect(self, at: Endpoint, server: PortRecord, timeout: float) -> YarpServiceClient:
        """See `Transport`."""
        sender = f"/{at.component.strip('/')}/{at.port}/rpc:o"
        client = YarpServiceClient(
            at, server, sender, self._resolve, self._profile, timeout, self._layout_of(at)
        )
        with self._lock:
            self._clients.append(client)
        return client

    def advertise(self, at: Endpoint) -> YarpPublisher:
        """See `Transport`."""
        sender = f"/{at.component.strip('/')}/{at.port}:o"
        if text := self._context.addresses.get(at.port):
            sender = parse_address(text, at.name).name
        links = self.outputs[at.port] = OutputLinks(at, sender, self._resolve)
        port = self._open(at, ":o", None, links)

        def close() -> None:
            self._registration.remove(port)
            port.close()

        return YarpPublisher(
            at, links, _record_address(port), close, self._profile, self._layout_of(at)
        )

    def close(self) -> None:
        """See `Transport`."""
        with self._lock:
            clients, self._clients = self._clients, []
        for client in clients:
            client.close()
        self._registration.close()
        if self._own_name_server:
            self._own_name_server.close()


def _layout(key: str, text: str) -> Layout:
    """The value of a setting. Raises `MiddlewareError`."""
    try:
        return Layout(text)
    except ValueError:
        known = ", ".join(Layout)
        raise MiddlewareError(f"`yarp.{key}={text}`: write one of {known}") from None


def _record_address(port: YarpPort) -> str:
    """The address of a port for other components."""
    host = f"[{port.host}]" if ":" in port.host else port.host
    return str(PortAddress(port.name, "fast_tcp", host, port.number))
