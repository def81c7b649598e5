"""The network of a deployment on its hosts: private files, and the routers that use them.

In: a deployment, its domain, its keys. Out: for each host the files below `private`, and what units
need to know of them. Reads the keys; changes nothing.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field

from robocomp_dsl.deploy.network.access_rules import AccessRules, access_rules
from robocomp_dsl.deploy.network.identities import (
    common_name,
    host_name,
    needs_network,
    router_name,
    used_hosts,
)
from robocomp_dsl.deploy.network.key_folder import AUTHORITY, KeyFolder, file_name
from robocomp_dsl.deploy.network.router_plan import (
    AUTHORITY_FILE,
    component_settings,
    identity_files,
    router_settings,
)
from robocomp_dsl.deploy.plan import Plan, Process
from robocomp_dsl.model.deployment import Deployment, Host, Instance

PRIVATE = "private"
"""Below the folder of the deployment; only its user can read it."""


@dataclass(frozen=True, slots=True)
class HostNetwork:
    """The network of one host. `files` maps paths below the deployment's folder to contents.

    Files with settings have a part of their hash in their names, so that those of earlier versions
    stay as they are. Certificates and keys are always the newest.
    `settings` maps a process to its file, `revisions` to what identifies the file and the
    certificate. `router` is the name of the router's certificate, "" without a network.
    """

    files: Mapping[str, bytes] = field(default_factory=dict)
    settings: Mapping[str, str] = field(default_factory=dict)
    revisions: Mapping[str, str] = field(default_factory=dict)
    router: str = ""


def host_networks(deployment: Deployment, plan: Plan, folder: KeyFolder) -> dict[str, HostNetwork]:
    """The network of each host by its name. The keys exist. Raises `OSError`."""
    if not needs_network(deployment):
        return {}
    rules = access_rules(deployment, plan.domain)
    instances = {instance.full_name: instance for instance in deployment.instances}
    owners = [(process, instances[first_component(process)]) for process in plan.processes]
    return {
        host_name(host): _host_network(deployment, host, owners, rules, folder)
        for host in used_hosts(deployment)
    }


def first_component(process: Process) -> str:
    """The full name of a component of the process, which is on the same host as the others."""
    return (*process.member_names, process.name)[0]


def _host_network(
    deployment: Deployment,
    host: Host,
    owners: list[tuple[Process, Instance]],
    rules: AccessRules,
    folder: KeyFolder,
) -> HostNetwork:
    files = {f"{PRIVATE}/{AUTHORITY_FILE}": folder.certificate(AUTHORITY).read_bytes()}
    router = router_name(host)
    own = _identity(router, folder)
    text = router_settings(deployment, host, rules).encode()
    settings = {router: f"{PRIVATE}/router-{_revision(text)}.json"}
    files |= own | {settings[router]: text}
    revisions = {router: f"{_revision(text)}-{_revision(*own.values())}"}
    for process, instance in owners:
        if process.is_program or host_name(instance.host) != host_name(host):
            continue
        own = _identity(common_name(process.name), folder)
        text = component_settings(deployment, instance).encode()
        name = file_name(process.name)
        settings[process.name] = f"{PRIVATE}/network-{name}-{_revision(text)}.json"
        files |= own | {settings[process.name]: text}
        revisions[process.name] = _revision(text, *own.values())
    return HostNetwork(files, settings, revisions, router)


def _identity(name: str, folder: KeyFolder) -> dict[str, bytes]:
    """The certificate and the key of an identity, by their paths on the host."""
    sources = (folder.certificate(name), folder.key(name))
    return {
        f"{PRIVATE}/{file}": source.read_bytes()
        for file, source in zip(identity_files(name), sources, strict=True)
    }


def _revision(*contents: bytes) -> str:
    return hashlib.sha256(b"\0".join(contents)).hexdigest()[:16]
