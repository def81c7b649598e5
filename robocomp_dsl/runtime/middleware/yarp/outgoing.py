"""Opens connections to other ports, for messages over tcp, fast_tcp, text and text_ack.

In: an address. Out: a connection whose set-up is complete, and the bytes of messages on it.
"""

from __future__ import annotations

import time
from collections.abc import Callable

from robocomp_dsl.runtime.codec.bottle.text_reader import read_text
from robocomp_dsl.runtime.codec.bottle.text_writer import write_text
from robocomp_dsl.runtime.codec.bottle.values import Bottle
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost
from robocomp_dsl.runtime.middleware.yarp import wire
from robocomp_dsl.runtime.middleware.yarp.addresses import PortAddress
from robocomp_dsl.runtime.middleware.yarp.name_client import NameClient, NameServerLost
from robocomp_dsl.runtime.middleware.yarp.stream import YarpStream

Resolve = Callable[[PortAddress], PortAddress]
_WORDS = {"text": "CONNECT", "text_ack": "CONNACK"}


def resolver(names: NameClient) -> Resolve:
    """A function that adds host and TCP port to an address; it raises `ConnectionLost`."""

    def resolve(address: PortAddress) -> PortAddress:
        if address.number:
            return address
        try:
            found = names.query(address.name, address.carrier)
        except NameServerLost as error:
            raise ConnectionLost(f"the name server cannot be reached: {error}") from None
        if found is None:
            raise ConnectionLost(f"the name server knows no port {address.name}")
        return found

    return resolve


def open_connection(address: PortAddress, sender: str, timeout: float) -> YarpStream:
    """A connection to a port. Raises `ConnectionLost`."""
    deadline = time.monotonic() + timeout
    stream = YarpStream.connect(address.socket, timeout)
    stream.deadline = deadline
    try:
        _set_up(stream, address.carrier, sender)
    except BaseException:
        stream.close()
        raise
    stream.deadline = None
    return stream


def _set_up(stream: YarpStream, carrier: str, sender: str) -> None:
    if carrier in _WORDS:
        stream.send_line(f"{_WORDS[carrier]} {sender}")
        stream.line()
        return
    stream.send(wire.set_up(carrier, sender))
    if wire.read_number(stream.take(8)) is None:
        raise ConnectionLost("the peer is no port of YARP, or accepts no tcp")


def message_bytes(carrier: str, bottle: Bottle, binary: bytes, command: str) -> bytes:
    """One message for a carrier; `binary` are the bytes of the Bottle."""
    if carrier in _WORDS:
        return f"{command}\r\n{write_text(bottle)}\r\n".encode(errors="surrogateescape")
    return wire.frame(binary, command)


def end_bytes(carrier: str) -> bytes:
    """The message that ends a connection."""
    return b"q\r\n" if carrier in _WORDS else wire.frame(b"", "q")


def read_ack(stream: YarpStream, carrier: str) -> None:
    """Read the acknowledgement of a message, if the carrier has one. Raises `ConnectionLost`."""
    if carrier == "tcp":
        if stream.take(8) != wire.ACK:
            raise ConnectionLost("the peer sent no acknowledgement")
    elif carrier == "text_ack":
        while stream.line() != "<ACK>":
            pass


def ask_admin(address: PortAddress, sender: str, command: Bottle, timeout: float) -> Bottle:
    """The reply of a port to an administrative command. Raises `ConnectionLost`."""
    text = PortAddress(address.name, "text_ack", address.host, address.number)
    stream = open_connection(text, sender, timeout)
    stream.deadline = time.monotonic() + timeout
    try:
        stream.send(message_bytes("text_ack", command, b"", "a"))
        reply = stream.line()
        return read_text(reply) if reply != "<ACK>" else []
    finally:
        stream.close()
