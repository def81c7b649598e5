"""Checks the clock of a deployment on several hosts.

In: the clock, the instances and the hosts. Out: diagnostics. Simulated time and lock-step travel
over zenoh, so they work between hosts. A cut link makes a follower time out: then lock-step is
reproducible only if the deployment stops.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from robocomp_dsl.check.codes import placement as codes
from robocomp_dsl.check.ddsl.host_connections import possible_machines
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model.deployment import Clock, Host, Instance
from robocomp_dsl.syntax.ast import ddsl as ast


def check_clock_hosts(
    tree: ast.Clock | None,
    clock: Clock,
    instances: Sequence[Instance],
    hosts: Mapping[str, Host],
    report: Report,
) -> None:
    """Report lock-step over several hosts that goes on without a lost component."""
    if tree is None or tree.lockstep is None or clock.source is None or clock.stop_on_timeout:
        return
    shared = possible_machines(clock.source, hosts)
    for instance in instances:
        if instance.is_program:
            continue
        shared = shared & possible_machines(instance, hosts)
        if not shared:
            place = instance.host_span or instance.span
            report.add(
                codes.LOCKSTEP_OVER_HOSTS,
                tree.lockstep.span,
                "lock-step over several hosts goes on without a component whose link is cut",
                notes=[Note(place, f"`{instance.name}` runs on another host than others")],
                help="write `lost stop`, so that each complete run is reproducible, or place all "
                "components on one host",
            )
            return
