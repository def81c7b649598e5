"""Reports the state of a component to systemd, or to another supervisor that speaks sd_notify(3).

In: lifecycle states; the address in `NOTIFY_SOCKET`, and the interval in `WATCHDOG_USEC`. Out:
`READY=1` when `compute` is reached, `STATUS=…` at every state, `STOPPING=1`, and `WATCHDOG=1`.
Without the address nothing is sent. rcdeploy observes the lifecycle itself and needs no messages.
"""

from __future__ import annotations

import os
import socket
from collections.abc import Mapping
from contextlib import suppress

DEPLOYMENT_VARIABLE = "ROBOCOMP_DEPLOYMENT"
"""rcdeploy sets it for the components that it starts."""
_READY_STATES = ("compute", "emergency")
_MAX_STATUS_CHARS = 200


class SystemdNotifier:
    """Sends to the supervisor of this process; never blocks, and never fails because of it.

    `watchdog_s`: the supervisor expects a ping at least so often; 0.0: it expects none.
    """

    def __init__(self, environment: Mapping[str, str] | None = None) -> None:
        variables = os.environ if environment is None else environment
        address = variables.get("NOTIFY_SOCKET", "")
        if DEPLOYMENT_VARIABLE in variables or not address.startswith(("/", "@")):
            address = ""
        self._address = f"\0{address[1:]}" if address.startswith("@") else address
        self._is_ready = False
        self.watchdog_s = _watchdog_interval(variables) if address else 0.0

    def state_changed(self, state: str, reason: str = "") -> None:
        """Report a lifecycle state and its reason."""
        text = f"{state}: {reason}" if reason else state
        message = f"STATUS={' '.join(text.split())[:_MAX_STATUS_CHARS]}"
        if state in _READY_STATES and not self._is_ready:
            self._is_ready = True
            message += "\nREADY=1"
        if state == "finalize":
            message += "\nSTOPPING=1"
        self._send(message)

    def ping(self) -> None:
        """Report that the component does not hang."""
        self._send("WATCHDOG=1")

    def _send(self, message: str) -> None:
        if not self._address:
            return
        kind = socket.SOCK_DGRAM | socket.SOCK_CLOEXEC | socket.SOCK_NONBLOCK
        with suppress(OSError), socket.socket(socket.AF_UNIX, kind) as sender:
            sender.sendto(message.encode("utf-8", "replace"), self._address)


def _watchdog_interval(variables: Mapping[str, str]) -> float:
    """`WATCHDOG_USEC` in s, if it is meant for this process."""
    value, pid = variables.get("WATCHDOG_USEC", ""), variables.get("WATCHDOG_PID", "")
    if not (value.isascii() and value.isdecimal()) or pid not in ("", str(os.getpid())):
        return 0.0
    return int(value) / 1e6
