"""The quality of service of ports as text for command lines. Pure.

In: the quality of service of connections. Out: that of a port, and `reliable,depth=1`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TypeVar

from robocomp_dsl.model.deployment import Qos

PRIORITIES = ("background", "low", "normal", "high", "realtime")
ValueT = TypeVar("ValueT")


def merge_qos(qualities: Iterable[Qos]) -> Qos:
    """The quality of service that satisfies all of `qualities`."""
    requested = list(qualities)
    keep_all = _strictest((q.keep_all for q in requested), any)
    depth = _strictest((q.depth for q in requested), max)
    return Qos(
        reliable=_strictest((q.reliable for q in requested), any),
        priority=_strictest((q.priority for q in requested), _highest),
        depth=None if keep_all else depth,
        deadline_ms=_strictest((q.deadline_ms for q in requested), min),
        keep_all=keep_all,
        latched=_strictest((q.latched for q in requested), any),
        liveliness_ms=_strictest((q.liveliness_ms for q in requested), min),
        thread_priority=_strictest((q.thread_priority for q in requested), max),
    )


def _strictest(
    values: Iterable[ValueT | None], select: Callable[[Iterable[ValueT]], ValueT]
) -> ValueT | None:
    """`select` of the values that are specified; None without any."""
    specified = [value for value in values if value is not None]
    return select(specified) if specified else None


def _highest(priorities: Iterable[str]) -> str:
    return max(priorities, key=_priority_rank)


def _priority_rank(priority: str) -> int:
    return PRIORITIES.index(priority) if priority in PRIORITIES else 0


def format_qos(qos: Qos) -> str:
    """The value of `--qos PORT=`: `best_effort,depth=1,deadline=40`; times in ms."""
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
