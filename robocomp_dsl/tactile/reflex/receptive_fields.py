"""Responses of receptive fields to the forces of one frame.

In: the geometry of the skin, the fields of one part and a law, once; forces (n,) for every frame.
Out: the responses of every field to every touch on its limb.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.errors import InvalidField
from robocomp_dsl.tactile.reflex.law import Field, Law, Response, respond
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from robocomp_dsl.tactile.skin.touches import REACH, TaxelGraph

Ignored = Callable[[str, Floats], bool]
"""Whether a touch of the limb of that name, centred at (3,) [m], is left out."""


class ReceptiveFields:
    """The fields of the part `part` on a skin; taxels of other parts are ignored.

    Raises `InvalidField` for a field on a limb that the skin does not have.
    """

    def __init__(
        self,
        geometry: SkinGeometry,
        part: str,
        fields: tuple[Field, ...],
        law: Law,
        reach: float = REACH,
    ) -> None:
        limbs = [i for i, name in enumerate(geometry.limbs) if name.startswith(f"{part}/")]
        mine = np.flatnonzero(np.isin(geometry.limb, limbs))
        self.law = law
        self._taxels, self._points, self._limb = mine, geometry.points[mine], geometry.limb[mine]
        self._normals = geometry.normals[mine]
        self._names = {i: geometry.limbs[i].partition("/")[2] for i in limbs}
        self._neighbours = TaxelGraph.of(self._points, self._limb, reach)
        self._fields: dict[int, list[Field]] = {i: [] for i in limbs}
        for field in fields:
            name = f"{part}/{field.limb}"
            if name not in geometry.limbs:
                known = ", ".join(geometry.limbs) or "no limbs"
                raise InvalidField(
                    f"the skin has no limb `{name}` for the field `{field.name}`; it has {known}"
                )
            self._fields[geometry.limbs.index(name)].append(field)

    def respond(self, forces: Floats, ignored: Ignored | None = None) -> list[Response]:
        """Responses to the touches among `forces` (n,) of a whole frame."""
        felt = forces[self._taxels]
        answers = []
        for touch in self._neighbours.touches(felt > 0.0):
            limb, points = int(self._limb[touch[0]]), self._points[touch]
            if ignored and ignored(self._names[limb], felt[touch] @ points / felt[touch].sum()):
                continue
            for field in self._fields[limb]:
                answer = respond(self.law, field, points, felt[touch], self._normals[touch])
                if answer is not None:
                    answers.append(answer)
        return answers
