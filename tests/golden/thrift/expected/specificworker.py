"""eyes: what it does. Written once by rcgen; from now on this file is yours."""

from __future__ import annotations

from eyes_generated.genericworker import GenericWorker
from eyes_generated.interfaces import ListOfDouble, SetOfString, Status


class SpecificWorker(GenericWorker):
    """The component eyes."""

    def initialize(self) -> None:
        """Called once at the start; the parameters are in self.params."""

    def compute(self) -> None:
        """Called every 100 ms."""
        # For example (the types are in eyes_generated.interfaces; a call without
        # a reply raises NoServer or Timeout of robocomp_dsl.runtime.types):
        # result = self.motor_proxy.get_version()
        # self.eyes_proxy.look(gaze())

    # implements motor::Motor

    def Motor_get_version(self) -> str:
        """The version of the firmware."""
        # Put your code here. Until then callers receive an error.
        return super().Motor_get_version()

    def Motor_move_to(self, angle: float, speed: float) -> bool:
        """Moves the joint.
        - `angle`: the target [deg]
        Returns whether it is within the limits

        Units: angle in deg.
        May raise Blocked.
        """
        # Put your code here. Until then callers receive an error.
        return super().Motor_move_to(angle, speed)

    def Motor_follow(self, path: ListOfDouble, names: SetOfString) -> ListOfDouble:
        """motor::Motor: follow."""
        # Put your code here. Until then callers receive an error.
        return super().Motor_follow(path, names)

    def Motor_stop(self) -> None:
        """motor::Motor: stop."""

    def Motor_get_status(self) -> Status:
        """motor::Motor: get_status."""
        # Put your code here. Until then callers receive an error.
        return super().Motor_get_status()

    def Motor_reset(self) -> None:
        """motor::Motor: reset."""
        # Put your code here. Until then callers receive an error.
        super().Motor_reset()
