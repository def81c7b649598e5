"""Addresses of ports on Ice.

In: texts of users and of port records. Out: their parts. The record of a served port has one or
two lines: the proxy for queries, and that for commands if they differ.
"""

from __future__ import annotations

import re
from typing import NamedTuple

ICESTORM = "icestorm:"
"""Start of the address of a topic of IceStorm."""
_ENDPOINT = re.compile(r"\s*(?:tcp|ssl|ws|wss|udp|default)\b")
_TCP = re.compile(r"\s*(?:tcp|ssl|ws|wss|default)\b")
_PORT = re.compile(r"\s-p\s*([0-9]{1,5})(?=\s|$)")
_PROXY = re.compile(
    r"\s*[^\s:@/]+(?:/[^\s:@/]+)?(?:\s+-[a-zA-Z](?:\s*[^\s:@-][^\s:@]*)?)*\s*(?:@[^\s:]+\s*|:(.*)|)",
    re.DOTALL,
)
_IDENTITY = re.compile(r"\s*([^\s:@]+)\s*:(.*)", re.DOTALL)


class FixedAddress(NamedTuple):
    """Where the user wants a port: its object identity and the endpoints of its adapter."""

    identity: str
    endpoints: str


def parse_fixed(text: str, port: str) -> FixedAddress:
    """`tcp -p 10001`, or `laser:tcp -p 10001`; RoboComp names the object after the interface.

    Raises `ValueError` with the valid form.
    """
    if _ENDPOINT.match(text):
        return FixedAddress(port.lower(), text.strip())
    match = _IDENTITY.fullmatch(text)
    if match and _ENDPOINT.match(match[2]):
        return FixedAddress(match[1], match[2].strip())
    raise ValueError(f"`{text}` is no address of Ice; write such as `tcp -p 10001`")


def tcp_ports(text: str) -> list[int]:
    """The fixed TCP ports where a port at this address listens."""
    endpoints = [part for part in re.split(r":", text) if _TCP.match(part)]
    numbers = [match[1] for part in endpoints if (match := _PORT.search(part))]
    return [int(number) for number in numbers if int(number)]


def join_proxies(queries: str, commands: str) -> str:
    """The address of a served port."""
    return queries if commands == queries else f"{queries}\n{commands}"


def split_proxies(address: str) -> tuple[str, str]:
    """The proxies of an address for queries and for commands."""
    queries, _, commands = address.partition("\n")
    return queries, commands or queries


def address_problem(address: str) -> str:
    """What is wrong with a proxy, an endpoint or a topic of IceStorm; empty if nothing is."""
    if address.startswith(ICESTORM):
        return "" if address.removeprefix(ICESTORM).strip() else f"`{address}` names no topic"
    if any(int(number) > 65535 for number in re.findall(r"\s-p\s*([0-9]+)", address)):
        return f"`{address}` has a TCP port above 65535"
    proxy = _PROXY.fullmatch(address)
    endpoints = (proxy[1] or "") if proxy else address
    if _ENDPOINT.match(endpoints) or (proxy and not endpoints.strip()):
        return ""  # a proxy without endpoints is resolved by the locator
    return (
        f"`{address}` is no address of Ice; write such as `laser:tcp -h 10.0.0.2 -p 10001`,"
        " or `tcp -p 10001` for an own port"
    )
