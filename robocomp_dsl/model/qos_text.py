"""The quality of service of connections as text. Pure."""

from __future__ import annotations

from robocomp_dsl.model.deployment import Qos
from robocomp_dsl.qos_items import qos_values


def format_qos(qos: Qos) -> str:
    """The value of `--qos PORT=` or `--qos PORT/PEER=`: `best_effort,depth=1`; times in ms."""
    return ",".join(value.as_option() for value in qos_values(qos))


def qos_statements(qos: Qos) -> list[str]:
    """As in DDSL: `best_effort`, `keep last 1`, `deadline 40 ms`; empty for the defaults."""
    return [value.as_statement() for value in qos_values(qos)]
