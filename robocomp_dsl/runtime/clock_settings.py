"""By which clock a component lives: the words of `--clock`.

In: `wall`, `sim,from=body`, `lockstep,from=body,with=base+wander,limit=10,lost=stop`. Out:
`ClockSettings`.
"""

from __future__ import annotations

from argparse import ArgumentTypeError
from dataclasses import dataclass, replace

from robocomp_dsl.runtime.naming import within

WALL, SIM, LOCKSTEP = KINDS = ("wall", "sim", "lockstep")
LOST = ("drop", "stop")


@dataclass(frozen=True, slots=True)
class ClockSettings:
    """`source`: the component that tells the time, empty for whoever does.

    In lock-step `members` are the components that take part, the source left out; `limit` in s is
    what one may need for a step, and `stops` whether the source ends when it loses one.
    """

    kind: str = WALL
    source: str = ""
    members: tuple[str, ...] = ()
    limit: float = 10.0
    stops: bool = False

    def under(self, prefix: str) -> ClockSettings:
        """The same with whole names."""
        source = within(prefix, self.source) if self.source else ""
        return replace(self, source=source, members=tuple(within(prefix, m) for m in self.members))

    def as_text(self) -> str:
        """The inverse of `parse_clock`."""
        said = [self.kind]
        said += [f"from={self.source}"] if self.source else []
        said += [f"with={'+'.join(self.members)}"] if self.members else []
        if self.kind == LOCKSTEP:
            said += [f"limit={self.limit:g}"] + (["lost=stop"] if self.stops else [])
        return ",".join(said)


def parse_clock(text: str) -> ClockSettings:
    """See the module. Raises `ArgumentTypeError`."""
    kind, *words = text.split(",")
    if kind not in KINDS:
        raise ArgumentTypeError(f"`{kind}` is no clock; there are {', '.join(KINDS)}")
    made = ClockSettings(kind)
    for word in words:
        made = _with(made, word)
    return made


def _with(made: ClockSettings, word: str) -> ClockSettings:
    key, _, value = word.partition("=")
    if key == "from" and value:
        return replace(made, source=value)
    if key == "with" and value:
        return replace(made, members=tuple(sorted(set(value.split("+")))))
    if key == "lost" and value in LOST:
        return replace(made, stops=value == "stop")
    try:
        if key == "limit" and 0.001 <= float(value) <= 86400:
            return replace(made, limit=float(value))
    except ValueError:
        pass
    raise ArgumentTypeError(
        f"`{word}` says nothing about a clock; there are from=COMPONENT, with=A+B,"
        " limit=SECONDS and lost=drop or lost=stop"
    )
