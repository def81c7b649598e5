"""The status of the components of a host, from what systemd and the components told. Pure."""

from __future__ import annotations

from robocomp_dsl.deploy.hosts.differences import stored_manifest
from robocomp_dsl.deploy.hosts.host_report import HostReport, UnitState
from robocomp_dsl.deploy.hosts.manifest import HostedComponent
from robocomp_dsl.deploy.status import ProcessStatus

LIFECYCLE_STATES = ("initialize", "compute", "emergency", "finalize")


def host_rows(report: HostReport) -> list[ProcessStatus]:
    """The status of the components that are deployed on a host."""
    manifest = stored_manifest(report)
    if manifest is None:
        return []
    missing = UnitState("not-found", "inactive", "dead")
    return [
        component_status(component, report.states.get(component.unit, missing))
        for component in manifest.components
    ]


def component_status(component: HostedComponent, state: UnitState) -> ProcessStatus:
    """The status of one component. Its lifecycle is what it told systemd."""
    life, _, reason = state.text.partition(": ")
    if life not in LIFECYCLE_STATES:
        life, reason = "", state.text
    note = state.note or (reason if state.pid else "")
    return ProcessStatus(
        component.name,
        state.state,
        pid=state.pid,
        up_s=state.up_s,
        restarts=state.restarts,
        cpu=state.cpu,
        memory=state.memory,
        note=note,
        life=life if state.pid and not component.is_program else "",
        members=tuple((name, life) for name in component.member_names) if state.pid else (),
        host=component.host,
    )
