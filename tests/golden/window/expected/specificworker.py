"""panel: what it does. Written once by rcgen; from now on this file is yours."""

from __future__ import annotations

from panel_generated.genericworker import GenericWorker


class SpecificWorker(GenericWorker):
    """Shows a laser."""

    def initialize(self) -> None:
        """Called once at the start; the parameters are in self.params."""
        # The widgets of mainUI.ui are in self.ui, for example:
        # self.ui.pushButton.clicked.connect(self.on_click)

    def compute(self) -> None:
        """Called every 50 ms."""
        # For example (the types are in panel_generated.interfaces; a call without
        # a reply raises NoServer or Timeout of robocomp_dsl.runtime.types):
        # result = self.laser_proxy.getLaserData()
