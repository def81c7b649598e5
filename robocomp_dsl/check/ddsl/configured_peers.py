"""Peers that RoboComp's own configuration of an instance names.

In: an instance and one of its ports. Out: whether its configuration has the address of a program
that is no component of the deployment.
"""

from __future__ import annotations

from robocomp_dsl.model.component import Port, Role
from robocomp_dsl.model.deployment import Instance

_OTHER_FORMATS = (".yaml", ".yml", ".json")


def is_configured(instance: Instance, port: Port) -> bool:
    """Whether a required or subscribed port is connected by the configuration."""
    path = instance.config
    if path is None or path.suffix.lower() in _OTHER_FORMATS:
        return False
    from robocomp_dsl.runtime.parameters.load import (  # noqa: PLC0415 - seldom needed
        load_connection_keys,
    )

    keys = load_connection_keys(path)
    if port.role is Role.REQUIRES:
        return bool(keys.proxy_of(port.name, port.interface.name))
    return keys.has_topic(port.interface.name)
