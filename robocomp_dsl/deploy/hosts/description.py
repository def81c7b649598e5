"""Describes what each host of a deployment should have. Pure.

In: a deployment, its plan, the trees that are copied, and where Python is on a host. Out: a
`HostManifest` per host, and a finding for each value that a unit cannot hold.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from itertools import groupby

from robocomp_dsl.deploy.content.relocate import relocate
from robocomp_dsl.deploy.content.tree import ContentTree
from robocomp_dsl.deploy.hosts import codes_engine
from robocomp_dsl.deploy.hosts.host_network import HostNetwork, first_component
from robocomp_dsl.deploy.hosts.manifest import HostedComponent, HostManifest
from robocomp_dsl.deploy.hosts.registry import HostedDeployment
from robocomp_dsl.deploy.network.identities import host_name, used_hosts
from robocomp_dsl.deploy.plan import Plan, Process
from robocomp_dsl.deploy.units import names
from robocomp_dsl.deploy.units.host_units import host_units
from robocomp_dsl.deploy.units.hosted_process import HOME, HostedProcess
from robocomp_dsl.deploy.units.quoting import UnitValueError
from robocomp_dsl.deploy.units.router import START_TIMEOUT_S, HostedRouter, router_unit
from robocomp_dsl.deploy.units.service import service_unit
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Deployment, Host, Instance


@dataclass(frozen=True, slots=True)
class HostSettings:
    """What a host has beside the components.

    `interpreter` is the Python of the plan; `runtime` is the hash of the environment that runs
    helpers and programs, `environments` are those of components by name of the process.
    `controllers` are those of cgroups that the manager of the host may set.
    """

    interpreter: str
    runtime: str
    environments: Mapping[str, str] = field(default_factory=dict)
    network: HostNetwork = field(default_factory=HostNetwork)
    controllers: tuple[str, ...] = ()

    def environment_of(self, process: str) -> str:
        """The hash of the environment in which a process runs."""
        return self.environments.get(process, self.runtime)


def environment_python(root: str, environment: str) -> str:
    """The Python of an environment; `root` is the folder of the deployment."""
    return f"{root}/environments/{environment}/bin/python"


def deployment_hosts(deployment: Deployment) -> tuple[Host, ...]:
    """The hosts on which components run; the names of this machine are one host, `localhost`."""
    return tuple(host.replace(name=host_name(host)) for host in used_hosts(deployment))


def processes_of(host: str, deployment: Deployment, plan: Plan) -> list[Process]:
    """The processes that run on a host."""
    return [process for name, _, process in _pairs(deployment, plan) if name == host]


def _pairs(deployment: Deployment, plan: Plan) -> list[tuple[str, Instance, Process]]:
    """Host, an instance of it, and the process, for each process."""
    instances = {instance.full_name: instance for instance in deployment.instances}
    pairs = []
    for process in plan.processes:
        instance = instances[first_component(process)]
        pairs.append((host_name(instance.host), instance, process))
    return pairs


def describe_hosts(
    deployment: Deployment,
    plan: Plan,
    trees: Mapping[str, ContentTree],
    settings: Mapping[str, HostSettings],
    report: Report,
) -> dict[str, HostManifest]:
    """The manifest of each host by its name. `settings` are by the name of the host."""
    hosts = deployment_hosts(deployment)
    pairs = _pairs(deployment, plan)
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
    routers, more = _describe_router(name, plan, root, settings)
    python = environment_python(root, settings.runtime)
    units = host_units(
        valid,
        plan.name,
        root=root,
        python=python,
        more=more,
        controllers=settings.controllers,
    )
    required = tuple(router.name for router in routers)
    components = [_component(name, process, plan, trees, required) for _, process in members]
    users = tuple(component.name for component in components)
    routers = [replace(router, stops_after=users) for router in routers]
    files = {
        tree.hash: {file.path: file.blob[:16] for file in tree.files}
        for tree in (trees[process.name] for _, process in members)
    }
    return (*routers, *components), units, files


def _describe_router(
    host: str, plan: Plan, root: str, settings: HostSettings
) -> tuple[list[HostedComponent], tuple[tuple[str, str], ...]]:
    """The router of a host and its unit; none without a network."""
    network = settings.network
    if not network.router:
        return [], ()
    router = HostedRouter(
        network.router,
        root,
        environment_python(root, settings.runtime),
        f"{root}/{network.settings[network.router]}",
        network.revisions[network.router],
        settings.runtime,
    )
    unit = names.router_name(plan.name)
    component = HostedComponent(
        network.router, host, unit, start_timeout_s=START_TIMEOUT_S, is_program=True
    )
    return [component], ((unit, router_unit(router, plan.name)),)


def _hosted(
    host: str, process: Process, tree: ContentTree, root: str, settings: HostSettings
) -> HostedProcess:
    there = relocate(
        process,
        tree,
        tree_folder=f"{root}/trees/{tree.hash}",
        python=environment_python(root, settings.environment_of(process.name)),
        interpreter=settings.interpreter,
    )
    network = settings.network.settings.get(process.name, "")
    return HostedProcess(
        there,
        host,
        root,
        environment_python(root, settings.runtime),
        f"{root}/{network}" if network else "",
        settings.network.revisions.get(process.name, ""),
        tree.hash,
        settings.environment_of(process.name),
    )


def _is_valid(instance: Instance, hosted: HostedProcess, deployment: str, report: Report) -> bool:
    try:
        service_unit(hosted, deployment, frozenset())
    except UnitValueError as error:
        report.add(
            codes_engine.UNIT_VALUE,
            instance.span,
            f"`{instance.name}`: {error}",
            help="change the value, or keep it in a configuration file",
        )
        return False
    return True


def _component(
    host: str,
    process: Process,
    plan: Plan,
    trees: Mapping[str, ContentTree],
    required: tuple[str, ...],
) -> HostedComponent:
    return HostedComponent(
        process.name,
        host,
        names.service_name(plan.name, process.name),
        (*required, *process.after),
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


def described_entry(deployment: Deployment, plan: Plan) -> HostedDeployment:
    """How to reach a deployment that somebody has started from this description."""
    components = tuple(
        HostedComponent(
            process.name,
            host,
            names.service_name(plan.name, process.name),
            is_program=process.is_program,
            member_names=process.member_names,
        )
        for host, _, process in _pairs(deployment, plan)
    )
    path = str(plan.path.resolve())
    hosts = deployment_hosts(deployment)
    return HostedDeployment.from_components(plan.name, path, plan.domain, hosts, components, 0.0)
