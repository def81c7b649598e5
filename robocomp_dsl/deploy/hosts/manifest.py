"""A version of a deployment on one host, as data. Pure.

In: JSON, as it is stored on the host. Out: components, units and the files of their trees. The
manifest is all that another operator needs: which hosts there are, and in which order components
start and stop.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from robocomp_dsl.model.deployment import Host


class InvalidManifest(Exception):
    """The text is no manifest; the message says why."""


@dataclass(frozen=True, slots=True)
class HostedComponent:
    """A component or program on a host.

    `after`: components that are ready before it starts; `stops_after`: those that have exited
    before it stops. `tree` is the hash of its files; `member_names` are the components of a group
    that runs in one process.
    """

    name: str
    host: str
    unit: str
    after: tuple[str, ...] = ()
    stops_after: tuple[str, ...] = ()
    start_timeout_s: float = 60.0
    group: str = ""
    is_program: bool = False
    tree: str = ""
    member_names: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class HostManifest:
    """What a deployment has on one host, in a version. `version` 0: it is not stored yet.

    `created` in s since 1970, `author` is the user that deployed it, `path` the DDSL file there.
    `trees` maps the hash of a tree to the hashes of its files by path.
    """

    deployment: str
    domain: str
    host: str
    hosts: tuple[Host, ...]
    components: tuple[HostedComponent, ...]
    units: Mapping[str, str]
    trees: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    path: str = ""
    version: int = 0
    created: float = 0.0
    author: str = ""

    def numbered(self, version: int, created: float, author: str) -> HostManifest:
        """The manifest as it is stored."""
        return replace(self, version=version, created=created, author=author)

    def to_json(self) -> str:
        """The text that is stored on the host."""
        data = {
            "deployment": self.deployment,
            "domain": self.domain,
            "host": self.host,
            "hosts": [host_as_dict(host) for host in self.hosts],
            "components": [asdict(component) for component in self.components],
            "units": dict(self.units),
            "trees": {tree: dict(files) for tree, files in self.trees.items()},
            "path": self.path,
            "version": self.version,
            "created": self.created,
            "author": self.author,
        }
        return json.dumps(data, indent=1, ensure_ascii=False) + "\n"

    @staticmethod
    def from_json(text: str) -> HostManifest:
        """The inverse of `to_json`. Raises `InvalidManifest`."""
        try:
            data = json.loads(text)
            return HostManifest(
                **{
                    **data,
                    "hosts": tuple(map(host_from_dict, data["hosts"])),
                    "components": tuple(map(_component, data["components"])),
                }
            )
        except (ValueError, TypeError, KeyError) as error:
            raise InvalidManifest(f"not a manifest: {error}") from None


def _component(fields: Mapping[str, Any]) -> HostedComponent:
    lists = ("after", "stops_after", "member_names")
    return HostedComponent(**{**fields, **{key: tuple(fields[key]) for key in lists}})


def host_as_dict(host: Host) -> dict[str, Any]:
    """What is needed to connect to a host."""
    return {
        "name": host.name,
        "address": host.address,
        "user": host.user,
        "port": host.port,
        "ssh_port": host.ssh_port,
    }


def host_from_dict(fields: Mapping[str, Any]) -> Host:
    """The inverse of `host_as_dict`. Raises `KeyError` or `TypeError`."""
    return Host(
        name=str(fields["name"]),
        address=str(fields["address"]),
        user=str(fields.get("user", "")),
        port=int(fields.get("port", 0)),
        ssh_port=int(fields.get("ssh_port", 0)),
    )
