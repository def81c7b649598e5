"""Connections from RoboComp's own configuration keys.

In: the keys of a configuration, and the ports of a component that are on Ice. Out: the settings
with external peers and addresses. What the command line says of a port takes precedence.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace

from robocomp_dsl.runtime.component.settings import ExternalPeer, RunSettings
from robocomp_dsl.runtime.component.spec import CalledPort, ComponentSpec, ServedPort
from robocomp_dsl.runtime.middleware.ice.addresses import ICESTORM
from robocomp_dsl.runtime.parameters.robocomp_keys import ConnectionKeys

NAME = "ice"
_DROPPED = re.compile(r"(?!Ice\.|IceSSL\.)|Ice\.(?:ACM|Warn|ThreadPool|MessageSizeMax|Config)\b")
"""Properties that the transport sets itself, and those of other programs."""


def apply(
    settings: RunSettings,
    spec: ComponentSpec,
    ports: Iterable[ServedPort | CalledPort],
    keys: ConnectionKeys,
) -> RunSettings:
    """`settings` with the connections of `ports`, which are those on Ice."""
    external, addresses = dict(settings.external), dict(settings.addresses)
    for port in ports:
        is_connected = port.name in settings.external or port.name in settings.connections
        if not is_connected and (peer := _peer(port, spec, keys)):
            external[port.name] = (peer,)
        endpoints = _endpoints(port, spec, keys)
        if endpoints and (NAME, port.name) not in addresses:
            addresses[NAME, port.name] = endpoints
    own = {(NAME, key): value for key, value in keys.properties.items() if not _DROPPED.match(key)}
    if keys.topic_manager:
        own[NAME, "TopicManager"] = keys.topic_manager
    return replace(
        settings,
        external=external,
        addresses=addresses,
        transport_settings={**own, **settings.transport_settings},
    )


def _peer(
    port: ServedPort | CalledPort, spec: ComponentSpec, keys: ConnectionKeys
) -> ExternalPeer | None:
    """The program that a port is connected to."""
    interface = _interface(port)
    if port in spec.requires:
        if proxy := keys.proxy_of(port.name, interface):
            return ExternalPeer(proxy.partition(":")[0].split()[0], NAME, proxy)
    elif port not in spec.implements and keys.has_topic(interface):
        return ExternalPeer(f"topic {interface}", NAME, f"{ICESTORM}{interface}")
    return None


def _endpoints(port: ServedPort | CalledPort, spec: ComponentSpec, keys: ConnectionKeys) -> str:
    """Where a port listens; RoboComp's oldest components name their only adapter themselves."""
    interface = _interface(port)
    if port in spec.implements:
        names = [port.name, interface, f"{interface}Comp", spec.name, f"{spec.name}Comp"]
    elif port in spec.subscribes:
        names = [f"{port.name}Topic", f"{interface}Topic"]
    else:
        return ""
    return next((keys.endpoints[n.lower()] for n in names if n.lower() in keys.endpoints), "")


def _interface(port: ServedPort | CalledPort) -> str:
    interface = port.proxy.INTERFACE if isinstance(port, CalledPort) else port.interface
    return interface.name.rpartition("::")[2]
