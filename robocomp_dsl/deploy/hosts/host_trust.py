"""Confirming the key of a host. In: a host. Out: its key, and what is known of it.

The key is only fetched here; the user compares its fingerprint with that on the host itself.
"""

from __future__ import annotations

import contextlib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from robocomp_dsl.deploy.hosts import codes, known_hosts
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.deploy.hosts.known_hosts import KnownKey
from robocomp_dsl.deploy.hosts.ssh_client import HostKeyCheck, open_connection
from robocomp_dsl.model.deployment import Host

if TYPE_CHECKING:
    from asyncssh import SSHKey


@dataclass(frozen=True, slots=True)
class PresentedKey:
    """The key that a host shows; `key` None: it is confirmed. `id`: its name in the files.

    `conflicting`: other keys that are confirmed for the host.
    """

    host: Host
    id: str
    key: SSHKey | None = None
    conflicting: list[KnownKey] = field(default_factory=list)

    @property
    def fingerprint(self) -> str:
        """`SHA256:…` of a key that is not confirmed."""
        return known_hosts.fingerprint(self.key) if self.key else ""

    @property
    def foreign(self) -> list[KnownKey]:
        """The conflicting keys in files that rcdeploy does not write."""
        return [key for key in self.conflicting if key.path != known_hosts.own_file()]

    def is_stored(self) -> bool:
        """Whether the key was confirmed a moment ago, for another host at the same address."""
        name, _, port = self.id.removeprefix("[").partition("]:")
        known = known_hosts.find_keys(name, "", int(port or 0))
        return any(key.key == self.key for key in known)

    def confirm(self) -> None:
        """Store the key in place of those of robocomp's own file. Raises `OSError`."""
        if self.key:
            known_hosts.remove_keys(self.conflicting)
            known_hosts.add_key(self.id, self.key)


async def fetch_key(host: Host) -> PresentedKey:
    """Ask `host` for its key; nothing is sent to it. Raises `HostError` if none is shown."""
    check = HostKeyCheck()
    error = await _attempt(host, check)
    if error is None or error.code is codes.LOGIN:
        return PresentedKey(host, check.id)
    if check.presented is None or any(key.kind == known_hosts.REVOKED for key in check.known):
        raise error
    conflicting = [key for key in check.known if not key.kind]
    return PresentedKey(host, check.id, check.presented, conflicting)


async def _attempt(host: Host, check: HostKeyCheck) -> HostError | None:
    try:
        connection = await open_connection(host, check)
    except HostError as error:
        return error
    connection.close()
    with contextlib.suppress(OSError):
        await connection.wait_closed()
    return None
