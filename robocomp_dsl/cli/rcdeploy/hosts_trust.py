"""`rcdeploy hosts trust`: confirms the SSH keys of hosts. Exit code 1 if one is not confirmed."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import app as rcdeploy_app
from robocomp_dsl.cli.rcdeploy import hosts_deployment

if TYPE_CHECKING:
    from robocomp_dsl.deploy.hosts.errors import HostError
    from robocomp_dsl.deploy.hosts.host_trust import PresentedKey
    from robocomp_dsl.model.deployment import Host

COMPARE = "ssh-keygen -lf /etc/ssh/ssh_host_ed25519_key.pub"


@click.command("trust")
@rcdeploy_app.app
@click.argument("names", nargs=-1, metavar="[HOST]...")
@options.folders
@click.option(
    "--fingerprint",
    "fingerprints",
    multiple=True,
    metavar="SHA256:…",
    help="Confirm the key with this fingerprint, without a question; repeatable.",
)
@click.option("--replace", is_flag=True, help="Replace the confirmed key of a host by another.")
def command(
    app: Path,
    names: tuple[str, ...],
    folders: tuple[Path, ...],
    fingerprints: tuple[str, ...],
    replace: bool,
) -> None:
    """Show the fingerprint of the SSH key of each host, and confirm it.

    Compare the fingerprint with that on the host itself:
    `ssh-keygen -lf /etc/ssh/ssh_host_ed25519_key.pub`. Until a key is confirmed, rcdeploy does not
    connect to the host.
    """
    deployment = hosts_deployment.load(app, folders)
    hosts = [host for host in hosts_deployment.hosts_of(deployment) if not host.is_local]
    selected = hosts_deployment.select(hosts, names)
    if not selected:
        print("all components run on this machine: there is no key to confirm")
        return
    refused = []
    for host, presented in zip(selected, asyncio.run(_fetch(selected)), strict=True):
        if reason := _confirm(host, presented, fingerprints, replace=replace):
            sys.stdout.flush()
            options.print_error(reason)
            refused.append(f"`{host.name}`")
    if refused:
        raise CliError(EXIT_FINDINGS, f"not confirmed: {', '.join(refused)}")


async def _fetch(hosts: Sequence[Host]) -> list[PresentedKey | HostError]:
    from robocomp_dsl.deploy.hosts.errors import HostError  # noqa: PLC0415 - not for --help
    from robocomp_dsl.deploy.hosts.host_trust import fetch_key  # noqa: PLC0415

    async def fetch(host: Host) -> PresentedKey | HostError:
        try:
            return await fetch_key(host)
        except HostError as error:
            return error

    return await asyncio.gather(*map(fetch, hosts))


def _confirm(
    host: Host, presented: PresentedKey | HostError, fingerprints: Sequence[str], *, replace: bool
) -> str:
    """Confirm the key of a host; returns why it is not confirmed."""
    from robocomp_dsl.deploy.hosts import known_hosts  # noqa: PLC0415
    from robocomp_dsl.deploy.hosts.address import describe_host  # noqa: PLC0415

    if isinstance(presented, Exception):
        return f"{presented.message}; {presented.help}" if presented.help else presented.message
    name = describe_host(host)
    if presented.key is None or presented.is_stored():
        print(f"{name}: its key is confirmed already")
        return ""
    kind = known_hosts.key_type(presented.key)
    print(f"{name}: {kind} key {presented.fingerprint}")
    if presented.conflicting and (reason := _check_replace(presented, replace=replace)):
        return f"{name}: {reason}"
    if reason := _compare(presented, fingerprints):
        return f"{name}: {reason}"
    try:
        presented.confirm()
    except OSError as error:
        return f"{name}: the key cannot be stored: {error}"
    print(f"{name}: confirmed, in {known_hosts.own_file()}")
    return ""


def _check_replace(presented: PresentedKey, *, replace: bool) -> str:
    """Warn that another key is confirmed; returns why it is not replaced."""
    from robocomp_dsl.deploy.hosts import known_hosts  # noqa: PLC0415

    print(
        "WARNING: ANOTHER KEY IS CONFIRMED FOR THIS HOST. Either the host was installed again, or\n"
        "another computer pretends to be it. Continue only if you know the reason. Confirmed:"
    )
    for known in presented.conflicting:
        kind = known_hosts.key_type(known.key)
        print(f"  {kind} key {known_hosts.fingerprint(known.key)} in {known.place}")
    if not replace:
        return "another key is confirmed; `--replace` replaces it"
    if foreign := presented.foreign:
        files = dict.fromkeys(str(key.path) for key in foreign)
        remedy = " && ".join(f"ssh-keygen -f {file} -R '{presented.id}'" for file in files)
        return f"the old key is in a file that rcdeploy does not change; remove it: `{remedy}`"
    return ""


def _compare(presented: PresentedKey, fingerprints: Sequence[str]) -> str:
    """Let the user compare the fingerprint; returns why the key is not confirmed."""
    if fingerprints:
        matches = presented.fingerprint in {text.strip().rstrip("=") for text in fingerprints}
        return "" if matches else "its key does not have the fingerprint of `--fingerprint`"
    if not sys.stdin.isatty():
        return (
            "there is no terminal to confirm the key; compare the fingerprint on the host itself "
            f"(`{COMPARE}`), then repeat with `--fingerprint {presented.fingerprint}`"
        )
    print(f"Compare it on the host itself: {COMPARE}")
    return "" if click.confirm("Trust this key?", default=False) else "you did not confirm the key"
