"""Prepares a deployment for containers.

In: a checked deployment. Out: an `ExportedDeployment`, and findings about what is lost. Reads the
files of the components.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

from robocomp_dsl.deploy.content.describe import describe_trees
from robocomp_dsl.deploy.content.relocate import relocate
from robocomp_dsl.deploy.content.tree import ContentTree
from robocomp_dsl.deploy.export import codes
from robocomp_dsl.deploy.export.model import (
    CONTENT,
    NETWORK_SOURCE,
    ROUTER,
    ConfigFile,
    ExportedDeployment,
    ExportedProcess,
)
from robocomp_dsl.deploy.export.names import service_name, service_names
from robocomp_dsl.deploy.export.network import moved_to
from robocomp_dsl.deploy.export.requirements import locked_requirements
from robocomp_dsl.deploy.hosts.host_network import first_component
from robocomp_dsl.deploy.plan import Plan, Process, plan
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Deployment, Host, Instance

PYTHON = "python3"
HASH_DIGITS = 16
CONFINED = ("local",)
"""Middlewares of one machine."""
ANYWHERE = ("zenoh", "inproc")
"""Middlewares that need nothing: `inproc` is inside of a process."""
_DEVICE = re.compile(r"/dev/[A-Za-z0-9_./-]+")
_SECRET = re.compile(r"(PASSWORD|PASSPHRASE|SECRET|TOKEN|API_?KEY)$", re.IGNORECASE)
_WATCHDOG_VARIABLE = "WATCHDOG_USEC"
DEFAULT_CONFIG = Path("etc/config.yaml")


def prepare(
    deployment: Deployment, name: str, domain: str, host: Host, report: Report
) -> ExportedDeployment:
    """The deployment with all components at `host`, which stands for the containers."""
    moved = moved_to(deployment, host)
    planned = plan(moved, name=name, domain=domain, interpreter=PYTHON)
    trees = describe_trees(moved, planned, report)
    services = service_names((p.name for p in planned.processes), reserved=(ROUTER,))
    instances = {instance.full_name: instance for instance in deployment.instances}
    processes = tuple(
        _export(
            instances[first_component(process)],
            process,
            trees[process.name],
            services[process.name],
            report,
        )
        for process in planned.processes
    )
    _check_reach(deployment, planned, report)
    _check_programs(processes, report)
    requirements = locked_requirements(moved, planned, trees, report)
    return ExportedDeployment(service_name(name), domain, moved, processes, requirements)


def _export(
    instance: Instance, process: Process, tree: ContentTree, service: str, report: Report
) -> ExportedProcess:
    folder = f"{CONTENT}/{tree.hash[:HASH_DIGITS]}"
    there = relocate(process, tree, tree_folder=folder, python=PYTHON, interpreter=PYTHON)
    there, secrets = _without_secrets(instance, _without_port(instance, there, report), report)
    texts = [*there.argv, *(value for _, value in there.env), *_device_values(instance)]
    devices = sorted({match for text in texts for match in _DEVICE.findall(text)})
    return ExportedProcess(
        service, there, instance, tree, tuple(_configs(tree, there)), tuple(devices), secrets
    )


def _device_values(instance: Instance) -> Iterator[str]:
    for device in instance.devices.devices:
        yield from (str(value) for _, value in device.parameters)


def _without_port(instance: Instance, process: Process, report: Report) -> Process:
    """Without `--listen-port`: components connect through the router."""
    if not process.port:
        return process
    report.add(
        codes.INEXPRESSIBLE,
        instance.span,
        f"`port {process.port}` of `{instance.name}` is not exported",
        help="components and tools connect through the router",
    )
    at = process.argv.index("--listen-port")
    return replace(process, argv=process.argv[:at] + process.argv[at + 2 :], port=0)


def _without_secrets(
    instance: Instance, process: Process, report: Report
) -> tuple[Process, tuple[str, ...]]:
    secrets = tuple(name for name, _ in process.env if _SECRET.search(name))
    for name in secrets:
        report.add(
            codes.SECRET,
            instance.span,
            f"the value of `{name}` of `{instance.name}` is not exported",
            help="keep it in a file that the component reads",
        )
    left_out = {*secrets, _WATCHDOG_VARIABLE}
    variables = tuple(pair for pair in process.env if pair[0] not in left_out)
    return replace(process, env=variables), secrets


def _configs(tree: ContentTree, process: Process) -> Iterator[ConfigFile]:
    """The configuration of a component, which can be changed without a new image."""
    if process.is_program or process.members:
        return
    own = process.config or process.cwd / DEFAULT_CONFIG
    root = f"{CONTENT}/{tree.hash[:HASH_DIGITS]}"
    for file in tree.files:
        if f"{root}/{file.path}" == str(own):
            yield ConfigFile(Path(file.source), str(own))


def _check_reach(deployment: Deployment, planned: Plan, report: Report) -> None:
    """Report what containers keep apart."""
    for name in planned.middlewares:
        if name in CONFINED:
            report.add(
                codes.UNREACHABLE,
                deployment.span,
                f"`{name}` does not connect containers",
                help="use zenoh, or export to systemd",
            )
        elif name not in ANYWHERE:
            report.add(
                codes.MAYBE_UNREACHABLE,
                deployment.span,
                f"ports over `{name}` are reached at addresses of the containers",
                help="check the addresses in the description and in the configuration",
            )
    for external in deployment.externals:
        report.add(
            codes.MAYBE_UNREACHABLE,
            external.span,
            f"the external program `{external.name}` is outside of the containers",
            help=f'its address is "{external.address}"' if external.address else "",
        )
    for connection in deployment.external_connections:
        report.add(
            codes.INEXPRESSIBLE,
            connection.span,
            f"nobody connects {connection.source} -> {connection.target}",
            help="rcdeploy makes this connection only for deployments that it runs itself",
        )


def _check_programs(processes: Iterable[ExportedProcess], report: Report) -> None:
    """Report programs that are neither Python nor among the copied files."""
    for each in processes:
        program = each.process.argv[0]
        copied = {f"./{file.path}" for file in each.tree.files}
        if program != PYTHON and "/" not in program and f"./{program}" not in copied:
            report.add(
                codes.INEXPRESSIBLE,
                each.instance.span,
                f"the program `{program}` of `{each.instance.name}` is not in the image",
                help="build an image that has it, FROM the generated one",
            )


def container_command(process: Process, *, network: bool) -> list[str]:
    """The command line of the first process of the container."""
    command = [PYTHON, "-m", "robocomp_dsl.deploy.container.init", *_init_flags(process)]
    if network:
        command += ["--network", NETWORK_SOURCE]
    return [*command, "--", *process.argv]


def _init_flags(process: Process) -> Iterable[str]:
    readiness = process.readiness
    if process.watchdog_s:
        yield from ("--watchdog", f"{process.watchdog_s:g}")
    if readiness.pattern:
        yield from ("--ready-log", readiness.pattern)
    if readiness.port:
        yield from ("--ready-port", str(readiness.port))
    if readiness.delay_s:
        yield from ("--ready-after", f"{readiness.delay_s:g}")
    if process.limits.cores:
        yield from ("--cores", ",".join(map(str, process.limits.cores)))
    if process.limits.realtime:
        yield from ("--realtime", str(process.limits.realtime))
