"""Names of running components: a prefix, `/`, a name, as in `left/arm`; prefixes nest.

In: names as they are written, prefixes. Out: names as others see them, and who is near to whom. Of
components in `left`, those in `left` are nearest, then those without a prefix; those in `right` are
on another branch and are found only by their whole name.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

ANY = "*"
"""In place of a component: any that is not on another branch."""
_FAR = 1000

_T = TypeVar("_T")


def within(prefix: str, name: str) -> str:
    """`name` under `prefix`. A name that begins with `/` is whole already; so is `*.port`."""
    if name.startswith("/"):
        return name[1:]
    return f"{prefix}/{name}" if prefix and not name.startswith(ANY) else name


def prefix_of(component: str) -> str:
    """`left` of `left/arm`."""
    return component.rpartition("/")[0]


def related(one: str, other: str) -> bool:
    """Whether two are on one branch: the prefix of one is that of the other, or around it."""
    if "/" not in one or "/" not in other:
        return True
    mine, theirs = f"{prefix_of(one)}/", f"{prefix_of(other)}/"
    return mine.startswith(theirs) or theirs.startswith(mine)


def distance(one: str, other: str) -> int:
    """How far one on the same branch is: 0 beside, then outwards, and all inner ones last."""
    mine, theirs = one.count("/"), other.count("/")
    return mine - theirs if theirs <= mine else _FAR


def nearest(component: str, found: Sequence[_T], name: Callable[[_T], str]) -> list[_T]:
    """Those of `found` that are nearest to `component`; `name` tells the component of each."""
    if len(found) < 2:
        return list(found)
    least = min(distance(component, name(one)) for one in found)
    return [one for one in found if distance(component, name(one)) == least]
