"""Addresses of hosts in a description: `10.0.0.2`, `robot.local:2222`, `[fd00::2]:22`."""

from __future__ import annotations

import re
from dataclasses import dataclass

from robocomp_dsl.model.deployment import Host

DEFAULT_PORT = 22
_WITH_PORT = re.compile(r"\[(?P<v6>[^\]]+)\](?::(?P<v6_port>\d+))?|(?P<name>[^:]+):(?P<port>\d+)")


@dataclass(frozen=True, slots=True)
class SshAddress:
    """`name`: a host name, an IP address or an alias of `~/.ssh/config`; `port` 0: default."""

    name: str
    port: int = 0

    def __str__(self) -> str:
        if not self.port:
            return self.name
        return f"[{self.name}]:{self.port}" if ":" in self.name else f"{self.name}:{self.port}"


def ssh_address(address: str) -> SshAddress:
    """Split the address of a host; other ports than that of SSH are no part of it."""
    match = _WITH_PORT.fullmatch(address.strip())
    if not match:
        return SshAddress(address.strip())
    return SshAddress(match["v6"] or match["name"], int(match["v6_port"] or match["port"] or 0))


def describe_host(host: Host) -> str:
    """`robot` with its address, for messages: "`robot` (robot@10.0.0.2)"."""
    if host.is_local:
        return f"`{host.name or host.address}` (this machine)"
    login = f"{host.user}@{host.address}" if host.user else host.address
    return f"`{host.name}` ({login})"
