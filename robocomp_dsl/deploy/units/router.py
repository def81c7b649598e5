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

SETTINGS_FILE = "private/router.json"
"""The settings in force, below the folder of the deployment."""
MODULE = "robocomp_dsl.runtime.router"
START_TIMEOUT_S = 30
WATCHDOG_S = 10

_COPY = 'cmp -s "$0" "$1" || cp -f "$0" "$1"'
"""Copies a file that differs: a router starts again on a full disk."""


@dataclass(frozen=True, slots=True)
class HostedRouter:
    """The router of a host. `root`, `python` and `settings` are paths as in `HostedProcess`.

    `name` is that of its certificate. `settings` is the file of this version, which replaces
    `router.json` when the router starts or reloads. `revision` changes with the settings and keys,
    `environment` with the packages that it needs.
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
    settings = f"{router.root}/{SETTINGS_FILE}"
    command = [router.python, "-m", MODULE, settings, "--log-format", "json"]
    copy = command_line(["/usr/bin/env", "sh", "-c", _COPY, router.settings, settings], HOST_PATHS)
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
        f"ExecStartPre=-{log_mark('starting')}",
        f"ExecStartPre={copy}",
        f"ExecStart={command_line(command, HOST_PATHS)}",
        f"ExecReload={copy}",
        "ExecReload=/bin/kill -HUP $MAINPID",
        f"TimeoutStartSec={START_TIMEOUT_S}",
        f"WatchdogSec={WATCHDOG_S}",
        "WatchdogSignal=SIGTERM",
        "Restart=always",
        f"RestartSec={RESTART_DELAY_S:g}",
        f"TimeoutStopSec={GRACE_S:g}",
        f"ExecStopPost=-{log_mark(END_TEXT)}",
        "Environment=PYTHONUNBUFFERED=1",
        f"StandardOutput=append:{log}",
        f"StandardError=append:{log}",
    ]
    identity = ["[X-RoboComp]", f"Component={path(router.name)}"]
    identity += [f"Environment={router.environment}"] if router.environment else []
    # A router reloads new settings; it need not start again.
    return f"{join_sections(head, service, identity)}Settings={router.revision}\n"
