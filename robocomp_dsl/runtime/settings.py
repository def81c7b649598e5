"""How one component is to be run: what the command line, or who embeds it, says.

In: words such as `laser=base1` and `laser=best_effort,depth=1`. Out: `RunSettings`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path

from robocomp_dsl.runtime.clock_settings import ClockSettings
from robocomp_dsl.runtime.middleware.base import Qos
from robocomp_dsl.runtime.naming import ANY, within

NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_.-]{0,99}")
PORT = re.compile(r"[A-Za-z_][A-Za-z0-9_-]{0,99}")
DEEPEST = 8
"""So many prefixes may nest."""
PRIORITIES = ("background", "low", "normal", "high", "realtime")


class WrongSetting(ValueError):
    """A word that cannot be understood; the message says what it should look like."""


@dataclass(frozen=True, slots=True)
class RunSettings:
    """How to run. Empty: as the component itself says.

    `prefix` stands before the names of the component and of its peers (see `naming.within`);
    `remaps` gives ports other names: a served one is seen under it, any other looks for it.
    """

    name: str = ""
    prefix: str = ""
    domain: str = "default"
    middleware: str = ""
    config: Path | None = None
    overrides: tuple[str, ...] = ()
    wires: dict[str, tuple[str, ...]] = field(default_factory=dict)
    qualities: dict[str, Qos] = field(default_factory=dict)
    remaps: dict[str, str] = field(default_factory=dict)
    listen_port: int = 0
    clock: ClockSettings = field(default_factory=ClockSettings)

    def whole_name(self, component: str) -> str:
        """The name of the instance as others see it; `component` is that of its kind."""
        return within(self.prefix, self.name or component)

    def peers_of(self, port: str) -> tuple[str, ...]:
        """Who a port that looks for others is wired to, by whole names."""
        name = self.remaps.get(port)
        peers = self.wires.get(port, (f"{ANY}.{name}",) if name else ())
        made = (within(self.prefix, one) for one in peers)
        return tuple(
            one if not name or "." in one.rpartition("/")[2] else f"{one}.{name}" for one in made
        )


def parse_name(text: str, what: str) -> str:
    """`text` as a name. Raises `WrongSetting`."""
    if not NAME.fullmatch(text):
        raise WrongSetting(
            f"`{text}` is no {what}: letters, digits, `_`, `-` and `.`, no digit in front"
        )
    return text


def parse_prefix(text: str) -> str:
    """`left` or `/left/hand` as the prefix of names; `/` is none. Raises `WrongSetting`."""
    parts = text.strip("/").split("/") if text.strip("/") else []
    if len(parts) > DEEPEST:
        raise WrongSetting(f"`{text:.80}` has more than {DEEPEST} parts")
    return "/".join(parse_name(one, "prefix") for one in parts)


def parse_remaps(texts: Iterable[str]) -> dict[str, str]:
    """`PORT=NAME`: the names of ports for others. Raises `WrongSetting`."""
    made: dict[str, str] = {}
    for text in texts:
        port, _, name = text.partition("=")
        if not port or not PORT.fullmatch(name):
            raise WrongSetting(f"`{text:.80}` is no remap; write PORT=NAME, as in Laser=front")
        if made.setdefault(port, name) != name:
            raise WrongSetting(f"`{port}` is given two names, {made[port]} and {name}")
    return made


def parse_peer(text: str) -> str:
    """`base`, `base.Laser`, `hand/base` or, whatever the prefix, `/right/base`."""
    for one in text.removeprefix("/").split("/"):
        parse_name(one, "component")
    return text


def parse_wires(texts: Iterable[str]) -> dict[str, tuple[str, ...]]:
    """`PORT=COMPONENT` or `PORT=COMPONENT.PORT`, several for a port. Raises `WrongSetting`."""
    made: dict[str, tuple[str, ...]] = {}
    for text in texts:
        port, sign, peer = text.partition("=")
        if not sign or not port:
            raise WrongSetting(f"`{text}` is no wire; write PORT=COMPONENT, as in Laser=base")
        made[port] = (*made.get(port, ()), parse_peer(peer))
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
