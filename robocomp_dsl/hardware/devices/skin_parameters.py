"""Settings of a skin from the parameters of the component that simulates it.

In: the values of the group `skin`, lengths in mm, and ids of dead taxels as text,
in `3, 10-20`. Out: `SkinSettings`.
"""

from __future__ import annotations

import re
from typing import Any

from robocomp_dsl.hardware.devices.skin import SkinSettings
from robocomp_dsl.runtime.parameters import ParameterRejected
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from robocomp_dsl.tactile.skin.manager import Compensation
from robocomp_dsl.tactile.skin.sensor import Imperfections

_IDS = re.compile(r"\s*(\d{1,9})\s*(?:-\s*(\d{1,9})\s*)?")
_LONGEST = 100_000


def skin_settings(parameters: Any) -> SkinSettings:
    """The settings of the parameters. Raises `ParameterRejected` for an invalid list of ids."""
    return SkinSettings(
        rate=parameters.rate,
        sigma=parameters.sigma / 1000,
        shear=parameters.shear,
        raw=parameters.raw,
        imperfections=Imperfections(
            threshold=min(parameters.threshold, parameters.saturation * (1 - 1e-9)),
            saturation=parameters.saturation,
            noise=parameters.noise,
            drift=parameters.drift,
            broken=taxel_ids(parameters.dead),
        ),
        compensation=Compensation() if parameters.compensation else None,
    )


def taxel_ids(words: str) -> tuple[int, ...]:
    """The ids in a list with ranges, ascending, without duplicates. Raises `ParameterRejected`."""
    found: set[int] = set()
    for word in words.split(",") if words.strip() else ():
        match = _IDS.fullmatch(word)
        if match is None:
            raise ParameterRejected(
                f"`{word.strip()}` is no taxel; write ids and ranges, as in `3, 10-20`"
            )
        first, last = int(match[1]), int(match[2] or match[1])
        if not first <= last < first + _LONGEST:
            raise ParameterRejected(f"`{word.strip()}` is no range of taxels")
        found.update(range(first, last + 1))
    return tuple(sorted(found))


def require_known_taxels(words: str, geometry: SkinGeometry) -> None:
    """Raise `ParameterRejected`, naming the missing taxels, unless all exist."""
    unknown = sorted(set(taxel_ids(words)) - set(geometry.ids.tolist()))
    if unknown:
        shown = ", ".join(map(str, unknown[:5])) + (", ..." if unknown[5:] else "")
        raise ParameterRejected(f"the skin has no taxel {shown}")
