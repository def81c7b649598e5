"""The exchange of headers at the start of a TCPROS connection.

In: a connection and what we are. Out: the header of the peer, or the reason why it does not fit.
"""

from __future__ import annotations

import time

from robocomp_dsl.runtime.errors import MalformedMessage
from robocomp_dsl.runtime.middleware.ros1 import tcpros
from robocomp_dsl.runtime.middleware.ros1.message_types import ANY, Ros1Type
from robocomp_dsl.runtime.middleware.ros1.tcpros import TcprosStream
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost

ERROR_KEY = "error"


class Refused(ConnectionLost):
    """The peer does not accept the connection, for a reason that it tells."""


def exchange_headers(
    stream: TcprosStream, header: dict[str, str], timeout: float
) -> dict[str, str]:
    """Send a header and read that of the peer. Raises `ConnectionLost`, `Refused` if it refuses."""
    stream.deadline = time.monotonic() + timeout
    stream.send(tcpros.encode_header(header))
    try:
        reply = stream.header()
    except MalformedMessage as error:
        raise ConnectionLost(f"the peer is no ROS node: {error}") from None
    if ERROR_KEY in reply:
        raise Refused(reply[ERROR_KEY])
    stream.deadline = None
    return reply


def refuse(stream: TcprosStream, reason: str) -> None:
    """Tell the peer why it is not accepted. Raises `ConnectionLost`."""
    stream.send(tcpros.encode_header({ERROR_KEY: reason}))


def refusal(name: str, type_: Ros1Type, header: dict[str, str], does: str) -> str:
    """Why the header of a peer does not fit to a topic or service; empty if it does.

    `does` tells what the peer does with it. The md5 decides, as in roscpp and rospy; `*` fits.
    """
    md5 = header.get("md5sum", "")
    if not md5:
        return f"the header of {header.get('callerid', 'the peer')} has no md5sum"
    their_type = header.get("type", ANY)
    if md5 == ANY or (md5 == type_.md5 and their_type in {ANY, type_.name}):
        return ""
    return (
        f"{header.get('callerid', 'a node')} {does} {name} as {their_type} with md5sum {md5}, but"
        f" {name} is {type_.name} with md5sum {type_.md5}"
    )
