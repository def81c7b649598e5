"""The Ice settings of a configuration: endpoints and proxies.

In: a `Config`. Out: its endpoints and proxies as `Address`es, and the entries that are parameters.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.config import Config, ConfigEntry
from robocomp_dsl.source import Span

_TRANSPORT = r"(?:tcp|udp|ssl|ws|wss|default|opaque)"
_PROXY = re.compile(rf"\s*([^\s:@]+)\s*(?:-\w\s*\S*\s*)*(?::\s*({_TRANSPORT}\b.*)|@.*)?", re.DOTALL)
_ENDPOINT = re.compile(rf"\s*{_TRANSPORT}\b.*|\s*", re.DOTALL)
_OPTION = re.compile(r"-([hp])\s*(\S+)")
_ICE_PREFIXES = {"ice", "icestorm", "icebox", "icegrid", "icessl", "glacier2"}
_BROKERS = {"topicmanager", "topicmanagerproxy"}


@dataclass(frozen=True, slots=True)
class Address:
    """An endpoint. `name` is the interface in the key, `identity` Ice's object name."""

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


def split_ice_settings(config: Config, report: Report) -> tuple[IceSettings, list[ConfigEntry]]:
    """The settings of Ice, and the entries that are parameters."""
    endpoints: list[Address] = []
    proxies: list[Address] = []
    parameters: list[ConfigEntry] = []
    for entry in config.entries:
        address = _entry_address(entry)
        if address is not None:
            (endpoints if _is_endpoint(entry) else proxies).append(address)
        elif _is_ice_setting(entry):
            report.add(codes.ICE_SETTING, entry.span, f"`{entry.key}` is no longer needed")
        else:
            parameters.append(entry)
    return IceSettings(tuple(endpoints), tuple(proxies)), parameters


def parse_address(name: str, text: str, span: Span) -> Address | None:
    """Parse `laser:tcp -h localhost -p 10003` or an endpoint; None for any other text."""
    match = _PROXY.fullmatch(text)
    if match and match[2]:
        identity, endpoint = str(match[1]), str(match[2])
    elif re.match(rf"\s*{_TRANSPORT}\b", text):
        identity, endpoint = "", text
    else:
        return None
    options = dict(reversed(_OPTION.findall(endpoint.partition(":")[0])))
    port = options.get("p", "0")
    number = int(port) if port.isascii() and port.isdigit() and len(port) < 6 else 0
    return Address(name, identity, options.get("h", ""), number, span)


def _is_endpoint(entry: ConfigEntry) -> bool:
    return entry.path[-1] == "Endpoints" or (entry.path[0] == "Endpoints" and len(entry.path) > 1)


def _entry_address(entry: ConfigEntry) -> Address | None:
    """The address of an entry; None if the entry is not an address."""
    if not isinstance(entry.value, str) or _is_broker(entry):
        return None
    if _is_endpoint(entry):
        name = entry.path[-1] if entry.path[0] == "Endpoints" else ".".join(entry.path[:-1])
        return (
            parse_address(name, entry.value, entry.span)
            if _ENDPOINT.fullmatch(entry.value)
            else None
        )
    port = _proxy_name(entry)
    address = parse_address(port, entry.value, entry.span) if port else None
    return address if address and address.identity else None


def _proxy_name(entry: ConfigEntry) -> str | None:
    """The port that a key names: `LaserProxy`, `Laser.Proxy`, `Proxies.Laser`."""
    if entry.path[0] == "Proxies" and len(entry.path) == 2:
        return entry.path[1]
    if entry.path[-1] == "Proxy" and len(entry.path) == 2:
        return entry.path[0]
    key = entry.path[-1]
    return key.removesuffix("Proxy") if key.endswith("Proxy") and len(entry.path) == 1 else None


def _is_broker(entry: ConfigEntry) -> bool:
    return any(part.lower() in _BROKERS for part in entry.path)


def _is_ice_setting(entry: ConfigEntry) -> bool:
    """Whether only Ice reads an entry. All entries of Ice's own tables are such."""
    first = entry.path[0].lower()
    if first in _ICE_PREFIXES or _is_broker(entry) or (len(entry.path) > 1 and first == "proxies"):
        return True
    prefix = entry.path[-1].endswith(("PubPrefix", "TopicPrefix", "SubPrefix"))
    return _is_endpoint(entry) or prefix or entry.path == ("Proxies",)
