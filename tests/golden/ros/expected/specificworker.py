"""demo: what it does. Written once by rcgen; from now on this file is yours."""

from __future__ import annotations

from demo_generated.genericworker import GenericWorker
from demo_generated.interfaces import (
    Move_Goal,
    Move_Result,
    Points,
    SetBool_Request,
    SetBool_Response,
)


class SpecificWorker(GenericWorker):
    """The component demo."""

    def initialize(self) -> None:
        """Called once at the start; the parameters are in self.params."""

    def compute(self) -> None:
        """Called every 100 ms."""
        # For example (the types are in demo_generated.interfaces; a call without
        # a reply raises NoServer or Timeout of robocomp_dsl.runtime.types):
        # self.clouds_proxy.cloud(Cloud())

    # implements Demo::Lamp

    def Lamp_set(self, request: SetBool_Request) -> SetBool_Response:
        """Demo::Lamp: set."""
        # Put your code here. Until then callers receive an error.
        return super().Lamp_set(request)

    # implements Demo::Mover

    def Mover_move(self, goal: Move_Goal, path: Points) -> Move_Result:
        """Demo::Mover: move."""
        # Put your code here. Until then callers receive an error.
        return super().Mover_move(goal, path)
