"""Addresses of ports on YARP. In: text such as `fast_tcp:/robot/laser:o`. Out: their parts."""

from __future__ import annotations

import re
from dataclasses import dataclass

from robocomp_dsl.runtime.errors import MiddlewareError

CARRIERS = ("tcp", "fast_tcp", "text", "text_ack")
_ADDRESS = re.compile(
    r"(?:([a-z_]+):)?(/+[^@\s]+)(?:@(\[[0-9a-fA-F:.]+\]|[^:@\s\[\]]+):(\d{1,5}))?"
)


@dataclass(frozen=True, slots=True)
class PortAddress:
    """A port: its name, and its host and TCP port if they are known without the name server."""

    name: str
    carrier: str = "tcp"
    host: str = ""
    number: int = 0

    def __str__(self) -> str:
        at = f"@{self.host}:{self.number}" if self.number else ""
        return f"{self.carrier}:{self.name}{at}"

    @property
    def socket(self) -> tuple[str, int]:
        """Host and TCP port for `socket.create_connection`."""
        return self.host.strip("[]"), self.number


def parse_address(text: str, port: str) -> PortAddress:
    """`[CARRIER:]/NAME[@HOST:PORT]`. Raises `MiddlewareError`, in which `port` is named."""
    found = _ADDRESS.fullmatch(text.strip())
    if not found or int(found[4] or 0) > 65535:
        raise MiddlewareError(
            f"{port}: `{text}` is no address of YARP; write a name such as /robot/laser:o,"
            " fast_tcp:/robot/laser:o, or /robot/laser:o@10.0.0.2:10005"
        )
    carrier = found[1] or "tcp"
    if carrier not in CARRIERS:
        raise MiddlewareError(
            f"{port}: the carrier `{carrier}` is not supported; known: {', '.join(CARRIERS)}"
        )
    name = "/" + found[2].lstrip("/")
    if name == "/":
        raise MiddlewareError(f"{port}: `{text}` names no port; write such as /robot/laser:o")
    return PortAddress(name, carrier, found[3] or "", int(found[4] or 0))
