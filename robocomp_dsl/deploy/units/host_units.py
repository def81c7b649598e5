"""All units of a deployment on one host. Pure.

In: the hosted processes. Out: names and texts of their services; of the target, which starts them
when the host boots; and of the timer that bounds the log files.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable

from robocomp_dsl.deploy.units import names
from robocomp_dsl.deploy.units.hosted_process import HOST_PATHS, HostedProcess
from robocomp_dsl.deploy.units.quoting import command_line, path
from robocomp_dsl.deploy.units.service import service_unit

LOG_BYTES = 100_000_000
"""Limit of the log files of a deployment on a host together."""
TRIM_PERIOD_S = 60
WATCH_LIMITS = "robocomp_dsl.host_tools.watch_limits"
TRIM_LOGS = "robocomp_dsl.host_tools.trim_logs"


def host_units(
    processes: Iterable[HostedProcess],
    deployment: str,
    *,
    root: str,
    python: str,
    more: tuple[tuple[str, str], ...] = (),
    controllers: Collection[str] = ("cpu", "memory"),
) -> dict[str, str]:
    """The units of a host by name. Raises `UnitValueError`.

    `root` is the folder of the deployment, `python` runs helpers; both as in `HostedProcess`.
    `more` are further units that the target starts, such as that of the router. `controllers` are
    those of cgroups that the manager of the host may set; a helper watches the other limits.
    """
    hosted = list(processes)
    on_host = frozenset(each.process.name for each in hosted)
    units = dict(more)
    for each in hosted:
        name = names.service_name(deployment, each.process.name)
        units[name] = service_unit(each, deployment, on_host)
    if watched := _unenforced(hosted, deployment, controllers):
        text = _limits_service(deployment, root, python, watched)
        units[names.limits_name(deployment)] = text
    timer = names.log_trim_name(deployment, "timer")
    started = [*units, timer]
    units[timer] = _trim_timer(deployment)
    units[names.log_trim_name(deployment, "service")] = _trim_service(deployment, root, python)
    units[names.target_name(deployment)] = _target(deployment, started)
    return units


def _unenforced(
    hosted: Iterable[HostedProcess], deployment: str, controllers: Collection[str]
) -> list[str]:
    """The arguments of `watch_limits` for limits that the manager cannot enforce."""
    words: list[str] = []
    for each in hosted:
        limits = each.process.limits
        memory = 0 if "memory" in controllers else limits.memory_bytes
        cpu = 0.0 if "cpu" in controllers else limits.cpu
        if memory or cpu:
            unit = names.service_name(deployment, each.process.name)
            words += [unit, each.process.name, str(memory), f"{cpu:g}"]
    return words


def _limits_service(deployment: str, root: str, python: str, watched: list[str]) -> str:
    command = [python, "-m", WATCH_LIMITS, f"{root}/logs", *watched]
    return f"""\
[Unit]
Description={path(f"watches the limits of {deployment}")}
PartOf={names.target_name(deployment)}

[Service]
ExecStart={command_line(command, HOST_PATHS)}
Restart=always
RestartSec=1
"""


def _target(deployment: str, units: Iterable[str]) -> str:
    wants = "\n".join(f"Wants={unit}" for unit in units)
    return f"""\
[Unit]
Description={path(f"deployment {deployment}")}
{wants}

[Install]
WantedBy=default.target
"""


def _trim_timer(deployment: str) -> str:
    return f"""\
[Unit]
Description={path(f"bounds the logs of {deployment}")}
PartOf={names.target_name(deployment)}

[Timer]
OnActiveSec={TRIM_PERIOD_S}
OnUnitActiveSec={TRIM_PERIOD_S}
AccuracySec=10
"""


def _trim_service(deployment: str, root: str, python: str) -> str:
    command = [python, "-m", TRIM_LOGS, f"{root}/logs", str(LOG_BYTES)]
    return f"""\
[Unit]
Description={path(f"bounds the logs of {deployment}")}

[Service]
Type=oneshot
ExecStart={command_line(command, HOST_PATHS)}
"""
