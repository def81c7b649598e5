"""How a skin is set up, from the parameters of the component that simulates it.

In: the values of the group `skin`, in the units of people: mm, and ids of dead taxels in words, as
in `3, 10-20`. Out: `SkinSettings`.
"""

from __future__ import annotations

import re
from typing import Any

from robocomp_dsl.hardware.skin import SkinSettings
from robocomp_dsl.runtime.parameters import Refused
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from robocomp_dsl.tactile.skin.manager import Compensation
from robocomp_dsl.tactile.skin.sensor import Imperfections

_IDS = re.compile(r"\s*(\d{1,9})\s*(?:-\s*(\d{1,9})\s*)?")
_LONGEST = 100_000


def skin_settings(given: Any) -> SkinSettings:
    """The settings that parameters tell. Raises `Refused` for what is no list of ids."""
    return SkinSettings(
        rate=given.rate,
        sigma=given.sigma / 1000,
        shear=given.shear,
        raw=given.raw,
        imperfections=Imperfections(
            threshold=min(given.threshold, given.saturation * (1 - 1e-9)),
            saturation=given.saturation,
            noise=given.noise,
            drift=given.drift,
            broken=taxel_ids(given.dead),
        ),
        compensation=Compensation() if given.compensation else None,
    )


def taxel_ids(words: str) -> tuple[int, ...]:
    """The ids in a list with ranges, ascending, each once. Raises `Refused`."""
    found: set[int] = set()
    for word in words.split(",") if words.strip() else ():
        match = _IDS.fullmatch(word)
        if match is None:
            raise Refused(f"`{word.strip()}` is no taxel; write ids and ranges, as in `3, 10-20`")
        first, last = int(match[1]), int(match[2] or match[1])
        if not first <= last < first + _LONGEST:
            raise Refused(f"`{word.strip()}` is no range of taxels")
        found.update(range(first, last + 1))
    return tuple(sorted(found))


def known_taxels(words: str, geometry: SkinGeometry) -> None:
    """Pass when all taxels of a list are there. Raises `Refused` that names those that are not."""
    unknown = sorted(set(taxel_ids(words)) - set(geometry.ids.tolist()))
    if unknown:
        shown = ", ".join(map(str, unknown[:5])) + (", ..." if unknown[5:] else "")
        raise Refused(f"the skin has no taxel {shown}")
