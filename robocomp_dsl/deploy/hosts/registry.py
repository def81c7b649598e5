"""The deployments over hosts that this user has started, so that they can be found by name.

In: the user's state directory (XDG Base Directory Specification). Out: where a deployment is. The
truth is on its hosts; an entry can be deleted at any time, and made again from the DDSL file.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.deploy.hosts.manifest import HostedComponent, host_as_dict, host_from_dict
from robocomp_dsl.model.deployment import Host


@dataclass(frozen=True, slots=True)
class HostedDeployment:
    """A deployment over hosts, as this user knows it.

    `path` is its DDSL file. `places` are the full names of its processes with the host of each;
    `programs` are those that are no components, `members` the components of groups that run in one
    process. `since` in s since 1970; `is_stopped`: the user has stopped it.
    """

    name: str
    path: str
    domain: str
    hosts: tuple[Host, ...]
    places: tuple[tuple[str, str], ...]
    programs: tuple[str, ...] = ()
    members: tuple[tuple[str, tuple[str, ...]], ...] = ()
    since: float = 0.0
    is_stopped: bool = False

    @staticmethod
    def from_components(
        name: str,
        path: str,
        domain: str,
        hosts: tuple[Host, ...],
        components: tuple[HostedComponent, ...],
        since: float,
    ) -> HostedDeployment:
        """The entry of a deployment with these components."""
        places = tuple((c.name, c.host) for c in components)
        programs = tuple(c.name for c in components if c.is_program)
        members = tuple((c.name, c.member_names) for c in components if c.member_names)
        return HostedDeployment(name, path, domain, hosts, places, programs, members, since)


def registry_folder() -> Path:
    """The folder with an entry per deployment; it may not exist."""
    configured = os.environ.get("XDG_STATE_HOME", "")
    # A relative path is invalid by the specification.
    state = Path(configured) if configured.startswith("/") else Path.home() / ".local" / "state"
    return state / "robocomp" / "deployments"


def register(deployment: HostedDeployment) -> None:
    """Store the entry, in place of an earlier one. Raises `OSError`."""
    folder = registry_folder()
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    data = {
        "name": deployment.name,
        "path": deployment.path,
        "domain": deployment.domain,
        "hosts": [host_as_dict(host) for host in deployment.hosts],
        "places": [list(place) for place in deployment.places],
        "programs": list(deployment.programs),
        "members": [[name, list(members)] for name, members in deployment.members],
        "since": deployment.since,
        "is_stopped": deployment.is_stopped,
    }
    new = folder / f".{deployment.name}.{os.getpid()}"
    new.write_text(json.dumps(data, ensure_ascii=False) + "\n", encoding="utf-8")
    new.replace(folder / f"{deployment.name}.json")


def forget(name: str) -> None:
    """Delete the entry."""
    with suppress(OSError):
        (registry_folder() / f"{name}.json").unlink()


def registered() -> Iterator[HostedDeployment]:
    """All entries by name; files that are none are skipped."""
    for path in sorted(registry_folder().glob("*.json")):
        with suppress(OSError, ValueError, TypeError, KeyError):
            data = json.loads(path.read_text(encoding="utf-8"))
            places = tuple((str(name), str(host)) for name, host in data["places"])
            hosts = tuple(map(host_from_dict, data["hosts"]))
            lists = {"hosts": hosts, "places": places, "programs": tuple(data["programs"])}
            members = tuple((name, tuple(names)) for name, names in data["members"])
            yield HostedDeployment(**{**data, **lists, "members": members})
