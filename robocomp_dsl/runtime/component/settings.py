"""Run settings of one component, parsed from the command line.

In: items such as `laser=base1` and `laser=front`. Out: `RunSettings`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from robocomp_dsl.runtime.component.invalid_setting import InvalidSetting
from robocomp_dsl.runtime.component.naming import ANY, resolve_name
from robocomp_dsl.runtime.connection.endpoint import NOBODY, Qos
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.time.clock_settings import ClockSettings

if TYPE_CHECKING:
    from robocomp_dsl.runtime.connection.monitor_settings import ConnectionMonitors

NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_.-]{0,99}")
PORT = re.compile(r"[A-Za-z_][A-Za-z0-9_-]{0,99}")
MIDDLEWARE = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,49}")
EXTERNAL = re.compile(
    r"([^=]+)=(?:([A-Za-z_][A-Za-z0-9_.-]{0,99})@)?([A-Za-z][A-Za-z0-9_]{0,49}):(.*)", re.DOTALL
)
MAX_PREFIX_DEPTH = 8
"""Maximum depth of nested namespaces."""


@dataclass(frozen=True, slots=True)
class ExternalPeer:
    """A program that is no component, at an address that its middleware interprets."""

    name: str
    middleware: str
    address: str


@dataclass(frozen=True, slots=True)
class RunSettings:
    """How to run a component. Empty values: the defaults of the component.

    `prefix` is the namespace of the component and its peers (see `naming.resolve_name`); `remaps`
    renames ports: a served port is visible under the new name, any other port looks for it.
    `port_middlewares` are the choices for single ports; `external` are their peers that are no
    components. `addresses` of own ports are by middleware and port, `transport_settings` by
    middleware and key. `peer_qos` is by port and peer. `watchdog` in s: see
    `ComponentSpec`; None: as there.
    """

    name: str = ""
    prefix: str = ""
    domain: str = "default"
    middleware: str = ""
    port_middlewares: dict[str, tuple[str, ...]] = field(default_factory=dict)
    config: Path | None = None
    overrides: tuple[str, ...] = ()
    connections: dict[str, tuple[str, ...]] = field(default_factory=dict)
    qos: dict[str, Qos] = field(default_factory=dict)
    peer_qos: dict[str, dict[str, Qos]] = field(default_factory=dict)
    remaps: dict[str, str] = field(default_factory=dict)
    external: dict[str, tuple[ExternalPeer, ...]] = field(default_factory=dict)
    addresses: dict[tuple[str, str], str] = field(default_factory=dict)
    transport_settings: dict[tuple[str, str], str] = field(default_factory=dict)
    listen_port: int = 0
    watchdog: float | None = None
    clock: ClockSettings = field(default_factory=ClockSettings)
    monitors: tuple[ConnectionMonitors, ...] = ()

    def full_name(self, component: str) -> str:
        """The full name of the instance; `component` is the default name."""
        return resolve_name(self.prefix, self.name or component)

    def external_records(self, port: str, role: str, interface: str) -> tuple[PortRecord, ...]:
        """The external peers of a port as records; `role` is theirs."""
        return tuple(
            PortRecord(role, interface, peer.name, port, "", peer.middleware, peer.address)
            for peer in self.external.get(port, ())
        )

    def middlewares_of(self, port: str, marked: tuple[str, ...], default: str) -> tuple[str, ...]:
        """The middlewares of a port, in order of preference.

        `marked` are those of the CDSL file, `default` is that of the component.
        """
        external = tuple(peer.middleware for peer in self.external.get(port, ()))
        if external and port not in self.connections:
            return tuple(dict.fromkeys(external))
        chosen = self.port_middlewares.get(port, ())
        usual = (self.middleware,) if self.middleware else marked
        return tuple(dict.fromkeys((*(chosen or usual or (default,)), *external)))

    def visible_addresses(self, served: Iterable[str]) -> dict[tuple[str, str], str]:
        """The addresses of own ports by middleware and by the names that others see.

        `served` are the ports that a remap renames.
        """
        names = {port: self.remaps.get(port, port) for port in served}
        return {
            (middleware, names.get(port, port)): address
            for (middleware, port), address in self.addresses.items()
        }

    def peers_of(self, port: str) -> tuple[str, ...]:
        """The peers that an outgoing port is connected to, by full names."""
        if self.connections.get(port) == (NOBODY,):
            return (NOBODY,)
        name = self.remaps.get(port)
        peers = self.connections.get(port, (f"{ANY}.{name}",) if name else ())
        names = (resolve_name(self.prefix, peer) for peer in peers)
        return tuple(
            peer_name if not name or "." in peer_name.rpartition("/")[2] else f"{peer_name}.{name}"
            for peer_name in names
        )

    def connection_qos(self, port: str) -> tuple[tuple[str, Qos], ...]:
        """The quality of service of single connections of a port, by full names of peers."""
        items = self.peer_qos.get(port, {})
        return tuple((resolve_name(self.prefix, peer), qos) for peer, qos in items.items())


def parse_name(text: str, kind: str) -> str:
    """`text` as a name. Raises `InvalidSetting`."""
    if not NAME.fullmatch(text):
        raise InvalidSetting(
            f"`{text}` is not a valid {kind} name: use letters, digits, `_`, `-` and `.`,"
            " not starting with a digit"
        )
    return text


def parse_prefix(text: str) -> str:
    """`left` or `/left/hand` as the prefix of names; `/` is none. Raises `InvalidSetting`."""
    parts = text.strip("/").split("/") if text.strip("/") else []
    if len(parts) > MAX_PREFIX_DEPTH:
        raise InvalidSetting(f"`{text:.80}` has more than {MAX_PREFIX_DEPTH} parts")
    return "/".join(parse_name(part, "prefix") for part in parts)


def parse_remaps(texts: Iterable[str]) -> dict[str, str]:
    """`PORT=NAME`: the names of ports for others. Raises `InvalidSetting`."""
    parsed: dict[str, str] = {}
    for text in texts:
        port, _, name = text.partition("=")
        if not port or not PORT.fullmatch(name):
            raise InvalidSetting(
                f"`{text:.80}` is not a remap; write PORT=NAME, such as Laser=front"
            )
        if parsed.setdefault(port, name) != name:
            raise InvalidSetting(f"`{port}` has two names, {parsed[port]} and {name}")
    return parsed


def parse_peer(text: str) -> str:
    """Check a peer: `base`, `base.Laser`, `hand/base`, or `/right/base` from the root."""
    for name in text.removeprefix("/").split("/"):
        parse_name(name, "component")
    return text


def parse_middlewares(texts: Iterable[str]) -> tuple[str, dict[str, tuple[str, ...]]]:
    """`M` for all ports, `PORT=M,M` for a port, in order of preference. Raises `InvalidSetting`."""
    default = ""
    ports: dict[str, tuple[str, ...]] = {}
    for text in texts:
        port, separator, names = text.rpartition("=")
        middlewares = tuple(names.split(","))
        if not all(MIDDLEWARE.fullmatch(name) for name in middlewares) or (
            not separator and len(middlewares) > 1
        ):
            raise InvalidSetting(f"`{text:.80}` is not a middleware; write NAME, or PORT=NAME,NAME")
        if separator:
            ports[port] = middlewares
        else:
            default = names
    return default, ports


def parse_external(texts: Iterable[str]) -> tuple[list[str], dict[str, tuple[ExternalPeer, ...]]]:
    """Connections to components, unchanged, and those to external peers, by port.

    An external peer is `PORT=M:ADDRESS` or `PORT=NAME@M:ADDRESS`. Raises `InvalidSetting`.
    """
    internal: list[str] = []
    external: dict[str, tuple[ExternalPeer, ...]] = {}
    for text in texts:
        found = EXTERNAL.fullmatch(text)
        if not found:
            internal.append(text)
            continue
        port, name, middleware, address = found.groups()
        peer = ExternalPeer(name or f"{middleware}:{address}", middleware, address.strip())
        if not peer.address:
            raise InvalidSetting(f"`{text:.80}` has no address; write PORT={middleware}:ADDRESS")
        external[port] = (*external.get(port, ()), peer)
    return internal, external


def parse_addresses(texts: Iterable[str]) -> dict[tuple[str, str], str]:
    """`PORT=M:ADDRESS`: addresses of own ports by middleware and port. Raises `InvalidSetting`."""
    parsed: dict[tuple[str, str], str] = {}
    for text in texts:
        found = EXTERNAL.fullmatch(text)
        if not found or found[2] or not found[4].strip():
            raise InvalidSetting(
                f"`{text:.80}` is not an address; write PORT=MIDDLEWARE:ADDRESS,"
                ' such as "Laser=ice:tcp -p 10001"'
            )
        parsed[found[3], found[1]] = found[4].strip()
    return parsed


def parse_transport_settings(texts: Iterable[str]) -> dict[tuple[str, str], str]:
    """`M.KEY=VALUE`: settings of middlewares. Raises `InvalidSetting`."""
    parsed: dict[tuple[str, str], str] = {}
    for text in texts:
        key, separator, value = text.partition("=")
        middleware, dot, name = key.partition(".")
        if not (separator and dot and name and MIDDLEWARE.fullmatch(middleware)):
            raise InvalidSetting(
                f"`{text:.80}` is not a setting of a middleware; write MIDDLEWARE.KEY=VALUE"
            )
        parsed[middleware, name] = value
    return parsed


def with_defaults(defaults: Sequence[str], written: Sequence[str]) -> list[str]:
    """The items `PORT=…` of a command line, and the defaults of ports that it does not mention."""
    ports = {re.split(r"[=/]", text, maxsplit=1)[0] for text in written}
    return [*(d for d in defaults if re.split("[=/]", d, maxsplit=1)[0] not in ports), *written]


def parse_connections(texts: Iterable[str]) -> dict[str, tuple[str, ...]]:
    """`PORT=COMPONENT` or `PORT=COMPONENT.PORT`, several for a port. Raises `InvalidSetting`."""
    parsed: dict[str, tuple[str, ...]] = {}
    for text in texts:
        port, separator, peer = text.partition("=")
        if not separator or not port:
            raise InvalidSetting(
                f"`{text}` is not a connection; write PORT=COMPONENT, such as Laser=base"
            )
        parsed[port] = (*parsed.get(port, ()), parse_peer(peer))
    return parsed
