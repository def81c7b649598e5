"""Changes the connections of a running component.

In: requests of the interface `ComponentConnections`. Out: the settings in force and the open ports
have changed; or a `Refusal` says why not, and nothing has changed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from robocomp_dsl.runtime.component.invalid_setting import InvalidSetting
from robocomp_dsl.runtime.component.naming import resolve_name
from robocomp_dsl.runtime.component.qos_settings import change_items, format_qos
from robocomp_dsl.runtime.component.settings import (
    RunSettings,
    parse_connections,
    parse_external,
    parse_remaps,
)
from robocomp_dsl.runtime.component.spec import CalledPort, ServedPort
from robocomp_dsl.runtime.component.wiring import SEARCHING_ROLES, Wiring
from robocomp_dsl.runtime.connection.component_ports import ComponentPorts
from robocomp_dsl.runtime.connection.connections_interface import Refusal
from robocomp_dsl.runtime.connection.endpoint import NOBODY, Qos
from robocomp_dsl.runtime.connection.peer_selection import matches
from robocomp_dsl.runtime.connection.port_updates import update_port
from robocomp_dsl.runtime.connection.qos_merge import connection_qos, sender_qos
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware import registry

_PEER_ROLES = {"client": "server", "subscriber": "publisher"}


class Rewiring:
    """The requests of one component; they come one at a time."""

    def __init__(self, wiring: Wiring, ports: Callable[[], ComponentPorts]) -> None:
        self._wiring = wiring
        self._ports = ports

    def set_qos(self, port: str, peer: str, changes: str) -> str:
        """See `ComponentConnections.setQos`."""
        found = self._find(port)
        settings = self._wiring.settings
        try:
            if peer:
                name = self._connected_name(found, peer)
                items = dict(settings.peer_qos.get(found.name, {}))
                items[name] = change_items(changes, items.get(name, Qos()))
                settings = replace(settings, peer_qos={**settings.peer_qos, found.name: items})
            else:
                items_of_port = change_items(changes, settings.qos.get(found.name, Qos()))
                settings = replace(settings, qos={**settings.qos, found.name: items_of_port})
        except InvalidSetting as error:
            raise Refusal(str(error)) from None
        self._apply(found, settings)
        at = self._wiring.endpoint(found)
        if self._wiring.role_of(found) == "publisher":
            return format_qos(sender_qos(at))
        return format_qos(connection_qos(at, peer) if peer else at.qos)

    def _connected_name(self, port: ServedPort | CalledPort, peer: str) -> str:
        """The name of a peer for the settings; of a searching port it must be connected."""
        full = peer.removeprefix("/")
        at = self._wiring.endpoint(port)
        if self._wiring.role_of(port) in SEARCHING_ROLES:
            component, _, peer_port = full.rpartition(".")
            external = any(record.name == full for record in at.external)
            if not external and not matches(at, component or full, peer_port):
                listed = ", ".join(at.peers) or "any"
                raise Refusal(f"`{port.name}` is not connected to `{full}`; its peers: {listed}")
            if not at.peers:
                raise Refusal(
                    f"`{port.name}` takes messages of any publisher in one queue; connect it to"
                    f" `{full}` first, or change the whole port"
                )
        return f"/{full}"

    def connect(self, port: str, peer: str, middleware: str) -> None:
        """See `ComponentConnections.connect`."""
        found = self._find_searching(port)
        if middleware and registry.known_capabilities(middleware) is None:
            known = ", ".join(registry.middleware_names())
            raise Refusal(
                f"there is no middleware `{middleware}` here, or it is not installed;"
                f" known: {known}"
            )
        settings = self._wiring.settings
        try:
            internal, external = parse_external((f"{found.name}={peer}",))
            parsed = parse_connections(internal)
        except InvalidSetting as error:
            raise Refusal(str(error)) from None
        for name in parsed.get(found.name, ()):
            full = resolve_name(settings.prefix, name)
            for other in self._full_names(found):
                # Connected twice, it would receive every message twice.
                if _is_same(other, full):
                    raise Refusal(f"`{found.name}` is connected to `{other}` already")
            self._check_middleware(found, full, middleware)
            former = tuple(p for p in settings.connections.get(found.name, ()) if p != NOBODY)
            connections = {**settings.connections, found.name: (*former, f"/{full}")}
            settings = replace(settings, connections=connections)
        for program in external.get(found.name, ()):
            peers = (*settings.external.get(found.name, ()), program)
            settings = replace(settings, external={**settings.external, found.name: peers})
        if middleware:
            chosen = {**settings.port_middlewares, found.name: (middleware,)}
            settings = replace(settings, port_middlewares=chosen)
        self._apply(found, settings)

    def _check_middleware(self, port: ServedPort | CalledPort, peer: str, middleware: str) -> None:
        """Raise `Refusal` if `peer` exists, but on other middlewares than the port will be.

        A peer that does not exist yet may start on any.
        """
        at, role = self._wiring.endpoint(port), self._wiring.role_of(port)
        own = (middleware,) if middleware else at.middlewares
        found = self._ports().presence.registry.find(_PEER_ROLES[role], at.interface.name)
        theirs = dict.fromkeys(r.middleware for r in found if _is_same(r.name, peer))
        if theirs and own and theirs.keys().isdisjoint(own):
            raise Refusal(
                f"`{peer}` is on `{', '.join(theirs)}`, so `{port.name}` cannot be connected to it"
                f" over `{', '.join(own)}`; `--over {next(iter(theirs))}` connects them"
            )

    def disconnect(self, port: str, peer: str) -> None:
        """See `ComponentConnections.disconnect`."""
        found = self._find_searching(port)
        settings = self._wiring.settings
        full = resolve_name(settings.prefix, peer)
        external = settings.external.get(found.name, ())
        remaining = tuple(each for each in external if each.name != peer.removeprefix("/"))
        if len(remaining) < len(external):
            settings = replace(settings, external={**settings.external, found.name: remaining})
        else:
            names = self._full_names(found) or self._known_peers(found)
            same = [n for n in names if _is_same(n, full)]
            if not same:
                listed = ", ".join(n for n in names if n != NOBODY) or "none"
                raise Refusal(
                    f"`{found.name}` is not connected to `{full}`; its connections: {listed}"
                )
            remaining_names = tuple(f"/{name}" for name in names if name not in same)
            connections = {**settings.connections, found.name: remaining_names or (NOBODY,)}
            settings = replace(settings, connections=connections)
        if not remaining and found.name not in settings.connections:
            connections = {**settings.connections, found.name: (NOBODY,)}
            settings = replace(settings, connections=connections)
        self._apply(found, settings)

    def _full_names(self, port: ServedPort | CalledPort) -> tuple[str, ...]:
        """The peers that the port is connected to by name."""
        settings = self._wiring.settings
        return settings.peers_of(port.name) if port.name in settings.connections else ()

    def _known_peers(self, port: ServedPort | CalledPort) -> tuple[str, ...]:
        """The peers that a port has which is connected to any."""
        at, role = self._wiring.endpoint(port), self._wiring.role_of(port)
        found = self._ports().presence.registry.find(_PEER_ROLES[role], at.interface.name)
        names = (r.name for r in found if matches(at, r.component, r.port))
        return tuple(dict.fromkeys(names))

    def remap(self, port: str, name: str) -> None:
        """See `ComponentConnections.remap`."""
        found = self._find(port)
        try:
            parsed = parse_remaps((f"{found.name}={name}",))
        except InvalidSetting as error:
            raise Refusal(str(error)) from None
        settings = self._wiring.settings
        if self._wiring.role_of(found) not in SEARCHING_ROLES:
            for role, other in self._wiring.ports():
                taken = settings.remaps.get(other.name, other.name)
                if role not in SEARCHING_ROLES and other is not found and taken == name:
                    raise Refusal(f"`{other.name}` has the name `{name}` already")
            if name == "Component":
                raise Refusal("every component has a port `Component` already")
        self._apply(found, replace(settings, remaps={**settings.remaps, **parsed}))

    def _find(self, name: str) -> ServedPort | CalledPort:
        """The port of that name, or renamed to it. Raises `Refusal`."""
        remaps = self._wiring.settings.remaps
        ports = [port for _, port in self._wiring.ports()]
        for port in ports:
            if name in (port.name, remaps.get(port.name)):
                return port
        known = ", ".join(port.name for port in ports) or "none"
        raise Refusal(f"{self._wiring.name} has no port `{name}`; its ports: {known}")

    def _find_searching(self, name: str) -> ServedPort | CalledPort:
        port = self._find(name)
        role = self._wiring.role_of(port)
        if role not in SEARCHING_ROLES:
            verb, other = ("serves", "client") if role == "server" else ("publishes", "subscriber")
            raise Refusal(
                f"{self._wiring.name} {verb} `{name}`; the {other} has the connection: change it"
                " there"
            )
        return port

    def _apply(self, port: ServedPort | CalledPort, settings: RunSettings) -> None:
        """Put settings in force. Raises `Refusal`, and then the former are in force.

        A port that is not open yet opens with them.
        """
        wiring = self._wiring
        with wiring.lock:
            former, before = wiring.settings, wiring.endpoint(port)
            wiring.settings = settings
            try:
                if wiring.is_open(port):
                    update_port(self._ports(), wiring.role_of(port), before, wiring.endpoint(port))
                else:
                    wiring.check_qos()
            except MiddlewareError as error:
                wiring.settings = former
                raise Refusal(str(error)) from None


def _is_same(name: str, other: str) -> bool:
    """Whether two names mean the same peer: a component, or a port of it."""
    return name in (other, other.rpartition(".")[0]) or name.startswith(f"{other}.")
