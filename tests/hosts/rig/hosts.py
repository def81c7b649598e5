"""All simulated hosts of a test."""

from __future__ import annotations

import contextlib
import sys
from pathlib import Path
from typing import Any

from tests.hosts.rig import accounts
from tests.hosts.rig.boot_settings import BootSettings
from tests.hosts.rig.machine import SimulatedHost
from tests.hosts.rig.namespaces import OPERATOR_ADDRESS, TestNetwork
from tests.hosts.rig.requirements import systemd_program

CHECKOUT = Path(__file__).parents[3]


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


def make_host(
    folder: Path, name: str, network: TestNetwork, authorized_key: str, **options: Any
) -> SimulatedHost:
    """Prepare a host below `folder`; it is not booted. `options` are fields of `BootSettings`."""
    address = network.new_address()
    user = options.pop("user", name)
    uid = 61000 + int(address.rsplit(".", 1)[1])
    files = folder / name
    home = folder / f"{name}-home"
    (files / "etc").mkdir(parents=True)
    home.mkdir()
    accounts.write_accounts(files, user, uid)
    accounts.make_host_key(files)
    accounts.write_sshd_config(files, user)
    accounts.authorize(home, uid, authorized_key)
    visible = [CHECKOUT, Path(sys.base_prefix)] if options.pop("checkout", True) else []
    settings = BootSettings(
        name=name,
        user=user,
        uid=uid,
        files=str(files),
        home=str(home),
        cgroups=[],
        systemd=systemd_program(),
        visible=[*map(str, visible), *map(str, options.pop("visible", ()))],
        hidden=[str(path) for path in options.pop("hidden", ())],
        **options,
    )
    return SimulatedHost(settings, address, network)
