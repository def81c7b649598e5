"""Addresses of ports on YARP. In: text such as `fast_tcp:/robot/laser:o`. Out: their parts."""

from __future__ import annotations

from dataclasses import dataclass

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.yarp.valid_addresses import ADDRESS, address_problem


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
    found = ADDRESS.fullmatch(text.strip())
    problem = address_problem(text)
    if not found or problem:
        raise MiddlewareError(f"{port}: {problem}")
    name = "/" + found[2].lstrip("/")
    return PortAddress(name, found[1] or "tcp", found[3] or "", int(found[4] or 0))
