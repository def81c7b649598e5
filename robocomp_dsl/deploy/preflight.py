"""Checks whether this machine can run a deployment, before any process is started.

In: the deployment and its plan. Out: findings, located at the component in the DDSL file or in the
configuration file. Reads files and probes ports; changes nothing.
"""

from __future__ import annotations

import os
import shutil
import socket
from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.deploy import codes
from robocomp_dsl.deploy.middlewares import check_middlewares
from robocomp_dsl.deploy.parameters import runtime_schema
from robocomp_dsl.deploy.plan import Plan, Process
from robocomp_dsl.deploy.port_addresses import check_port_addresses
from robocomp_dsl.deploy.supervisor.scheduling import scheduling_error
from robocomp_dsl.diagnostics import Code, Diagnostic
from robocomp_dsl.finding import Finding
from robocomp_dsl.model.deployment import Deployment, Instance
from robocomp_dsl.runtime.config import ConfigRequest, SearchEnvironment, resolve_config
from robocomp_dsl.runtime.parameters import ConfigError, load_values, overrides
from robocomp_dsl.runtime.presence.domain_names import running_components
from robocomp_dsl.runtime.private_folder import UnsafeFolder
from robocomp_dsl.source import Source, UnreadableSource

DEFAULT_CONFIG = Path("etc") / "config.yaml"
"""The configuration that a component reads by default, if the file exists."""


def preflight(deployment: Deployment, plan: Plan, *, ports: bool = True) -> list[Diagnostic]:
    """All reasons why `plan` cannot run here.

    With `ports`, fixed ports must be free, and names must be unused in the domain.
    """
    findings: list[Diagnostic] = []
    findings += check_middlewares(deployment, KnownMiddlewares())
    for instance, process in zip(deployment.instances, plan.components, strict=True):
        missing = list(_check_executable(instance, process))
        if missing or not instance.is_program:
            findings += missing or check_configuration(instance, process)
        if instance.host.is_local:
            findings += _check_scheduling(instance)
    if ports:
        findings += _check_ports(deployment)
        findings += check_port_addresses(deployment, KnownMiddlewares(), _bind_error)
        findings += _check_names(deployment, plan)
    return findings


def _check_executable(instance: Instance, process: Process) -> Iterator[Diagnostic]:
    if not process.cwd.is_dir():
        yield _diagnostic(instance, codes.EXECUTABLE, f"folder not found: {process.cwd}")
        return
    program = process.argv[0]
    # Only the host itself knows which programs it has.
    is_here = instance.host.is_local or (os.sep in program and not Path(program).is_absolute())
    if is_here and not _program_exists(program, process):
        yield _diagnostic(instance, codes.EXECUTABLE, f"program not found: `{program}`")
    script = process.argv[1] if len(process.argv) > 1 else ""
    if not script.endswith(".py") or (process.cwd / script).is_file():
        return
    cdsl = short_path(instance.component.path)
    if script == "main.py" and not instance.is_program:
        message = f"component not generated: no {script} in the folder of {cdsl}"
        yield _diagnostic(instance, codes.NOT_GENERATED, message, f"rcgen component {cdsl}")
    else:
        message = f"no {script} in {short_path(process.cwd)}"
        yield _diagnostic(instance, codes.EXECUTABLE, message)


def _check_scheduling(instance: Instance) -> Iterator[Diagnostic]:
    limits = instance.limits
    if (limits.cores or limits.realtime) and (problem := scheduling_error(limits)):
        yield _diagnostic(
            instance,
            codes.SCHEDULING,
            problem,
            "allow it in /etc/security/limits.conf: `@realtime - rtprio 99`"
            if "realtime" in problem
            else "write `cores` that the machine has",
        )


def _program_exists(program: str, process: Process) -> bool:
    path = dict(process.env).get("PATH", os.environ.get("PATH"))
    local = process.cwd / program
    return bool(shutil.which(str(local) if os.sep in program else program, path=path))


def check_configuration(instance: Instance, process: Process) -> list[Diagnostic]:
    """Errors in the configuration of an instance, as the component would report them."""
    parameters = instance.component.parameters
    schema = runtime_schema(parameters.parameters) if parameters else ()
    default = process.cwd / DEFAULT_CONFIG
    try:
        config = process.config or search_config(instance.name, process)
        config = config or (default if default.is_file() else None)
    except ConfigError as error:
        return [_config_diagnostic(instance, None, finding) for finding in error.findings]
    try:
        load_values(schema, config, process.settings)
    except ConfigError as error:
        return [_config_diagnostic(instance, config, finding) for finding in error.findings]
    return []


def search_config(name: str, process: Process) -> Path | None:
    """The file that the instance finds in its context; None: its default. Raises `ConfigError`."""
    if not (process.context or process.config_name):
        return None
    names = tuple(dict.fromkeys((process.name, name, process.component)))
    request = ConfigRequest(process.context, process.config_name, names)
    environment = SearchEnvironment.from_environ(os.environ | dict(process.env), process.cwd)
    return resolve_config(request, environment).path


def _config_diagnostic(instance: Instance, config: Path | None, finding: Finding) -> Diagnostic:
    at = finding.location
    span = instance.span
    message = f"{finding.message} (`{instance.name}`)"
    if config and at.file == str(config):
        span = _read_source(config).span_at(at.line, at.column, at.width)
    elif at.file == overrides.SOURCE_NAME:
        message = f"{finding.message} (`set {at.excerpt}` of `{instance.name}`)"
    return Diagnostic(codes.CONFIGURATION, span, message, label=finding.label, help=finding.help)


def _read_source(path: Path) -> Source:
    try:
        return Source.read(path)
    except UnreadableSource:
        return Source(path, "")


def _check_ports(deployment: Deployment) -> Iterator[Diagnostic]:
    for instance in deployment.instances:
        if instance.port and instance.host.is_local and (reason := _bind_error(instance.port)):
            message = f"port {instance.port} cannot be used: {reason}"
            yield _diagnostic(instance, codes.PORT_TAKEN, message)


def _check_names(deployment: Deployment, plan: Plan) -> Iterator[Diagnostic]:
    """Names that components have which already run in the domain."""
    try:
        holders = running_components(plan.domain, [process.name for process in plan.components])
    except UnsafeFolder:
        return  # the start reports it
    known = {holder.name: holder for holder in holders}
    for instance, process in zip(deployment.instances, plan.components, strict=True):
        if holder := known.get(process.name):
            process_text = f" ({holder.describe()})" if holder.describe() else ""
            yield _diagnostic(
                instance,
                codes.NAME_TAKEN,
                f"a component of this name runs in the domain `{plan.domain}`{process_text}",
                "stop that process, or use another --domain",
            )


def _bind_error(port: int) -> str:
    """Why `port` of the loopback address cannot be bound now; empty if it can."""
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", port))
        except (OSError, OverflowError) as error:
            return getattr(error, "strerror", None) or str(error)
    return ""


def _diagnostic(instance: Instance, code: Code, message: str, help: str = "") -> Diagnostic:
    return Diagnostic(code, instance.span, f"`{instance.name}`: {message}", help=help)


def short_path(path: Path) -> str:
    """`path` for messages: resolved, and relative if it is below the working folder."""
    resolved = path.resolve()
    here = Path.cwd()
    return str(resolved.relative_to(here) if resolved.is_relative_to(here) else resolved)
