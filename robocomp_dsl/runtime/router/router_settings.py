"""Settings of a router: where it listens, which routers it connects to, who may use which keys.

In: a JSON file, which `rcdeploy` writes. Out: `RouterSettings`. A router listens with mutual TLS
and with access control, or not at all.

    {"name": "router.robot", "listen": ["tls/10.0.0.2:7450", "tls/127.0.0.1:7450"], "connect": [],
     "ca": "ca.pem", "certificate": "router.robot.pem", "key": "router.robot.key",
     "access": {"default_permission": "deny", "enabled": true, "rules": [...], ...}}
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robocomp_dsl.runtime.presence.network_settings import (
    InvalidNetwork,
    NetworkSettings,
    parse_endpoint,
    read_json_object,
)

RELOADED, NOT_RELOADED = "uses new settings", "the router goes on with the former settings"
"""One of both is in the log line at the end of a reload."""
_FIELDS = ("name", "listen", "connect", "ca", "certificate", "key", "access")


@dataclass(frozen=True, slots=True)
class RouterSettings:
    """One router. `access` is the section `access_control` of zenoh's configuration.

    `files` are its certificate, and its `endpoints` those at which it listens. `connect` are the
    endpoints of the routers that it connects to.
    """

    name: str
    files: NetworkSettings
    connect: tuple[str, ...]
    access: dict[str, Any]

    @property
    def listen(self) -> tuple[str, ...]:
        """The endpoints at which the router listens."""
        return self.files.endpoints


def read_router_settings(path: Path) -> RouterSettings:
    """The settings in a file. Raises `InvalidNetwork`, also if a file that they name is missing."""
    data = read_json_object(path, _FIELDS)
    for field in ("listen", "connect"):
        if not isinstance(data[field], list):
            raise InvalidNetwork(f'{path}: "{field}" must be a list of endpoints')
        for endpoint in data[field]:
            parse_endpoint(endpoint, path)
    if not data["listen"]:
        raise InvalidNetwork(f'{path}: "listen" is empty: the router could not be reached')
    for field in ("name", "ca", "certificate", "key"):
        if not isinstance(data[field], str) or not data[field]:
            raise InvalidNetwork(f'{path}: "{field}" must be a text')
    access = data["access"]
    if (
        not isinstance(access, dict)
        or access.get("enabled") is not True
        or access.get("default_permission") != "deny"
    ):
        raise InvalidNetwork(
            f'{path}: "access" must have "enabled": true and "default_permission": "deny": a router'
            " without access control does not listen"
        )
    folder = path.parent
    files = NetworkSettings(
        tuple(data["listen"]),
        folder / data["ca"],
        folder / data["certificate"],
        folder / data["key"],
    )
    files.check_files()
    return RouterSettings(data["name"], files, tuple(data["connect"]), access)
