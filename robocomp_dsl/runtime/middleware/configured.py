"""Connections that a configuration file states, for the middlewares that know such keys.

In: the settings of the command line, and the configuration. Out: the settings with both.
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.spec import CalledPort, ComponentSpec, ServedPort
from robocomp_dsl.runtime.middleware import registry


def with_configured_connections(
    settings: RunSettings, spec: ComponentSpec, config: Path | None
) -> RunSettings:
    """`settings` with the connections in `config` of ports whose middleware reads them."""
    ports: dict[str, list[ServedPort | CalledPort]] = {}
    for port in spec.ports:
        for name in settings.middlewares_of(port.name, port.middlewares, spec.middleware):
            ports.setdefault(name, []).append(port)
    readers = {name: registry.description_of(name) for name in ports}
    used = {name: found.configuration for name, found in readers.items() if found}
    if config is None or not any(used.values()):
        return settings
    from robocomp_dsl.runtime.parameters.load import load_connection_keys  # noqa: PLC0415

    keys = load_connection_keys(config)
    for name, function in used.items():
        if function and keys:
            module, _, attribute = function.partition(":")
            apply = getattr(import_module(module), attribute)
            settings = apply(settings, spec, ports[name], keys)
    return settings
