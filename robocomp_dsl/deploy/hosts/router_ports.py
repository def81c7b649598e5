"""Checks on every host that its router can listen, before anything changes.

In: an open fleet, a deployment. Out: a finding for each host whose address or port is not free. A
router that runs keeps its port, so it is not checked.
"""

from __future__ import annotations

import errno
import json
from collections.abc import Mapping

from robocomp_dsl.deploy.hosts import codes_router
from robocomp_dsl.deploy.hosts.fleet import Fleet
from robocomp_dsl.deploy.hosts.host_agent import HostAgent
from robocomp_dsl.deploy.hosts.host_report import HostReport
from robocomp_dsl.deploy.network.identities import (
    LOOPBACK,
    host_name,
    needs_network,
    router_port,
    used_hosts,
)
from robocomp_dsl.deploy.units import names
from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.model.deployment import Deployment, Host
from robocomp_dsl.source import Span

_PROBE = """
import json, socket, sys
for host in sys.argv[2:]:
    try:
        found = socket.getaddrinfo(host, int(sys.argv[1]), type=socket.SOCK_STREAM)
        for family, kind, protocol, _, address in found:
            probe = socket.socket(family, kind, protocol)
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind(address)
            probe.listen(1)
            probe.close()
    except OSError as error:
        reason = error.strerror or str(error)
        print("robocomp-port " + json.dumps([host, error.errno or 0, reason]))
        break
"""
"""Runs on the host: prints the first address at which no program can listen, and why."""
_MARK = b"robocomp-port "
"""Starts the line of `_PROBE`: a login script may print others."""


async def check_router_ports(
    fleet: Fleet, deployment: Deployment, spans: Mapping[str, Span], report: Report
) -> None:
    """Report the hosts whose routers could not listen. A host that fails is in the fleet."""
    if not needs_network(deployment):
        return
    reports = await fleet.reports()
    hosts = {host_name(host): host for host in used_hosts(deployment)}

    async def check(agent: HostAgent) -> list[object]:
        name = agent.host.name
        host = hosts.get(name)
        if host is None or _runs_router(reports.get(name), deployment.name):
            return []
        addresses = [LOOPBACK] if host.is_local else [host.address, LOOPBACK]
        port = str(router_port(deployment.name, host))
        result = await agent.connection.run(["python3", "-c", _PROBE, port, *addresses])
        lines = [line for line in result.stdout.splitlines() if line.startswith(_MARK)]
        return list(json.loads(lines[0].removeprefix(_MARK))) if lines else []

    for name, found in (await fleet.each(check)).items():
        if found:
            address, number, text = found
            span = spans.get(name, deployment.span)
            port = router_port(deployment.name, hosts[name])
            report.extend([_finding(hosts[name], str(address), port, number, str(text), span)])


def _runs_router(report: HostReport | None, deployment: str) -> bool:
    state = report.states.get(names.router_name(deployment)) if report else None
    return bool(state and state.pid)


def _finding(
    host: Host, address: str, port: int, number: object, text: str, span: Span
) -> Diagnostic:
    place = f"`{host_name(host)}`: its router cannot listen at {address} port {port}"
    match number:
        case errno.EADDRINUSE:
            reason = "another program uses the port"
            remedy = "stop that program (`ss -ltnp` on the host shows it), or write another `port`"
        case errno.EADDRNOTAVAIL:
            reason = "the host does not have this address"
            remedy = "write an address that `ip addr` shows on the host"
        case _:
            reason = text
            remedy = "correct `address` or `port` of the host"
    return Diagnostic(codes_router.ADDRESS_IN_USE, span, f"{place}: {reason}", help=remedy)
