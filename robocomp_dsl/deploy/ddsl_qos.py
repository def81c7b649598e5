"""Quality of service as statements of DDSL. Pure.

In: `Qos`, and items of `rcdeploy qos` such as `depth=2` or `priority=off`. Out: the changed `Qos`,
and the statements that specify it.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from robocomp_dsl.model.deployment import Qos

_FLAGS: dict[str, tuple[str, Any]] = {
    "reliable": ("reliable", True),
    "best_effort": ("reliable", False),
    "keep_all": ("keep_all", True),
    "latched": ("latched", True),
}
_VALUES: dict[str, tuple[str, Any]] = {
    "depth": ("depth", int),
    "priority": ("priority", str),
    "deadline": ("deadline_ms", float),
    "liveliness": ("liveliness_ms", float),
    "thread_priority": ("thread_priority", int),
}


def changed_qos(qos: Qos, items: Iterable[str]) -> Qos:
    """`qos` with valid items of `rcdeploy qos`; times are in ms."""
    changes: dict[str, Any] = {}
    for item in items:
        name, _, value = item.partition("=")
        field, kind = _FLAGS.get(name) or _VALUES[name]
        if value == "off":
            changes[field] = None
        else:
            changes[field] = kind if name in _FLAGS else kind(value)
    return qos.replace(**changes)


def format_statements(qos: Qos) -> str:
    """`best_effort; keep last 1; deadline 40 ms;`; empty for the defaults."""
    statements = []
    if qos.reliable is not None:
        statements.append("reliable" if qos.reliable else "best_effort")
    if qos.keep_all:
        statements.append("keep all")
    if qos.depth is not None:
        statements.append(f"keep last {qos.depth}")
    if qos.latched:
        statements.append("latched")
    if qos.priority is not None:
        statements.append(f"priority {qos.priority}")
    if qos.deadline_ms is not None:
        statements.append(f"deadline {qos.deadline_ms:g} ms")
    if qos.liveliness_ms is not None:
        statements.append(f"liveliness {qos.liveliness_ms:g} ms")
    if qos.thread_priority is not None:
        statements.append(f"thread priority {qos.thread_priority}")
    return " ".join(f"{statement};" for statement in statements)
