"""What the routers of a deployment have refused lately. In: their logs. Out: a note per router."""

from __future__ import annotations

import time
from collections.abc import Mapping

from robocomp_dsl.deploy.hosts.differences import stored_manifest
from robocomp_dsl.deploy.hosts.fleet import Fleet
from robocomp_dsl.deploy.hosts.host_agent import HostAgent
from robocomp_dsl.deploy.hosts.host_report import HostReport
from robocomp_dsl.deploy.hosts.log_records import FileRecords
from robocomp_dsl.deploy.status import format_duration
from robocomp_dsl.deploy.units import names

RECENT_S = 3600.0
_PREFIXES = ("denied: ", "refused a connection: ")


async def latest_denials(fleet: Fleet, reports: Mapping[str, HostReport]) -> dict[str, str]:
    """The latest refusal of each router by its name; those of the last hour."""

    async def read(agent: HostAgent) -> tuple[str, str]:
        report = reports.get(agent.host.name)
        manifest = stored_manifest(report) if report else None
        if report is None or manifest is None:
            return "", ""
        unit = names.router_name(manifest.deployment)
        router = next((c.name for c in manifest.components if c.unit == unit), "")
        text = await agent.tail(router) if router else ""
        return router, latest_denial(router, text, report.time)

    found = await fleet.each(read)
    return dict(pair for pair in found.values() if all(pair))


def latest_denial(router: str, text: str, now: float) -> str:
    """The latest refusal in the log of a router, at `now` on its host; "" if there is none."""
    records = FileRecords(router, "").feed(text.encode(), time.time())
    for record in reversed(records):
        age = now - record.time
        if record.level == "WARNING" and record.text.startswith(_PREFIXES) and age < RECENT_S:
            return f"{format_duration(max(age, 0.0))} ago: {record.text}"
    return ""
