"""Checks that hosts have the CPU cores that components name. Pure.

In: a deployment with a host for each component, and the number of logical CPUs of the hosts. Out:
findings at the components.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from robocomp_dsl.deploy import codes
from robocomp_dsl.deploy.network.identities import host_name
from robocomp_dsl.diagnostics import Diagnostic
from robocomp_dsl.model.deployment import Deployment
from robocomp_dsl.model.limits_text import format_cores


def check_cores(deployment: Deployment, cpus: Mapping[str, int]) -> Iterator[Diagnostic]:
    """Components with `cores` that their host does not have; `cpus` are by name of host."""
    for instance in deployment.instances:
        name = host_name(instance.host)
        count = cpus.get(name, 0)
        missing = [core for core in instance.limits.cores if core >= count]
        if count and missing:
            yield Diagnostic(
                codes.SCHEDULING,
                instance.span,
                f"`{instance.name}`: the host `{name}` has no CPU core {format_cores(missing)}; it"
                f" has {format_cores(range(count))}",
                help="write `cores` that the host has",
            )
