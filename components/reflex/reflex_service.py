"""Serves the interface `Reflex` and applies live parameters.

In: calls of Reflex.idsl, live parameters. Out: replies, and a reconfigured `sense`.
"""

from __future__ import annotations

from body import RobotBody
from messages import field_to_message, receptive_fields
from reflex_generated.genericworker import GenericWorker
from reflex_generated.interfaces import Fields, ReflexState, RoboCompReflex_NotPossible, Statistics

from robocomp_dsl.runtime.parameters import ParameterRejected
from robocomp_dsl.tactile.errors import FrameFault, InvalidField
from robocomp_dsl.tactile.reflex.law import Law
from robocomp_dsl.tactile.reflex.perception import ReflexPerception


class ReflexService(GenericWorker):
    """`part` is the arm, with `size` joints, whose touches `sense` detects."""

    sense: ReflexPerception
    part: str
    size: int
    body: RobotBody
    withdrawals = 0

    # implements RoboCompReflex::Reflex

    def Reflex_getStatistics(self) -> Statistics:
        """The state, and counters of withdrawals and frames."""
        gate = self.sense.validator
        return Statistics(
            state=ReflexState[self.machine.states[0]],
            withdrawals=self.withdrawals,
            framesAccepted=gate.accepted,
            framesNotFinite=gate.rejected[FrameFault.NOT_FINITE],
            framesWrongLength=gate.rejected[FrameFault.WRONG_LENGTH],
            framesOutOfOrder=gate.rejected[FrameFault.OUT_OF_ORDER],
            framesOtherGeometry=gate.rejected[FrameFault.OTHER_GEOMETRY],
            selfContacts=self.body.self_contacts.count if self.body.self_contacts else 0,
        )

    def Reflex_getFields(self) -> Fields:
        """The receptive fields."""
        return [field_to_message(field, self.part) for field in self.sense.fields]

    def Reflex_setFields(self, fields: Fields) -> None:
        """Replace the receptive fields; each must be on a limb of the skin."""
        try:
            self.sense.use_fields(receptive_fields(fields, self.part, self.size))
        except InvalidField as error:
            raise RoboCompReflex_NotPossible(what=str(error)) from None

    def Reflex_setForces(self, threshold: float, full: float) -> None:
        """Set the parameters `threshold` and `full`."""
        try:
            self.params.set({"threshold": threshold, "full": full})
        except ParameterRejected as refused:
            raise RoboCompReflex_NotPossible(what=refused.reason) from None

    def Reflex_enable(self, on: bool) -> None:
        """Set the parameter `enabled`."""
        self.params.set({"enabled": on})

    # Live parameters.

    def force_law(self, changes: dict[str, float | int | str | bool] | None = None) -> Law:
        """The law of the parameters, with `changes`. Raises `ParameterRejected`."""
        forces = {"threshold": self.params.threshold, "full": self.params.full, **(changes or {})}
        threshold, full = float(forces["threshold"]), float(forces["full"])
        if threshold >= full:
            raise ParameterRejected(
                f"`threshold`, {threshold:g} N, must be less than `full`, {full:g} N"
            )
        return Law(threshold, full)

    def will_set(self, changes: dict[str, float | int | str | bool]) -> None:
        """Reject a `threshold` that is not less than `full`."""
        self.force_law(changes)

    def did_set_threshold(self, _old: float) -> None:
        """Use the new law."""
        self.sense.use_law(self.force_law(), self.params.reach)

    def did_set_full(self, _old: float) -> None:
        """Use the new law."""
        self.sense.use_law(self.force_law(), self.params.reach)

    def did_set_reach(self, _old: float) -> None:
        """Use the new distance of neighbours."""
        self.sense.use_law(self.force_law(), self.params.reach)

    def did_set_law(self, _old: str) -> None:
        """Use the new law of withdrawal."""
        self.body.use_law(self.params.law, self.params.clearance)

    def did_set_clearance(self, _old: float) -> None:
        """Keep the new distance."""
        self.body.use_law(self.params.law, self.params.clearance)

    def did_set_arm_timeout(self, _old: float) -> None:
        """Set the time-out of calls to the arm."""
        self.genericarm_proxy.set_timeout(self.params.arm_timeout)
