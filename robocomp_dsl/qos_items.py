"""The items of a quality of service: their names in options, in statements, and in data.

Model, command lines, generated documentation and running components share this table.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple


class QosItem(NamedTuple):
    """One item. `option` as in `--qos`, `statement` as in DDSL, `field` of both classes `Qos`.

    `flag` is the value of the field that the item stands for; None: the item has a value of its
    own. `is_time`: options and statements have ms, the field of the model ends with `_ms`.
    """

    option: str
    statement: str
    field: str
    flag: bool | None = None
    is_time: bool = False


QOS_ITEMS = (
    QosItem("reliable", "reliable", "reliable", flag=True),
    QosItem("best_effort", "best_effort", "reliable", flag=False),
    QosItem("keep_all", "keep all", "keep_all", flag=True),
    QosItem("depth", "keep last", "depth"),
    QosItem("latched", "latched", "latched", flag=True),
    QosItem("priority", "priority", "priority"),
    QosItem("deadline", "deadline", "deadline", is_time=True),
    QosItem("liveliness", "liveliness", "liveliness", is_time=True),
    QosItem("thread_priority", "thread priority", "thread_priority"),
)


class QosValue(NamedTuple):
    """An item that is specified. `value` is None for a flag; times are in ms."""

    item: QosItem
    value: str | float | None = None

    def as_option(self) -> str:
        """`best_effort`, `depth=1`, `deadline=40`."""
        return self.item.option if self.value is None else f"{self.item.option}={self._text()}"

    def as_statement(self) -> str:
        """`best_effort`, `keep last 1`, `deadline 40 ms`."""
        if self.value is None:
            return self.item.statement
        return f"{self.item.statement} {self._text()}{' ms' if self.item.is_time else ''}"

    def _text(self) -> str:
        return f"{self.value:g}" if self.item.is_time else str(self.value)


def qos_values(qos: object) -> Iterator[QosValue]:
    """The items that a `Qos` of the model or of the runtime specifies.

    Times of the model are in ms (`deadline_ms`), those of the runtime in s (`deadline`).
    """
    for item in QOS_ITEMS:
        if item.flag is not None:
            if getattr(qos, item.field) is item.flag:
                yield QosValue(item)
            continue
        milliseconds = getattr(qos, f"{item.field}_ms", None) if item.is_time else None
        value = getattr(qos, item.field, None) if milliseconds is None else milliseconds
        if value is not None:
            in_seconds = item.is_time and milliseconds is None
            yield QosValue(item, value * 1000 if in_seconds else value)
