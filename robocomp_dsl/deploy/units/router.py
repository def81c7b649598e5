"""The unit of the router, through which the components of a host reach other hosts. Pure."""

from __future__ import annotations

from dataclasses import dataclass

from robocomp_dsl.deploy.units import names
from robocomp_dsl.deploy.units.hosted_process import HOST_PATHS
from robocomp_dsl.deploy.units.quoting import command_line, path
from robocomp_dsl.deploy.units.service import (
    END_TEXT,
    GRACE_S,
    RESTART_DELAY_S,
    join_sections,
    log_mark,
)

MODULE = "robocomp_dsl.runtime.router"
START_TIMEOUT_S = 30
WATCHDOG_S = 10


@dataclass(frozen=True, slots=True)
class HostedRouter:
    """The router of a host. `root`, `python` and `settings` are paths as in `HostedProcess`.

    `name` is that of its certificate; `revision` changes with its settings and keys, `environment`
    with the packages that it needs.
    """

    name: str
    root: str
    python: str
    settings: str
    revision: str = ""
    environment: str = ""


def router_unit(router: HostedRouter, deployment: str) -> str:
    """The text of the unit. systemd starts a router again, however often it ends."""
    log = path(f"{router.root}/{names.log_file(router.name)}", HOST_PATHS)
    command = [router.python, "-m", MODULE, router.settings, "--log-format", "json"]
    head = [
        "[Unit]",
        f"Description={path(f'{router.name} of {deployment}')}",
        f"PartOf={names.target_name(deployment)}",
        "StartLimitIntervalSec=0",
    ]
    service = [
        "[Service]",
        "Type=notify",
        "NotifyAccess=all",
        f"ExecStartPre={log_mark('starting')}",
        f"ExecStart={command_line(command, HOST_PATHS)}",
        f"TimeoutStartSec={START_TIMEOUT_S}",
        f"WatchdogSec={WATCHDOG_S}",
        "WatchdogSignal=SIGTERM",
        "Restart=always",
        f"RestartSec={RESTART_DELAY_S:g}",
        f"TimeoutStopSec={GRACE_S:g}",
        f"ExecStopPost={log_mark(END_TEXT)}",
        "Environment=PYTHONUNBUFFERED=1",
        f"StandardOutput=append:{log}",
        f"StandardError=append:{log}",
    ]
    identity = ["[X-RoboComp]", f"Component={path(router.name)}"]
    for key, value in (("Settings", router.revision), ("Environment", router.environment)):
        identity += [f"{key}={value}"] if value else []
    return join_sections(head, service, identity)
