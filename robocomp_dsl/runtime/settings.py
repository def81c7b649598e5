"""How one component is to be run: what the command line, or who embeds it, says.

In: words such as `laser=base1` and `laser=best_effort,depth=1`. Out: `RunSettings`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path

from robocomp_dsl.runtime.middleware.base import Qos

NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_.-]{0,99}")
PRIORITIES = ("background", "low", "normal", "high", "realtime")


class WrongSetting(ValueError):
    """A word that cannot be understood; the message says what it should look like."""


@dataclass(frozen=True, slots=True)
class RunSettings:
    """How to run. Empty: as the component itself says."""

    name: str = ""
    domain: str = "default"
    middleware: str = ""
    config: Path | None = None
    overrides: tuple[str, ...] = ()
    wires: dict[str, tuple[str, ...]] = field(default_factory=dict)
    qualities: dict[str, Qos] = field(default_factory=dict)
    listen_port: int = 0


def parse_name(text: str, what: str) -> str:
    """`text` as a name. Raises `WrongSetting`."""
    if not NAME.fullmatch(text):
        raise WrongSetting(
            f"`{text}` is no {what}: letters, digits, `_`, `-` and `.`, no digit in front"
        )
    return text


def parse_wires(texts: Iterable[str]) -> dict[str, tuple[str, ...]]:
    """`PORT=COMPONENT` or `PORT=COMPONENT.PORT`, several for a port. Raises `WrongSetting`."""
    made: dict[str, tuple[str, ...]] = {}
    for text in texts:
        port, sign, peer = text.partition("=")
        if not sign or not port:
            raise WrongSetting(f"`{text}` is no wire; write PORT=COMPONENT, as in Laser=base")
        made[port] = (*made.get(port, ()), parse_name(peer, "component"))
    return made


def parse_qualities(texts: Iterable[str]) -> dict[str, Qos]:
    """`PORT=best_effort,depth=1,priority=high,deadline=40` (ms). Raises `WrongSetting`."""
    made: dict[str, Qos] = {}
    for text in texts:
        port, sign, said = text.partition("=")
        if not sign or not port:
            raise WrongSetting(f"`{text}` is no quality of service; write PORT=reliable,depth=10")
        for word in filter(None, said.split(",")):
            made[port] = _with(made.get(port, Qos()), word)
    return made


def _with(qos: Qos, word: str) -> Qos:
    key, _, value = word.partition("=")
    if word in ("reliable", "best_effort"):
        return replace(qos, reliable=word == "reliable")
    if key == "priority" and value in PRIORITIES:
        return replace(qos, priority=value)
    try:
        if key == "depth" and int(value) > 0:
            return replace(qos, depth=int(value))
        if key == "deadline" and float(value) > 0:
            return replace(qos, deadline=float(value) / 1000)
    except ValueError:
        pass
    raise WrongSetting(
        f"`{word}` is no quality of service; there are reliable, best_effort, depth=N,"
        f" deadline=MS and priority= one of {', '.join(PRIORITIES)}"
    )
