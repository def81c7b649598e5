"""The target of a value: a field, item, parameter or message."""

from __future__ import annotations

from robocomp_dsl.check.bdsl.units import has_numbers
from robocomp_dsl.model.types import Field, Sequence, Type
from robocomp_dsl.record import ValueRecord


class ValueTarget(ValueRecord):
    """What a value is for; `name` is for messages, such as `` `header.stamp` ``."""

    name: str
    type: Type
    unit: str = ""

    def field(self, field: Field) -> ValueTarget:
        """A field of the target; without a unit of its own it has that of the struct."""
        inherited = self.unit if has_numbers(field.type) else ""
        return ValueTarget(f"`{field.name}`", field.type, field.unit or inherited)

    def item(self, sequence: Sequence) -> ValueTarget:
        """An item of the target, which is a `sequence`."""
        return ValueTarget(f"an item of {self.name}", sequence.element, self.unit)
