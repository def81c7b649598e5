"""types: what it does. Written once by rcgen; from now on this file is yours."""

from __future__ import annotations

from types_generated.genericworker import GenericWorker
from types_generated.interfaces import (
    ByGear,
    ByName,
    ByPoint,
    Empty,
    Everything,
    EverythingSeq,
    Gear,
    Ints,
    Nested,
    NestedSeq,
    Numbers,
    NumbersSeq,
    Texts,
)


class SpecificWorker(GenericWorker):
    """The component types."""

    def initialize(self) -> None:
        """Called once at the start; the parameters are in self.params."""

    def compute(self) -> None:
        """Called every 100 ms."""
        # For example (the types are in types_generated.interfaces; a call without
        # a reply raises NoServer or Timeout of robocomp_dsl.runtime.types):
        # self.types_proxy.nothing()

    # implements RoboCompTypes::Types

    def Types_nothing(self) -> None:
        """RoboCompTypes::Types: nothing."""
        # Put your code here. Until then callers receive an error.
        super().Types_nothing()

    def Types_one(self, a: int) -> int:
        """RoboCompTypes::Types: one."""
        # Put your code here. Until then callers receive an error.
        return super().Types_one(a)

    def Types_twoOut(self) -> tuple[int, Texts]:
        """RoboCompTypes::Types: twoOut.

        Returns a, b.
        """
        # Put your code here. Until then callers receive an error.
        return super().Types_twoOut()

    def Types_all(
        self, e: Everything, i: Ints, n: NumbersSeq, d: ByName
    ) -> tuple[Gear, Everything, EverythingSeq]:
        """RoboCompTypes::Types: all.

        Returns the result, result, more.
        May raise Broken, Late.
        """
        # Put your code here. Until then callers receive an error.
        return super().Types_all(e, i, n, d)

    def Types_go(self, e: Everything) -> None:
        """RoboCompTypes::Types: go."""

    def Types_swap(self, a: Numbers, b: Nested) -> None:
        """RoboCompTypes::Types: swap."""
        # Put your code here. Until then callers receive an error.
        super().Types_swap(a, b)

    def Types_emptiness(self, e: Empty) -> Empty:
        """RoboCompTypes::Types: emptiness."""
        # Put your code here. Until then callers receive an error.
        return super().Types_emptiness(e)

    def Types_aVeryLongNameOfAnOperationThatDoesNotEnd(
        self, aVeryLongNameOfAParameter: EverythingSeq, another: ByPoint
    ) -> tuple[ByGear, NestedSeq]:
        """RoboCompTypes::Types: aVeryLongNameOfAnOperationThatDoesNotEnd.

        Returns aVeryLongNameOfAnOutput, second.
        """
        # Put your code here. Until then callers receive an error.
        return super().Types_aVeryLongNameOfAnOperationThatDoesNotEnd(
            aVeryLongNameOfAParameter, another
        )

    # implements RoboCompTypes::Nothing
