"""The quality of service of connections as text for command lines. Pure."""

from __future__ import annotations

from robocomp_dsl.model.deployment import Qos


def format_qos(qos: Qos) -> str:
    """The value of `--qos PORT=` or `--qos PORT/PEER=`: `best_effort,depth=1`; times in ms."""
    items = []
    if qos.reliable is not None:
        items.append("reliable" if qos.reliable else "best_effort")
    if qos.keep_all:
        items.append("keep_all")
    if qos.depth is not None:
        items.append(f"depth={qos.depth}")
    if qos.latched:
        items.append("latched")
    if qos.priority is not None:
        items.append(f"priority={qos.priority}")
    if qos.deadline_ms is not None:
        items.append(f"deadline={qos.deadline_ms:g}")
    if qos.liveliness_ms is not None:
        items.append(f"liveliness={qos.liveliness_ms:g}")
    if qos.thread_priority is not None:
        items.append(f"thread_priority={qos.thread_priority}")
    return ",".join(items)
