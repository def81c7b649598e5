"""Quality of service as options of zenoh."""

from __future__ import annotations

from typing import Any

import zenoh

from robocomp_dsl.runtime.connection.endpoint import Qos

PRIORITIES = {
    "realtime": zenoh.Priority.REAL_TIME,
    "high": zenoh.Priority.INTERACTIVE_HIGH,
    "normal": zenoh.Priority.DATA,
    "low": zenoh.Priority.DATA_LOW,
    "background": zenoh.Priority.BACKGROUND,
}


def publisher_options(qos: Qos) -> dict[str, Any]:
    """The options of a zenoh publisher for a quality of service; empty for the defaults."""
    options: dict[str, Any] = {}
    if qos.reliable is not None:
        control = zenoh.CongestionControl
        options["congestion_control"] = control.BLOCK if qos.reliable else control.DROP
    if qos.priority:
        options["priority"] = PRIORITIES[qos.priority]
    return options
