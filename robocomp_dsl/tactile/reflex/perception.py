"""Perception of the reflex of one part: from skin frames to the responses of receptive fields.

In: the geometry of the skin, receptive fields and a law, which may change at run time; frames.
Out: responses, or `RejectedFrame`. `validator.is_outdated` reports a geometry that has changed.
"""

from __future__ import annotations

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.errors import InvalidField
from robocomp_dsl.tactile.reflex.frames import FrameValidator
from robocomp_dsl.tactile.reflex.law import Field, Law, Response
from robocomp_dsl.tactile.reflex.receptive_fields import Ignored, ReceptiveFields
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from robocomp_dsl.tactile.skin.touches import REACH


class ReflexPerception:
    """The receptive fields of `part`. Every frame is rejected until `adopt` sets a geometry."""

    def __init__(
        self, part: str, fields: tuple[Field, ...], law: Law, reach: float = REACH
    ) -> None:
        self.part, self.validator = part, FrameValidator()
        self.geometry: SkinGeometry | None = None
        self.fields, self.law, self.reach = fields, law, reach
        self._receptors: ReceptiveFields | None = None

    def adopt(self, geometry: SkinGeometry) -> None:
        """Use this geometry from now on. Raises `InvalidField` and then changes nothing."""
        self._receptors = self._fields_on(geometry, self.fields)
        self.geometry = geometry
        self.validator.expect(geometry.version, geometry.size)

    def use_fields(self, fields: tuple[Field, ...]) -> None:
        """Replace the fields. Raises `InvalidField` and then keeps the old fields."""
        if self.geometry is None:
            raise InvalidField("the skin has not reported its limbs yet")
        self._receptors = self._fields_on(self.geometry, fields)
        self.fields = fields

    def use_law(self, law: Law, reach: float) -> None:
        """Replace the law, and the largest distance [m] between neighbouring taxels of a touch."""
        self.law, self.reach = law, reach
        if self.geometry is not None:
            self._receptors = self._fields_on(self.geometry, self.fields)

    def process_frame(
        self,
        sequence: int,
        time: float,
        version: int,
        values: Floats,
        ignored: Ignored | None = None,
    ) -> list[Response]:
        """The responses to a frame of `values` (n,) [N]. Raises `RejectedFrame`."""
        forces = self.validator.check(sequence, time, version, values)
        return self._receptors.respond(forces, ignored) if self._receptors else []

    def _fields_on(self, geometry: SkinGeometry, fields: tuple[Field, ...]) -> ReceptiveFields:
        return ReceptiveFields(geometry, self.part, fields, self.law, self.reach)
