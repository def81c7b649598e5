"""What a configuration says to Ice: where the component listens, and whom it calls.

In: a `Config`. Out: its endpoints and proxies as `Address`es, and the entries that are parameters.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.config import Config, Entry
from robocomp_dsl.source import Span

_TRANSPORT = r"(?:tcp|udp|ssl|ws|wss|default|opaque)"
_PROXY = re.compile(rf"\s*([^\s:@]+)\s*(?:-\w\s*\S*\s*)*(?::\s*({_TRANSPORT}\b.*)|@.*)?", re.DOTALL)
_ENDPOINT = re.compile(rf"\s*{_TRANSPORT}\b.*|\s*", re.DOTALL)
_OPTION = re.compile(r"-([hp])\s*(\S+)")
_FOR_ICE = {"ice", "icestorm", "icebox", "icegrid", "icessl", "glacier2"}
_BROKERS = {"topicmanager", "topicmanagerproxy"}


@dataclass(frozen=True, slots=True)
class Address:
    """Where something listens. `name` is the interface of the key, `identity` Ice's object name."""

    name: str
    identity: str
    host: str
    port: int
    span: Span


@dataclass(frozen=True, slots=True)
class IceSettings:
    """The addresses of one configuration."""

    endpoints: tuple[Address, ...] = ()
    proxies: tuple[Address, ...] = ()


def divide(config: Config, report: Report) -> tuple[IceSettings, list[Entry]]:
    """The settings of Ice, and the entries that are none."""
    endpoints: list[Address] = []
    proxies: list[Address] = []
    parameters: list[Entry] = []
    for one in config.entries:
        found = _address(one)
        if found is not None:
            (endpoints if _is_endpoint(one) else proxies).append(found)
        elif _is_for_ice(one):
            report.add(codes.ICE_SETTING, one.span, f"`{one.key}` is not needed any more")
        else:
            parameters.append(one)
    return IceSettings(tuple(endpoints), tuple(proxies)), parameters


def address(name: str, text: str, span: Span) -> Address | None:
    """The address in `laser:tcp -h localhost -p 10003` or in an endpoint; None if it is none."""
    match = _PROXY.fullmatch(text)
    if match and match[2]:
        identity, endpoint = str(match[1]), str(match[2])
    elif re.match(rf"\s*{_TRANSPORT}\b", text):
        identity, endpoint = "", text
    else:
        return None
    options = dict(reversed(_OPTION.findall(endpoint.partition(":")[0])))
    port = options.get("p", "0")
    whole = int(port) if port.isascii() and port.isdigit() and len(port) < 6 else 0
    return Address(name, identity, options.get("h", ""), whole, span)


def _is_endpoint(one: Entry) -> bool:
    return one.path[-1] == "Endpoints" or (one.path[0] == "Endpoints" and len(one.path) > 1)


def _address(one: Entry) -> Address | None:
    """The address that an entry gives; None for an entry that is something else."""
    if not isinstance(one.value, str) or _is_broker(one):
        return None
    if _is_endpoint(one):
        name = one.path[-1] if one.path[0] == "Endpoints" else ".".join(one.path[:-1])
        return address(name, one.value, one.span) if _ENDPOINT.fullmatch(one.value) else None
    called = _proxy_name(one)
    found = address(called, one.value, one.span) if called else None
    return found if found and found.identity else None


def _proxy_name(one: Entry) -> str | None:
    """The port that an entry is about by its name: `LaserProxy`, `Laser.Proxy`, `Proxies.Laser`."""
    if one.path[0] == "Proxies" and len(one.path) == 2:
        return one.path[1]
    if one.path[-1] == "Proxy" and len(one.path) == 2:
        return one.path[0]
    joined = one.path[-1]
    return joined.removesuffix("Proxy") if joined.endswith("Proxy") and len(one.path) == 1 else None


def _is_broker(one: Entry) -> bool:
    return any(part.lower() in _BROKERS for part in one.path)


def _is_for_ice(one: Entry) -> bool:
    """Whether only Ice reads an entry; so it does one of its tables whatever is in it."""
    first = one.path[0].lower()
    if first in _FOR_ICE or _is_broker(one) or (len(one.path) > 1 and first == "proxies"):
        return True
    prefix = one.path[-1].endswith(("PubPrefix", "TopicPrefix", "SubPrefix"))
    return _is_endpoint(one) or prefix or one.path == ("Proxies",)
