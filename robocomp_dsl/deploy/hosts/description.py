"""Describes what each host of a deployment should have. Pure.

In: a deployment, its plan, the trees that are copied, and where Python is on a host. Out: a
`HostManifest` per host, and a finding for each value that a unit cannot hold.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from itertools import groupby

from robocomp_dsl.deploy.content.relocate import relocate
from robocomp_dsl.deploy.content.tree import ContentTree
from robocomp_dsl.deploy.hosts import engine_codes
from robocomp_dsl.deploy.hosts.manifest import HostedComponent, HostManifest
from robocomp_dsl.deploy.plan import Plan, Process
from robocomp_dsl.deploy.units import names
from robocomp_dsl.deploy.units.host_units import host_units
from robocomp_dsl.deploy.units.hosted_process import HOME, HostedProcess
from robocomp_dsl.deploy.units.quoting import UnitValueError
from robocomp_dsl.deploy.units.service import service_unit
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import THIS_MACHINE, Deployment, Host, Instance

LOCAL = Host(THIS_MACHINE, "127.0.0.1")
"""This machine as one of several hosts, whatever names the description has for it."""


@dataclass(frozen=True, slots=True)
class HostSettings:
    """What a host has beside the components. Paths are below `HOME`.

    `python` runs components and helpers, where the plan has `interpreter`; `environment` identifies
    it. `units` are those of the
    network; `network_file` and `certificate` map a component's full name to the file with its
    network settings and the fingerprint of its certificate, "" without.
    """

    python: str
    interpreter: str
    environment: str = ""
    units: tuple[tuple[str, str], ...] = ()
    network_file: Callable[[str], str] = lambda _: ""
    certificate: Callable[[str], str] = lambda _: ""


def needs_hosts(deployment: Deployment) -> bool:
    """Whether a component of the deployment runs on another machine."""
    return any(not instance.host.is_local for instance in deployment.instances)


def host_of(instance: Instance) -> Host:
    """The host of an instance; this machine is one host."""
    return LOCAL if instance.host.is_local else instance.host


def deployment_hosts(deployment: Deployment) -> tuple[Host, ...]:
    """The hosts on which components run, each machine and user once, in order of first use."""
    hosts: dict[tuple[str, str, int], Host] = {}
    for instance in deployment.instances:
        host = host_of(instance)
        hosts.setdefault(_identity(host), host)
    return tuple(hosts.values())


def _identity(host: Host) -> tuple[str, str, int]:
    return host.address, host.user, host.ssh_port


def describe_hosts(
    deployment: Deployment,
    plan: Plan,
    trees: Mapping[str, ContentTree],
    settings: Mapping[str, HostSettings],
    report: Report,
) -> dict[str, HostManifest]:
    """The manifest of each host by its name. `settings` are by the name of the host."""
    hosts = deployment_hosts(deployment)
    name_of = {_identity(host): host.name for host in hosts}
    pairs = [
        (name_of[_identity(host_of(instance))], instance, process)
        for instance, process in zip(deployment.instances, plan.processes, strict=True)
    ]
    pairs.sort(key=lambda pair: [host.name for host in hosts].index(pair[0]))
    manifests = {}
    for name, group in groupby(pairs, key=lambda pair: pair[0]):
        members = [(instance, process) for _, instance, process in group]
        manifests[name] = _describe_host(name, members, plan, trees, settings[name], report)
    return {
        name: HostManifest(
            plan.name, plan.domain, name, hosts, components, units, files, str(plan.path.resolve())
        )
        for name, (components, units, files) in manifests.items()
    }


def _describe_host(
    name: str,
    members: list[tuple[Instance, Process]],
    plan: Plan,
    trees: Mapping[str, ContentTree],
    settings: HostSettings,
    report: Report,
) -> tuple[tuple[HostedComponent, ...], dict[str, str], dict[str, dict[str, str]]]:
    root = f"{HOME}/{names.root_folder(plan.name)}"
    hosted = [_hosted(name, process, trees[process.name], root, settings) for _, process in members]
    valid = [
        each
        for (instance, _), each in zip(members, hosted, strict=True)
        if _is_valid(instance, each, plan.name, report)
    ]
    units = host_units(valid, plan.name, root=root, python=settings.python, more=settings.units)
    components = tuple(_component(name, process, plan, trees) for _, process in members)
    files = {
        tree.hash: {file.path: file.blob[:16] for file in tree.files}
        for tree in (trees[process.name] for _, process in members)
    }
    return components, units, files


def _hosted(
    host: str, process: Process, tree: ContentTree, root: str, settings: HostSettings
) -> HostedProcess:
    there = relocate(
        process,
        tree,
        tree_folder=f"{root}/trees/{tree.hash}",
        python=settings.python,
        interpreter=settings.interpreter,
    )
    return HostedProcess(
        there,
        host,
        root,
        settings.python,
        settings.network_file(process.name),
        settings.certificate(process.name),
        tree.hash,
        settings.environment,
    )


def _is_valid(instance: Instance, hosted: HostedProcess, deployment: str, report: Report) -> bool:
    try:
        service_unit(hosted, deployment, frozenset())
    except UnitValueError as error:
        report.add(
            engine_codes.UNIT_VALUE,
            instance.span,
            f"`{instance.name}`: {error}",
            help="change the value, or keep it in a configuration file",
        )
        return False
    return True


def _component(
    host: str, process: Process, plan: Plan, trees: Mapping[str, ContentTree]
) -> HostedComponent:
    return HostedComponent(
        process.name,
        host,
        names.service_name(plan.name, process.name),
        process.after,
        process.stops_after,
        process.start_timeout_s,
        process.group,
        process.is_program,
        trees[process.name].hash,
        process.member_names,
    )


def all_components(manifests: Iterable[HostManifest]) -> dict[str, HostedComponent]:
    """The components of all hosts by full name."""
    return {c.name: c for manifest in manifests for c in manifest.components}
