"""Quality of service as statements of DDSL. Pure.

In: `Qos`, and items of `rcdeploy qos` such as `depth=2` or `priority=off`. Out: the changed `Qos`,
and the statements that specify it.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from robocomp_dsl.model.deployment import Qos
from robocomp_dsl.model.qos_text import qos_statements
from robocomp_dsl.qos_items import QOS_ITEMS

_ITEMS = {item.option: item for item in QOS_ITEMS}
_INTEGERS = ("depth", "thread_priority")


def changed_qos(qos: Qos, items: Iterable[str]) -> Qos:
    """`qos` with valid items of `rcdeploy qos`; times are in ms."""
    changes: dict[str, Any] = {}
    for text in items:
        name, _, value = text.partition("=")
        item = _ITEMS[name]
        field = f"{item.field}_ms" if item.is_time else item.field
        if value == "off":
            changes[field] = None
        elif item.flag is not None:
            changes[field] = item.flag
        elif item.is_time:
            changes[field] = float(value)
        else:
            changes[field] = int(value) if name in _INTEGERS else value
    return qos.replace(**changes)


def format_statements(qos: Qos) -> str:
    """`best_effort; keep last 1; deadline 40 ms;`; empty for the defaults."""
    return " ".join(f"{statement};" for statement in qos_statements(qos))
