"""All simulated hosts of a test."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import Any

from tests.hosts.rig import accounts
from tests.hosts.rig.machine import SimulatedHost, make_host
from tests.hosts.rig.namespaces import OPERATOR_ADDRESS, TestNetwork


class Hosts:
    """Starts hosts, and ends them.

    `operator` is a home for the person who runs rcdeploy from pytest's own process: its `.ssh` has
    the key that every host accepts (`key`). pytest and what it starts reach the hosts by address.
    """

    def __init__(self, folder: Path, network: TestNetwork) -> None:
        self.folder = folder
        self.operator = folder / "operator"
        self.operator_address = OPERATOR_ADDRESS
        self.key = self.operator / ".ssh/id_ed25519"
        self.by_name: dict[str, SimulatedHost] = {}
        self._network = network
        self.key.parent.mkdir(parents=True, mode=0o700)
        accounts.make_key(self.key, "operator")

    def start(self, name: str, **options: Any) -> SimulatedHost:
        """Boot a host in less than a second.

        Options: `user` (default: `name`), `manager=False` (no `systemd --user`), `linger=False`,
        `sshd=False`, `hidden` (files that do not exist there), `visible` (folders of this machine),
        `checkout=False` (this checkout and its Python are not visible), `disk_bytes` (the size of
        the home, for `limit_disk`).
        """
        assert name not in self.by_name, f"the host {name} exists"
        public_key = Path(f"{self.key}.pub").read_text("ascii")
        host = make_host(self.folder, name, self._network, public_key, **options)
        self.by_name[name] = host
        host.boot()
        return host

    def known_hosts(self) -> str:
        """The lines of a `known_hosts` file with the keys of all hosts."""
        hosts = self.by_name.values()
        return "".join(f"{host.address} {host.host_key()}\n" for host in hosts)

    def trust(self, home: Path | None = None) -> None:
        """Write the keys of all hosts to `~/.ssh/known_hosts` of the operator, or of `home`."""
        folder = (home or self.operator) / ".ssh"
        folder.mkdir(mode=0o700, exist_ok=True)
        (folder / "known_hosts").write_text(self.known_hosts(), "ascii")

    def close(self) -> None:
        """End all hosts."""
        with contextlib.ExitStack() as stack:
            for host in self.by_name.values():
                stack.callback(host.power_off)
