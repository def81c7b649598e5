"""Keys of RoboComp's configurations that are about connections, and no parameters.

In: the root of a configuration. Out: these keys as `ConnectionKeys`, and the parameters. The keys
have three forms: `LaserProxy = …`, `Laser.Endpoints = …` and `Proxies.Laser = …`.
"""

from __future__ import annotations

import re
from collections.abc import Container, Iterator
from dataclasses import dataclass, field

from robocomp_dsl.runtime.parameters.tree import Mapping, Node, Scalar

_TRANSPORT = r"(?:tcp|udp|ssl|ws|wss|default)\b"
_PROXY = re.compile(rf"\s*[^\s:@]+\s*(?:-\w\s*\S*\s*)*(?::\s*{_TRANSPORT}.*|@.*)", re.DOTALL)
_ENDPOINTS = re.compile(rf"\s*{_TRANSPORT}.*", re.DOTALL)
_ICE = {"ice", "icestorm", "icebox", "icegrid", "icessl", "glacier2"}
_MANAGERS = {"topicmanager", "topicmanagerproxy"}
_PREFIXES = ("PubPrefix", "TopicPrefix", "SubPrefix")


@dataclass(slots=True)
class ConnectionKeys:
    """Addresses by lower-case names of interfaces or components, and properties of Ice.

    `topic_manager` is the proxy of IceStorm's TopicManager, or empty.
    """

    proxies: dict[str, str] = field(default_factory=dict)
    endpoints: dict[str, str] = field(default_factory=dict)
    properties: dict[str, str] = field(default_factory=dict)
    topic_manager: str = ""

    def proxy_of(self, port: str, interface: str) -> str:
        """The proxy of a required port, or empty. RoboComp may number the first port 0."""
        is_numbered = port.startswith(interface) and port[-1].isdigit()
        names = [port] if is_numbered else [port, f"{interface}0", interface]
        return next((self.proxies[n.lower()] for n in names if n.lower() in self.proxies), "")

    def has_topic(self, interface: str) -> bool:
        """Whether a topic goes through IceStorm."""
        return bool(self.topic_manager) or f"{interface}topic".lower() in self.endpoints

    def __bool__(self) -> bool:
        return bool(self.proxies or self.endpoints or self.properties or self.topic_manager)


def read_connection_keys(root: Mapping) -> ConnectionKeys:
    """The keys of a configuration that are about connections."""
    keys = ConnectionKeys()
    for path, text in _scalars(root, ()):
        _sort(path, text, keys)
    return keys


def without_connection_keys(root: Mapping, parameters: Container[str]) -> Mapping:
    """`root` without the members that are only about connections; `parameters` always stay."""
    remaining = {
        name: member
        for name, member in root.members.items()
        if name in parameters or not _is_connection(name, member.value)
    }
    return Mapping(root.place, remaining)


def _is_connection(name: str, value: Node) -> bool:
    """Whether all entries below a key are about connections."""
    entries = list(_scalars(value, (name,))) if isinstance(value, Mapping | Scalar) else []
    return bool(entries) and all(_sort(path, text, ConnectionKeys()) for path, text in entries)


def _scalars(node: Node, path: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], str]]:
    if isinstance(node, Scalar):
        yield path, node.text
    elif isinstance(node, Mapping):
        for name, member in node.members.items():
            yield from _scalars(member.value, (*path, *name.split(".")))


def _sort(path: tuple[str, ...], text: str, keys: ConnectionKeys) -> bool:
    """Add an entry to `keys`; returns whether it is about connections."""
    if any(part.lower() in _MANAGERS for part in path):
        keys.topic_manager = text if _PROXY.fullmatch(text) else keys.topic_manager
        return True
    if path[0].lower() in _ICE:
        keys.properties[".".join(path)] = text
        return True
    if name := _endpoint_name(path):
        if _ENDPOINTS.fullmatch(text):
            keys.endpoints[name.lower()] = text.strip()
        return True
    if name := _proxy_name(path):
        if _PROXY.fullmatch(text):
            keys.proxies[name.lower()] = text.strip()
        return bool(_PROXY.fullmatch(text)) or path[0] == "Proxies"
    return path[-1].endswith(_PREFIXES)


def _endpoint_name(path: tuple[str, ...]) -> str:
    """The name in `Laser.Endpoints` or `Endpoints.Laser`."""
    if len(path) < 2:
        return ""
    if path[0] == "Endpoints":
        return path[-1]
    return ".".join(path[:-1]) if path[-1] == "Endpoints" else ""


def _proxy_name(path: tuple[str, ...]) -> str:
    """The name in `LaserProxy`, `Laser.Proxy` or `Proxies.Laser`."""
    if path[0] == "Proxies" and len(path) == 2:
        return path[1]
    if path[-1] == "Proxy" and len(path) == 2:
        return path[0]
    return path[0].removesuffix("Proxy") if len(path) == 1 and path[0].endswith("Proxy") else ""
