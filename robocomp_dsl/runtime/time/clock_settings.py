"""Clock settings of a component: the value of `--clock`.

In: `wall`, `sim,from=body`, `lockstep,from=body,with=base+wander,limit=10,lost=stop`. Out:
`ClockSettings`.
"""

from __future__ import annotations

from argparse import ArgumentTypeError
from dataclasses import dataclass, replace

from robocomp_dsl.runtime.component.naming import resolve_name

WALL, SIM, LOCKSTEP = KINDS = ("wall", "sim", "lockstep")
LOST = ("drop", "stop")


@dataclass(frozen=True, slots=True)
class ClockSettings:
    """Clock of a component. `source`: the clock source, empty for any.

    In lock-step `members` are the components that take part, without the source; `limit` is the
    time in s that one may need for a step; `stops_when_lost`: the source stops when a member times
    out or disconnects.
    """

    kind: str = WALL
    source: str = ""
    members: tuple[str, ...] = ()
    limit: float = 10.0
    stops_when_lost: bool = False

    def with_prefix(self, prefix: str) -> ClockSettings:
        """The same settings with full names."""
        source = resolve_name(prefix, self.source) if self.source else ""
        return replace(
            self, source=source, members=tuple(resolve_name(prefix, m) for m in self.members)
        )

    def as_text(self) -> str:
        """The inverse of `parse_clock`."""
        items = [self.kind]
        items += [f"from={self.source}"] if self.source else []
        items += [f"with={'+'.join(self.members)}"] if self.members else []
        if self.kind == LOCKSTEP:
            items += [f"limit={self.limit:g}"] + (["lost=stop"] if self.stops_when_lost else [])
        return ",".join(items)


def parse_clock(text: str) -> ClockSettings:
    """Parse the value of `--clock`. Raises `ArgumentTypeError`."""
    kind, *words = text.split(",")
    if kind not in KINDS:
        raise ArgumentTypeError(f"unknown clock `{kind}`; valid: {', '.join(KINDS)}")
    settings = ClockSettings(kind)
    for word in words:
        settings = _with_item(settings, word)
    return settings


def _with_item(settings: ClockSettings, word: str) -> ClockSettings:
    key, _, value = word.partition("=")
    if key == "from" and value:
        return replace(settings, source=value)
    if key == "with" and value:
        return replace(settings, members=tuple(sorted(set(value.split("+")))))
    if key == "lost" and value in LOST:
        return replace(settings, stops_when_lost=value == "stop")
    try:
        if key == "limit" and 0.001 <= float(value) <= 86400:
            return replace(settings, limit=float(value))
    except ValueError:
        pass
    raise ArgumentTypeError(
        f"`{word}` is not a clock setting; valid: from=COMPONENT, with=A+B,"
        " limit=SECONDS, lost=drop, lost=stop"
    )
