"""Checks all hosts of a deployment before anything is started on one.

In: a deployment. Out: open connections, facts by host, and findings located at the hosts in the
file. All hosts are asked at the same time; nothing is changed on them.
"""

from __future__ import annotations

import asyncio
import contextlib
import shlex
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from robocomp_dsl.deploy.hosts import codes
from robocomp_dsl.deploy.hosts.address import describe_host
from robocomp_dsl.deploy.hosts.connection import HostConnection, connect, load_ssh
from robocomp_dsl.deploy.hosts.errors import ANY_FILE, HostError
from robocomp_dsl.deploy.hosts.host_facts import MIN_PYTHON, HostFacts, fetch_facts
from robocomp_dsl.deploy.status import format_duration
from robocomp_dsl.diagnostics import Code, Diagnostic, Severity
from robocomp_dsl.model.deployment import UNPLACED, Deployment, Host
from robocomp_dsl.source import Span

CLOCK_LIMIT_S = 0.05
MIN_SYSTEMD = 240
"""The first version with `StandardOutput=append:`."""
MIN_FREE_BYTES = 200_000_000
"""Space for units, logs and small components; what is copied needs more."""


@dataclass(frozen=True, slots=True)
class HostLimits:
    """What is checked. `free_bytes`: space that is needed on hosts, by name."""

    clock_s: float = CLOCK_LIMIT_S
    free_bytes: Mapping[str, int] = field(default_factory=dict)


@dataclass(slots=True)
class CheckedHosts:
    """The hosts that answered, by name. The user of it closes the connections."""

    hosts: tuple[Host, ...]
    connections: dict[str, HostConnection] = field(default_factory=dict)
    facts: dict[str, HostFacts] = field(default_factory=dict)
    failures: dict[str, HostError] = field(default_factory=dict)
    problems: dict[str, list[Diagnostic]] = field(default_factory=dict)

    @property
    def findings(self) -> list[Diagnostic]:
        """The findings of all hosts."""
        return [finding for host in self.hosts for finding in self.findings_of(host)]

    @property
    def can_start(self) -> bool:
        """Whether no host has an error."""
        return not any(map(self.has_errors, self.hosts))

    def findings_of(self, host: Host) -> list[Diagnostic]:
        """The findings of one host."""
        return self.problems.get(host.name, [])

    def has_errors(self, host: Host) -> bool:
        """Whether a host cannot be used."""
        return any(finding.severity is Severity.ERROR for finding in self.findings_of(host))

    async def close(self) -> None:
        """Close all connections."""
        await asyncio.gather(*(connection.close() for connection in self.connections.values()))
        self.connections.clear()


def used_hosts(deployment: Deployment) -> tuple[Host, ...]:
    """The hosts on which components run, in the order of the components; those not placed: none."""
    hosts = [instance.host for instance in deployment.instances]
    return tuple({host.name: host for host in hosts if host is not UNPLACED}.values())


async def check_hosts(
    deployment: Deployment,
    name: str,
    hosts: Sequence[Host] | None = None,
    limits: HostLimits | None = None,
) -> CheckedHosts:
    """Connect to `hosts` (default: those that are used), and check them for the deployment `name`.

    No error raises: it is a finding, and the host then has no connection.
    """
    checked = CheckedHosts(used_hosts(deployment) if hosts is None else tuple(hosts))
    if not all(host.is_local for host in checked.hosts):
        load_ssh()
    try:
        async with asyncio.TaskGroup() as tasks:
            for host in checked.hosts:
                tasks.create_task(_ask(host, name, checked))
    except BaseException:
        await checked.close()
        raise
    checked.problems = host_problems(
        deployment, checked.hosts, checked.facts, checked.failures, limits
    )
    return checked


def host_problems(
    deployment: Deployment,
    hosts: Sequence[Host],
    facts: Mapping[str, HostFacts],
    failures: Mapping[str, HostError],
    limits: HostLimits | None = None,
) -> dict[str, list[Diagnostic]]:
    """The findings of each host by its name, from its facts or its failure. Pure."""
    spans = host_spans(deployment)
    problems: dict[str, list[Diagnostic]] = {}
    for host in hosts:
        span = spans.get(host.name, deployment.span)
        if error := failures.get(host.name):
            problems[host.name] = [describe_failure(error, span)]
        elif host.name in facts:
            found = check_facts(host, facts[host.name], span, limits or HostLimits())
            problems[host.name] = list(found)
    return problems


