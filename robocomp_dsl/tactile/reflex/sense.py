"""What the reflex of one part feels: from frames as they come to what its fields answer.

In: the skin's geometry, receptive fields and a law, each of which may change while it runs; frames.
Out: responses, or `RejectedFrame`. It tells when the geometry that it knows is not the skin's.
"""

from __future__ import annotations

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.errors import InvalidField
from robocomp_dsl.tactile.reflex.frames import FrameGate
from robocomp_dsl.tactile.reflex.law import Field, Law, Response
from robocomp_dsl.tactile.reflex.receptors import Receptors
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from robocomp_dsl.tactile.skin.touches import REACH


class Sense:
    """The receptive fields of `part`. Without a geometry every frame is of another one."""

    def __init__(
        self, part: str, fields: tuple[Field, ...], law: Law, reach: float = REACH
    ) -> None:
        self.part, self.gate = part, FrameGate()
        self.geometry: SkinGeometry | None = None
        self.fields, self.law, self.reach = fields, law, reach
        self._receptors: Receptors | None = None

    def adopt(self, geometry: SkinGeometry) -> None:
        """Take frames of this geometry from now on. Raises `InvalidField`; then nothing changes."""
        self._receptors = self._made(geometry, self.fields)
        self.geometry = geometry
        self.gate.expect(geometry.version, geometry.size)

    def use_fields(self, fields: tuple[Field, ...]) -> None:
        """Other fields. Raises `InvalidField`; then the old ones stay."""
        if self.geometry is None:
            raise InvalidField("the skin has not told yet which limbs it has")
        self._receptors = self._made(self.geometry, fields)
        self.fields = fields

    def use_law(self, law: Law, reach: float) -> None:
        """Another law, and another largest distance [m] between neighbours of one touch."""
        self.law, self.reach = law, reach
        if self.geometry is not None:
            self._receptors = self._made(self.geometry, self.fields)

    def feel(self, sequence: int, time: float, version: int, values: Floats) -> list[Response]:
        """What the fields answer to a frame of `values` (n,) [N]. Raises `RejectedFrame`."""
        forces = self.gate.check(sequence, time, version, values)
        return self._receptors.answer(forces) if self._receptors else []

    def _made(self, geometry: SkinGeometry, fields: tuple[Field, ...]) -> Receptors:
        return Receptors(geometry, self.part, fields, self.law, self.reach)
