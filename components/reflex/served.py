"""What the reflex does for others: it tells what it has seen, and takes fields, forces and wishes.

In: calls of Reflex.idsl, live parameters. Out: answers, and a `sense` that is as it was asked for.
"""

from __future__ import annotations

from generated.genericworker import GenericWorker
from generated.interfaces import Fields, ReflexState, RoboCompReflex_NotPossible, Statistics
from wire import receptive_fields, told_field

from robocomp_dsl.runtime.parameters import Refused
from robocomp_dsl.tactile.errors import FrameFault, InvalidField
from robocomp_dsl.tactile.reflex.law import Law
from robocomp_dsl.tactile.reflex.sense import Sense


class Served(GenericWorker):
    """`part` is the arm with `size` joints that `sense` feels for."""

    sense: Sense
    part: str
    size: int
    withdrawals = 0

    # implements RoboCompReflex::Reflex

    def Reflex_getStatistics(self) -> Statistics:
        """What it is doing, and what it has seen."""
        gate = self.sense.gate
        return Statistics(
            state=ReflexState[self.machine.states[0]],
            withdrawals=self.withdrawals,
            framesAccepted=gate.accepted,
            framesNotFinite=gate.rejected[FrameFault.NOT_FINITE],
            framesWrongLength=gate.rejected[FrameFault.WRONG_LENGTH],
            framesOutOfOrder=gate.rejected[FrameFault.OUT_OF_ORDER],
            framesOtherGeometry=gate.rejected[FrameFault.OTHER_GEOMETRY],
        )

    def Reflex_getFields(self) -> Fields:
        """Its receptive fields."""
        return [told_field(one, self.part) for one in self.sense.fields]

    def Reflex_setFields(self, fields: Fields) -> None:
        """Other receptive fields, on limbs that the skin has."""
        try:
            self.sense.use_fields(receptive_fields(fields, self.part, self.size))
        except InvalidField as error:
            raise RoboCompReflex_NotPossible(what=str(error)) from None

    def Reflex_setForces(self, threshold: float, full: float) -> None:
        """The parameters `threshold` and `full`."""
        try:
            self.params.set({"threshold": threshold, "full": full})
        except Refused as refused:
            raise RoboCompReflex_NotPossible(what=refused.reason) from None

    def Reflex_enable(self, on: bool) -> None:
        """The parameter `enabled`."""
        self.params.set({"enabled": on})

    # Parameters that change while it runs.

    def law(self, changes: dict[str, float | int | str | bool] | None = None) -> Law:
        """The law by the parameters, with `changes`. Raises `Refused`."""
        said = {"threshold": self.params.threshold, "full": self.params.full, **(changes or {})}
        threshold, full = float(said["threshold"]), float(said["full"])
        if threshold >= full:
            raise Refused(f"`threshold`, {threshold:g} N, must be less than `full`, {full:g} N")
        return Law(threshold, full)

    def will_set(self, changes: dict[str, float | int | str | bool]) -> None:
        """The two forces must fit each other."""
        self.law(changes)

    def did_set_threshold(self, _old: float) -> None:
        """Another law."""
        self.sense.use_law(self.law(), self.params.reach)

    def did_set_full(self, _old: float) -> None:
        """Another law."""
        self.sense.use_law(self.law(), self.params.reach)

    def did_set_reach(self, _old: float) -> None:
        """Other neighbours."""
        self.sense.use_law(self.law(), self.params.reach)

    def did_set_arm_timeout(self, _old: float) -> None:
        """How long the arm may take for an answer."""
        self.genericarm_proxy.set_timeout(self.params.arm_timeout)