async def _ask(host: Host, name: str, checked: CheckedHosts) -> None:
    try:
        connection = await connect(host)
    except HostError as error:
        checked.failures[host.name] = error
        return
    checked.connections[host.name] = connection
    try:
        checked.facts[host.name] = await fetch_facts(connection, name)
    except HostError as error:
        checked.failures[host.name] = error
        del checked.connections[host.name]
        with contextlib.suppress(HostError):
            await connection.close()


def host_spans(deployment: Deployment) -> dict[str, Span]:
    """Where each host is declared, or first used if it is not declared."""
    spans = {}
    for instance in reversed(deployment.instances):
        spans[instance.host.name] = instance.host_span or instance.span
    return spans | {host.name: host.span for host in deployment.hosts if host.span}


def describe_failure(error: HostError, span: Span) -> Diagnostic:
    """A `HostError` as a finding at the host."""
    remedy = error.help.replace(ANY_FILE, shlex.quote(str(span.source.path)))
    return Diagnostic(error.code, span, error.message, help=remedy)


def check_facts(
    host: Host, facts: HostFacts, span: Span, limits: HostLimits
) -> Iterator[Diagnostic]:
    """What of a host does not suit a deployment."""
    name = describe_host(host)
    problems = (
        *_python_problems(facts),
        *_systemd_problems(facts),
        *_space_problems(facts, limits.free_bytes.get(host.name, MIN_FREE_BYTES)),
        *_lock_problems(facts),
        *_clock_problems(host, facts, limits.clock_s),
    )
    for code, message, remedy in problems:
        yield Diagnostic(code, span, f"{name}: {message}", help=remedy)


_Problems = Iterator[tuple[Code, str, str]]


def _python_problems(facts: HostFacts) -> _Problems:
    if facts.python is None:
        required = ".".join(map(str, MIN_PYTHON))
        found = ", ".join(map(str, facts.pythons)) or "none"
        message = f"no Python {required} or newer; found: {found}"
        yield codes.PYTHON, message, f"install Python {required} or newer on the host"


def _systemd_problems(facts: HostFacts) -> _Problems:
    linger = f"as root, on the host: `loginctl enable-linger {facts.user}`"
    if not facts.systemd:
        remedy = "`rcdeploy export` writes files for other engines"
        yield codes.SYSTEMD, "systemd is not installed", remedy
    elif facts.systemd < MIN_SYSTEMD:
        message = f"systemd {facts.systemd} is too old: {MIN_SYSTEMD} or newer is needed"
        yield codes.SYSTEMD, message, "update the operating system of the host"
    elif not facts.manager:
        reason = f" ({facts.manager_problem})" if facts.manager_problem else ""
        message = f"the systemd manager of user `{facts.user}` does not run{reason}"
        yield codes.SYSTEMD, message, linger
    elif not facts.linger:
        message = f"components of `{facts.user}` stop at logout, and do not start with the host"
        yield codes.LINGER, message, linger


def _space_problems(facts: HostFacts, needed: int) -> _Problems:
    if not facts.home_writable:
        message = f"`{facts.user}` may not write in {facts.home}"
        yield codes.DISK, message, "give the user a home folder of its own"
    elif facts.free_bytes < needed:
        message = (
            f"{format_bytes(facts.free_bytes)} of {facts.home} are free, "
            f"{format_bytes(needed)} are needed"
        )
        yield codes.DISK, message, "delete files on the host"


def _lock_problems(facts: HostFacts) -> _Problems:
    if facts.lock_holder:
        since = format_duration(facts.lock_age_s)
        message = (
            f"another rcdeploy changes the deployment there: {facts.lock_holder}, since {since}"
        )
        yield codes.BUSY, message, "wait until it ends"


def _clock_problems(host: Host, facts: HostFacts, limit_s: float) -> _Problems:
    if not host.is_local and facts.clock.exceeds(limit_s):
        message = f"its clock differs by {facts.clock.format()} (limit {limit_s * 1e3:g} ms)"
        yield codes.CLOCK, message, "synchronize both computers: `timedatectl set-ntp true`"


def format_bytes(count: float) -> str:
    """`3.2 GB`."""
    for unit in ("B", "kB", "MB"):
        if count < 1000:
            return f"{count:.0f} {unit}" if unit == "B" else f"{count:.1f} {unit}"
        count /= 1000
    return f"{count:.1f} GB"
