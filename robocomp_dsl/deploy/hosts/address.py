"""Hosts in messages and commands. In: a host of a description. Out: texts."""

from __future__ import annotations

from robocomp_dsl.model.deployment import Host


def describe_host(host: Host) -> str:
    """The host with its login, for messages: "`robot` (robot@10.0.0.2)"."""
    if host.is_local:
        return f"`{host.name or host.address}` (this machine)"
    login = f"{host.user}@{host.address}" if host.user else host.address
    if host.ssh_port:
        login = f"{login}, port {host.ssh_port}"
    return f"`{host.name}` ({login})"


def ssh_arguments(host: Host) -> str:
    """The arguments of `ssh` and `ssh-copy-id`: `-p 2222 robot@10.0.0.2`."""
    login = f"{host.user}@{host.address}" if host.user else host.address
    return f"-p {host.ssh_port} {login}" if host.ssh_port else login
