"""`python -m robocomp_dsl.runtime.router SETTINGS.json`: the router of one host.

In: the settings that `rcdeploy` writes. Out: a router until SIGTERM or SIGINT. SIGHUP reads the
settings and the certificates again; links break for a moment. Exit code 1 if the router cannot
start, with the reason on standard error.
"""

from __future__ import annotations

import argparse
import logging
import signal
import socket
import sys
from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.runtime.component import logs
from robocomp_dsl.runtime.component.sd_notify import SystemdNotifier
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.router.router_settings import NOT_RELOADED, read_router_settings

log = logging.getLogger("robocomp.router")
RETRY_S = 1.0
"""systemd starts a router again at once: one that cannot start exits not sooner than that."""
_SIGNALS = (signal.SIGTERM, signal.SIGINT, signal.SIGHUP)


def main(arguments: list[str] | None = None) -> int:
    """Run until a signal; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m robocomp_dsl.runtime.router")
    parser.add_argument("settings", type=Path, metavar="SETTINGS.json")
    parser.add_argument("--log-level", choices=logs.LEVELS, default="info", help="default: info")
    parser.add_argument("--log-format", choices=("text", "json"), default="text")
    options = parser.parse_args(arguments)
    logs.set_up("router", options.log_level, options.log_format)
    received = _receive_signals()
    try:
        settings = read_router_settings(options.settings)
        logs.set_up(settings.name, options.log_level, options.log_format)
        from robocomp_dsl.runtime.router.router import Router  # noqa: PLC0415 - errors come first

        router = Router(settings)
    except MiddlewareError as error:
        log.critical("%s", error)
        signal.sigtimedwait(_SIGNALS, RETRY_S)
        return 1
    notifier = SystemdNotifier()
    listens = f"listens at {', '.join(settings.listen)}"
    notifier.state_changed("compute", listens)
    log.info("%s", listens)
    for number in _wait_for_signals(received, notifier):
        if number != signal.SIGHUP:
            break
        try:
            router.reload(read_router_settings(options.settings))
        except MiddlewareError as error:
            log.warning("%s: %s", error, NOT_RELOADED)
    notifier.state_changed("finalize")
    router.close()
    log.info("stopped")
    return 0


def _receive_signals() -> socket.socket:
    """A socket from which the numbers of signals can be read, whichever thread they interrupt."""
    receiver, sender = socket.socketpair()
    sender.setblocking(False)
    for number in _SIGNALS:
        signal.signal(number, lambda _number, _frame: None)
    signal.set_wakeup_fd(sender.detach(), warn_on_full_buffer=False)
    return receiver


def _wait_for_signals(received: socket.socket, notifier: SystemdNotifier) -> Iterator[int]:
    """The signals that arrive; tells systemd meanwhile that the process does not hang."""
    received.settimeout(notifier.watchdog_s / 3 or None)
    while True:
        try:
            yield from received.recv(1)
        except TimeoutError:
            notifier.ping()


if __name__ == "__main__":
    sys.exit(main())
