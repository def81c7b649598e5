"""How a program reaches the router of its host: endpoints, and the files of its certificate.

In: the JSON file that `ROBOCOMP_NETWORK` names, or the one that belongs to a domain. Out:
`NetworkSettings`; None without such a file: the domain is on this machine only.

    {"endpoints": ["tls/10.0.0.2:7450"], "ca": "ca.pem", "certificate": "arm.pem", "key": "arm.key"}

Paths are relative to the folder of the file. It names files, and never contains a secret.
"""

from __future__ import annotations

import json
import os
import re
import stat
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import quote

from robocomp_dsl.runtime.errors import MiddlewareError

NETWORK_VARIABLE = "ROBOCOMP_NETWORK"
"""Path of the settings of a component."""
ENDPOINT = re.compile(r"tls/(\[[0-9A-Fa-f:.%a-z]+\]|[^\s\[\]:/?#]+):([0-9]{1,5})")
_FIELDS = ("endpoints", "ca", "certificate", "key")


class InvalidNetwork(MiddlewareError):
    """The settings or a file that they name cannot be used; the message says why."""


@dataclass(frozen=True, slots=True)
class NetworkSettings:
    """A connection to a router with mutual TLS.

    `endpoints` are tried in this order: `tls/HOST:PORT`. `ca`, `certificate` and `key` are PEM
    files; the common name of the certificate is the name of the component.
    """

    endpoints: tuple[str, ...]
    ca: Path
    certificate: Path
    key: Path

    def to_json(self, folder: Path) -> str:
        """The content of a settings file in `folder`; paths below it become relative."""
        data: dict[str, Any] = {"endpoints": list(self.endpoints)}
        for field in _FIELDS[1:]:
            path: Path = getattr(self, field)
            data[field] = str(path.relative_to(folder) if path.is_relative_to(folder) else path)
        return f"{json.dumps(data, indent=1)}\n"

    def check_files(self) -> None:
        """Raise `InvalidNetwork` if a file is missing, or if others can read the key."""
        for path in (self.ca, self.certificate, self.key):
            check_file(path)
        check_private(self.key)


def find_network_settings(
    domain: str, environment: Mapping[str, str] | None = None
) -> NetworkSettings | None:
    """The settings of this process for `domain`; None: no network. Raises `InvalidNetwork`."""
    variables = os.environ if environment is None else environment
    if named := variables.get(NETWORK_VARIABLE):
        return read_network_settings(Path(named))
    path = domain_settings_path(domain, variables)
    return read_network_settings(path) if path.is_file() else None


def domain_settings_path(domain: str, environment: Mapping[str, str] | None = None) -> Path:
    """The file with the operator's settings for a domain; it need not exist."""
    variables = os.environ if environment is None else environment
    configured = variables.get("XDG_STATE_HOME", "")
    state = Path(configured) if configured.startswith("/") else Path.home() / ".local" / "state"
    return state / "robocomp" / "networks" / f"{quote(domain, safe='') or '_'}.json"


def read_network_settings(path: Path) -> NetworkSettings:
    """The settings in a file. Raises `InvalidNetwork`."""
    data = read_json_object(path, _FIELDS)
    endpoints = data["endpoints"]
    if not isinstance(endpoints, list) or not endpoints:
        raise InvalidNetwork(f'{path}: "endpoints" must be a list such as ["tls/10.0.0.2:7450"]')
    for endpoint in endpoints:
        parse_endpoint(endpoint, path)
    files = (_file_in(path, data, field) for field in _FIELDS[1:])
    return NetworkSettings(tuple(endpoints), *files)


def read_json_object(path: Path, fields: tuple[str, ...]) -> dict[str, Any]:
    """The JSON object in a file, which has exactly these fields. Raises `InvalidNetwork`."""
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InvalidNetwork(f"{path} cannot be read: {error.strerror or error}") from None
    except (ValueError, RecursionError) as error:
        raise InvalidNetwork(f"{path} is not valid JSON: {error}") from None
    if not isinstance(data, dict) or set(data) != set(fields):
        raise InvalidNetwork(f"{path} must be a JSON object with exactly: {', '.join(fields)}")
    return data


def parse_endpoint(endpoint: object, place: object) -> tuple[str, int]:
    """Host and port of `tls/HOST:PORT`; `place` is for the message. Raises `InvalidNetwork`."""
    match = ENDPOINT.fullmatch(endpoint) if isinstance(endpoint, str) else None
    if match is None or not 0 < int(match[2]) < 65536:
        raise InvalidNetwork(
            f"{place}: {json.dumps(endpoint)} is not an endpoint; write tls/HOST:PORT, such as"
            ' "tls/10.0.0.2:7450": without TLS there is no connection between hosts'
        )
    return match[1].strip("[]"), int(match[2])


def _file_in(path: Path, data: Mapping[str, Any], field: str) -> Path:
    name = data[field]
    if not isinstance(name, str) or not name:
        raise InvalidNetwork(f'{path}: "{field}" must be the path of a file')
    return path.parent / name


def check_file(path: Path) -> None:
    """Raise `InvalidNetwork` if the file cannot be read."""
    try:
        with path.open("rb"):
            pass
    except OSError as error:
        reason = error.strerror or error
        raise InvalidNetwork(
            f"{path} cannot be read: {reason}; `rcdeploy keys APP.ddsl` makes the certificates, and"
            " `rcdeploy APP.ddsl up` copies them"
        ) from None


def check_private(path: Path) -> None:
    """Raise `InvalidNetwork` if other users can read or write a key."""
    mode = stat.S_IMODE(path.stat().st_mode)
    if mode & 0o077:
        raise InvalidNetwork(
            f"{path} is a private key that other users can use (mode {mode:o}): run `chmod 600"
            f" {path}`, and if others use this machine, also `rcdeploy keys APP.ddsl --renew`"
        )
