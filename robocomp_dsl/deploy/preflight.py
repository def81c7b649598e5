"""What this machine lacks to run a deployment; nothing is started if there is anything.

In: the deployment and its plan. Out: findings, at the component in the DDSL file or at the place in
the configuration file. Reads files and tries ports, changes nothing.
"""

from __future__ import annotations

import os
import shutil
import socket
from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.deploy import codes
from robocomp_dsl.deploy.parameters import schema
from robocomp_dsl.deploy.plan import Plan, Process
from robocomp_dsl.diagnostics import Code, Diagnostic, Note
from robocomp_dsl.model.deployment import Deployment, Instance
from robocomp_dsl.runtime.config import Asked, choose, surroundings
from robocomp_dsl.runtime.parameters import ConfigError, Finding, load_values, overrides
from robocomp_dsl.source import Source, Span, UnreadableSource

OWN_CONFIG = Path("etc") / "config.yaml"
"""What a component reads without being told to, if it is there."""
WATCHED = ("zenoh",)
"""Middlewares over which rcdeploy sees whether a component is ready."""


def preflight(deployment: Deployment, plan: Plan, *, ports: bool = True) -> list[Diagnostic]:
    """Everything that would keep `plan` from running here. `ports`: they must be free."""
    found: list[Diagnostic] = []
    if deployment.middleware not in WATCHED:
        said = f"components on `{deployment.middleware}` cannot be deployed as processes"
        way_out = f"leave `middleware` out, or write one of: {', '.join(WATCHED)}"
        found.append(Diagnostic(codes.MIDDLEWARE, deployment.span, said, help=way_out))
    for instance, process in zip(deployment.instances, plan.processes, strict=True):
        if not instance.host.is_here:
            found.append(_elsewhere(instance))
            continue
        missing = list(_executable(instance, process))
        found += missing or configuration(instance, process)
    found += _ports(deployment) if ports else ()
    return found


def _elsewhere(instance: Instance) -> Diagnostic:
    host = instance.host
    where = host.address or "an unknown address"
    notes = (Note(host.span, f"`{host.name}` is declared here"),) if host.span else ()
    return Diagnostic(
        codes.OTHER_MACHINE,
        instance.placed or instance.span,
        f"`{instance.name}` is on `{host.name}` ({where}), and nothing can be started there yet",
        label="rcdeploy starts components on this machine only",
        notes=notes,
        help="write `on localhost`, or run a deployment of its own on that machine",
    )


def _executable(instance: Instance, process: Process) -> Iterator[Diagnostic]:
    if not process.cwd.is_dir():
        yield _at(instance, codes.EXECUTABLE, f"there is no folder {process.cwd}")
        return
    program = process.argv[0]
    if not _found(program, process):
        yield _at(instance, codes.EXECUTABLE, f"there is no program `{program}` for it")
    script = process.argv[1]
    if not script.endswith(".py") or (process.cwd / script).is_file():
        return
    cdsl = short(instance.component.path)
    if script == "main.py":
        said = f"its code has not been generated, there is no {script} beside {cdsl}"
        yield _at(instance, codes.NOT_GENERATED, said, f"rcgen component {cdsl}")
    else:
        yield _at(instance, codes.EXECUTABLE, f"there is no {script} in {short(process.cwd)}")


def _found(program: str, process: Process) -> bool:
    path = dict(process.env).get("PATH", os.environ.get("PATH"))
    beside = process.cwd / program
    return bool(shutil.which(str(beside) if os.sep in program else program, path=path))


def configuration(instance: Instance, process: Process) -> list[Diagnostic]:
    """What is wrong with the values that an instance would get.

    The component would refuse it at its start; here it is told before anything starts.
    """
    own = instance.component.parameters
    known = schema(own.parameters) if own else ()
    beside = process.cwd / OWN_CONFIG
    try:
        found = process.config or _found_by(instance.name, process)
        config = found or (beside if beside.is_file() else None)
    except ConfigError as error:
        return [_in_configuration(instance, None, one) for one in error.findings]
    try:
        load_values(known, config, process.settings)
    except ConfigError as error:
        return [_in_configuration(instance, config, one) for one in error.findings]
    return []


def _found_by(name: str, process: Process) -> Path | None:
    """What the instance `name` would find; None: its own. Raises `ConfigError`."""
    if not (process.context or process.searched):
        return None
    names = tuple(dict.fromkeys((process.name, name, process.component)))
    asked = Asked(process.context, process.searched, names)
    around = surroundings(os.environ | dict(process.env), process.cwd)
    return choose(asked, around).path


def _in_configuration(instance: Instance, config: Path | None, finding: Finding) -> Diagnostic:
    place = finding.place
    span = instance.span
    message = f"{finding.message} (`{instance.name}`)"
    if config and place.text.name == str(config):
        span = _span(config, place.line, place.column, place.width)
    elif place.text.name == overrides.NAME:
        message = f"{finding.message} (`set {place.excerpt}` of `{instance.name}`)"
    return Diagnostic(codes.CONFIGURATION, span, message, label=finding.label, help=finding.help)


def _span(path: Path, line: int, column: int, width: int) -> Span:
    try:
        source = Source.read(path)
    except UnreadableSource:
        return Source(path, "").whole
    if line > len(source.line_starts):
        return source.span(len(source.text), len(source.text))
    start = source.line_starts[line - 1] + column - 1
    return source.span(start, min(start + width, len(source.text)))


def _ports(deployment: Deployment) -> Iterator[Diagnostic]:
    for instance in deployment.instances:
        if instance.port and instance.host.is_here and (reason := _taken(instance.port)):
            said = f"port {instance.port} cannot be used: {reason}"
            yield _at(instance, codes.PORT_TAKEN, said)


def _taken(port: int) -> str:
    """Why nobody can listen on `port` of the loopback address now, or an empty text."""
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as one:
        one.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            one.bind(("127.0.0.1", port))
        except (OSError, OverflowError) as error:
            return getattr(error, "strerror", None) or str(error)
    return ""


def _at(instance: Instance, code: Code, message: str, help: str = "") -> Diagnostic:
    return Diagnostic(code, instance.span, f"`{instance.name}`: {message}", help=help)


def short(path: Path) -> str:
    """`path` for people: without detours, and from here if it is below the working folder."""
    whole = path.resolve()
    here = Path.cwd()
    return str(whole.relative_to(here) if whole.is_relative_to(here) else whole)
