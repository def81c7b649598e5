"""`python -m robocomp_dsl.runtime.router SETTINGS.json`: the router of one host.

In: the settings that `rcdeploy` writes. Out: a router until SIGTERM or SIGINT; exit code 1 if it
cannot start, with the reason on standard error.
"""

from __future__ import annotations

import argparse
import logging
import signal
import sys
import threading
from pathlib import Path

from robocomp_dsl.runtime.component import logs
from robocomp_dsl.runtime.component.sd_notify import SystemdNotifier
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.router.router_settings import read_router_settings

log = logging.getLogger("robocomp.router")


def main(arguments: list[str] | None = None) -> int:
    """Run until a signal; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m robocomp_dsl.runtime.router")
    parser.add_argument("settings", type=Path, metavar="SETTINGS.json")
    parser.add_argument("--log-level", choices=logs.LEVELS, default="info", help="default: info")
    parser.add_argument("--log-format", choices=("text", "json"), default="text")
    options = parser.parse_args(arguments)
    logs.set_up("router", options.log_level, options.log_format)
    stop = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda _number, _frame: stop.set())
    try:
        settings = read_router_settings(options.settings)
        logs.set_up(settings.name, options.log_level, options.log_format)
        from robocomp_dsl.runtime.router.router import Router  # noqa: PLC0415 - errors come first

        router = Router(settings)
    except MiddlewareError as error:
        log.critical("%s", error)
        return 1
    notifier = SystemdNotifier()
    notifier.state_changed("compute", f"listens at {', '.join(settings.listen)}")
    log.info("listens at %s", ", ".join(settings.listen))
    _wait(stop, notifier)
    notifier.state_changed("finalize")
    router.close()
    log.info("stopped")
    return 0


def _wait(stop: threading.Event, notifier: SystemdNotifier) -> None:
    """Wait for a signal; tell systemd meanwhile that the process does not hang."""
    interval = notifier.watchdog_s / 3 or None
    while not stop.wait(interval):
        notifier.ping()


if __name__ == "__main__":
    sys.exit(main())
