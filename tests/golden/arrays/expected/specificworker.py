"""arrays: what it does. Written once by rcgen; from now on this file is yours."""

from __future__ import annotations

from arrays_generated.genericworker import GenericWorker
from arrays_generated.interfaces import ById, Estimate, Names, Points, Values


class SpecificWorker(GenericWorker):
    """The component arrays."""

    def initialize(self) -> None:
        """Called once at the start; the parameters are in self.params."""

    def compute(self) -> None:
        """Called every 100 ms."""
        # For example (the types are in arrays_generated.interfaces; a call without
        # a reply raises NoServer or Timeout of robocomp_dsl.runtime.types):
        # result, seen = self.arrays_proxy.estimate(Estimate(), 0)

    # implements RoboCompArrays::Arrays

    def Arrays_estimate(self, last: Estimate, when: int) -> tuple[int, Points]:
        """RoboCompArrays::Arrays: estimate.

        Units: when in ns.
        Returns the result, seen.
        May raise Lost.
        """
        # Put your code here. Until then callers receive an error.
        return super().Arrays_estimate(last, when)

    def Arrays_names(self, wanted: Names) -> ById:
        """RoboCompArrays::Arrays: names."""
        # Put your code here. Until then callers receive an error.
        return super().Arrays_names(wanted)

    def Arrays_reset(self, values: Values) -> None:
        """RoboCompArrays::Arrays: reset.

        Units: values in rad.
        """
