"""A published port: its own port of YARP, and a link to each reader.

Readers are subscribed ports of components, programs that the user names, and those that
`yarp connect` adds.
"""

from __future__ import annotations

import threading
from itertools import count
from typing import Any

from robocomp_dsl.runtime.codec.bottle import messages
from robocomp_dsl.runtime.codec.bottle.layout import Layout
from robocomp_dsl.runtime.codec.bottle.profile import Profile
from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.message_stamp import published_stamp
from robocomp_dsl.runtime.middleware.tcp.outgoing_link import CONNECT_S
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost
from robocomp_dsl.runtime.middleware.transport import BoundOperation
from robocomp_dsl.runtime.middleware.yarp import outgoing
from robocomp_dsl.runtime.middleware.yarp.addresses import PortAddress, parse_address
from robocomp_dsl.runtime.middleware.yarp.envelopes import write_envelope
from robocomp_dsl.runtime.middleware.yarp.outgoing import Resolve
from robocomp_dsl.runtime.middleware.yarp.outgoing_message import OutgoingMessage
from robocomp_dsl.runtime.middleware.yarp.output_link import OutputLink
from robocomp_dsl.runtime.middleware.yarp.valid_addresses import CARRIERS
from robocomp_dsl.runtime.presence.port_record import PortRecord


class OutputLinks:
    """The outgoing connections of one port; the `Outputs` of its administrative commands."""

    def __init__(self, at: Endpoint, sender: str, resolve: Resolve) -> None:
        self._at = at
        self._sender = sender
        self._resolve = resolve
        self._lock = threading.Lock()
        self.links: dict[str, OutputLink] = {}
        """The links by the names of their readers."""

    def open(self, address: PortAddress) -> None:
        """Send to a reader from now on, also after it has restarted."""
        link = self._link(address)
        self._replace(address.name, link)
        link.start()

    def _link(self, address: PortAddress, *, ends: bool = False) -> OutputLink:
        on_end = self._remove if ends else None
        return OutputLink(address, self._sender, self._resolve, self._at.qos, on_end)

    def _replace(self, name: str, link: OutputLink) -> None:
        with self._lock:
            former = self.links.get(name)
            self.links = {**self.links, name: link}
        if former:
            former.close()

    def _remove(self, link: OutputLink) -> None:
        with self._lock:
            self.links = {name: each for name, each in self.links.items() if each is not link}

    def add(self, name: str, carrier: str) -> str:
        """See `port.Outputs`; the connection ends with its reader."""
        if not name.startswith("/"):
            return f"Do not know how to connect to {name}"
        address = PortAddress(name, carrier)
        if carrier not in CARRIERS:
            return f"Cannot connect to {name}"
        try:
            found = self._resolve(address)
        except ConnectionLost:
            return f"Do not know how to connect to {name}"
        try:
            stream = outgoing.open_connection(found, self._sender, CONNECT_S)
        except ConnectionLost:
            return f"Cannot connect to {name}"
        link = self._link(address, ends=True)
        self._replace(name, link)
        link.start(stream)
        return ""

    def remove(self, name: str) -> bool:
        """See `port.Outputs`."""
        with self._lock:
            link = self.links.get(name)
            self.links = {key: each for key, each in self.links.items() if key != name}
        if link:
            link.close()
        return link is not None

    def carriers(self) -> dict[str, str]:
        """See `port.Outputs`."""
        return {name: link.address.carrier for name, link in self.links.items()}

    def close(self) -> None:
        """End all connections."""
        with self._lock:
            links, self.links = list(self.links.values()), {}
        for link in links:
            link.close()


class YarpPublisher:
    """A published port."""

    def __init__(
        self,
        at: Endpoint,
        links: OutputLinks,
        address: str,
        close: Any,
        profile: Profile,
        layout: Layout = Layout.YARP,
    ) -> None:
        """`close` ends the port of YARP. Raises `MiddlewareError` for an invalid address."""
        self.address = address
        self._at = at
        self._links = links
        self._close_port = close
        self._profile = profile
        self._layout = layout
        self._numbers = count()
        self._plain = messages.is_plain_topic(at.interface)
        self._attached: dict[PortRecord, str] = {}
        for record in at.external:
            if record.middleware == "yarp":
                links.open(parse_address(record.address, at.name))

    def bind(self, operation: Operation, counts: OperationCounts) -> BoundOperation:
        """See `Publisher`."""
        links, profile = self._links, self._profile
        encoder = messages.plain_encoder if self._plain else messages.request_encoder
        convert = encoder(operation, self._layout)
        stamp_of, numbers = published_stamp(operation), self._numbers

        def encode(arguments: tuple[Any, ...]) -> OutgoingMessage:
            stamp = stamp_of(arguments)
            envelope = write_envelope(stamp, next(numbers)) if stamp else ""
            return OutgoingMessage(convert(arguments), profile, envelope)

        def send(message: OutgoingMessage, _number: bytes) -> None:
            for link in links.links.values():
                link.send(message.on_carrier(link.address.carrier), counts)
            counts.bytes_out += message.size

        return BoundOperation(encode, send)

    def attach(self, subscriber: PortRecord) -> None:
        """See `Publisher`."""
        address = parse_address(subscriber.address, subscriber.name)
        self._attached[subscriber] = address.name
        self._links.open(address)

    def detach(self, subscriber: PortRecord) -> None:
        """See `Publisher`."""
        name = self._attached.pop(subscriber, None)
        if name is not None and name not in self._attached.values():
            self._links.remove(name)

    def has_subscribers(self) -> bool:
        """See `Publisher`."""
        return bool(self._links.links)

    def close(self) -> None:
        """See `Publisher`."""
        self._links.close()
        self._close_port()
