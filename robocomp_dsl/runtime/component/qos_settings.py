"""Quality of service as text, as in `reliable,depth=10,deadline=40`; times in ms.

In: options of a command line, or changes of a running connection. Out: `Qos`, or `InvalidSetting`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any

from robocomp_dsl.qos_items import QOS_ITEMS, qos_values
from robocomp_dsl.runtime.component.invalid_setting import InvalidSetting
from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.connection.qos_merge import PRIORITIES

MAX_THREAD_PRIORITY = 99
"""The highest priority of SCHED_FIFO, see sched(7)."""
OFF = "off"
ITEMS = (
    "reliable, best_effort, keep_all, latched, depth=N, deadline=MS, liveliness=MS,"
    f" thread_priority=1..{MAX_THREAD_PRIORITY}, and priority= with one of {', '.join(PRIORITIES)}"
)
FLAGS: dict[str, dict[str, Any]] = {
    item.option: {item.field: item.flag} for item in QOS_ITEMS if item.flag is not None
}


def _positive(text: str) -> int:
    number = int(text)
    if number < 1:
        raise ValueError(text)
    return number


def _seconds(text: str) -> float:
    milliseconds = float(text)
    if not 0 < milliseconds < 1e9:
        raise ValueError(text)
    return milliseconds / 1000


def _thread_priority(text: str) -> int:
    number = _positive(text)
    if number > MAX_THREAD_PRIORITY:
        raise ValueError(text)
    return number


def _priority(text: str) -> str:
    if text not in PRIORITIES:
        raise ValueError(text)
    return text


VALUES: dict[str, Callable[[str], Any]] = {
    "depth": _positive,
    "deadline": _seconds,
    "liveliness": _seconds,
    "thread_priority": _thread_priority,
    "priority": _priority,
}


def parse_qos(texts: Iterable[str]) -> tuple[dict[str, Qos], dict[str, dict[str, Qos]]]:
    """`PORT=ITEM,ITEM` or, for one connection, `PORT/PEER=ITEM,ITEM`. Raises `InvalidSetting`.

    Returns the quality of service by port, and by port and peer.
    """
    ports: dict[str, Qos] = {}
    peers: dict[str, dict[str, Qos]] = {}
    for text in texts:
        key, separator, items = text.partition("=")
        port, slash, peer = key.partition("/")
        if not (separator and port and (peer or not slash)):
            raise InvalidSetting(
                f"`{text:.80}` is not a quality of service; write PORT=reliable,depth=10, or"
                " PORT/COMPONENT=… for one connection"
            )
        if "@" in peer:  # a program at an address, as for `--connect`: its name
            peer = f"/{peer.partition('@')[0]}"
        target = peers.setdefault(port, {}) if peer else ports
        target[peer or port] = parse_items(items, target.get(peer or port, Qos()))
    return ports, peers


def parse_items(text: str, qos: Qos) -> Qos:
    """`qos` with the items in `text`. Raises `InvalidSetting`."""
    for word in filter(None, text.split(",")):
        qos = _with_item(qos, word)
    if qos.keep_all and qos.reliable is False:
        raise InvalidSetting("`keep_all` drops no message, `best_effort` may; remove one of them")
    return qos


def change_items(text: str, qos: Qos) -> Qos:
    """As `parse_items`; `ITEM=off` removes an item. Raises `InvalidSetting`."""
    for word in filter(None, text.split(",")):
        name, _, value = word.partition("=")
        if value == OFF and (name in VALUES or name in ("keep_all", "latched", "reliable")):
            qos = replace(qos, **{name: None})
        else:
            if word == "best_effort":
                qos = replace(qos, keep_all=None)
            elif word == "keep_all":
                qos = replace(qos, reliable=None)
            qos = parse_items(word, qos)
    return qos


def _with_item(qos: Qos, word: str) -> Qos:
    name, separator, value = word.partition("=")
    if word in FLAGS:
        return replace(qos, **FLAGS[word])
    if separator and name in VALUES:
        try:
            return replace(qos, **{name: VALUES[name](value)})
        except ValueError:
            pass
    raise InvalidSetting(f"`{word:.80}` is not a quality of service; valid items: {ITEMS}")


def format_qos(qos: Qos) -> str:
    """The inverse of `parse_items`; empty for the defaults."""
    return ",".join(value.as_option() for value in qos_values(qos))
