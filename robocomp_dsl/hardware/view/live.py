"""A running simulation on a page: what it shows is where everything is, some 20 times a second.

In: proxies of `Simulation` and `InnerModelManager`, whoever serves them. Out: a page that follows;
its switches hold the time, its sliders move joints, its numbers place nodes. When the simulation
has other nodes, or is started again, the page is made anew.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable

from robocomp_dsl.hardware.simulation_interface import (
    InnerModelManagerProxy,
    SimulationProxy,
)
from robocomp_dsl.hardware.view.browser import PLAIN, Page
from robocomp_dsl.hardware.view.far import FarHand
from robocomp_dsl.hardware.view.picture import Look
from robocomp_dsl.hardware.view.running import View, look_at
from robocomp_dsl.runtime.errors import MiddlewareError

LOOKS = 20.0  # per second
PATIENCE_S = 2.0

log = logging.getLogger("robocomp.view")


class LivePage:
    """Open until `close`; without `nodes` no nodes can be placed.

    Raises as `look_at` does, and `OSError` when the port is taken.
    """

    def __init__(
        self,
        name: str,
        hand: SimulationProxy,
        look: Look = PLAIN,
        *,
        port: int = 0,
        nodes: InnerModelManagerProxy | None = None,
    ) -> None:
        for proxy in filter(None, (hand, nodes)):
            proxy.set_timeout(PATIENCE_S)
        self._name, self._hand, self._far = name, hand, FarHand(hand, nodes)
        self._view: View | None = look_at(hand)
        view = self._view
        self.page = Page(name, view.model, view.data(), look, port=port, far=self._far)
        self._show(view)

    def look(self) -> None:
        """Show how it is now. Raises `CannotFollow`."""
        try:
            view = self._looked()
        except MiddlewareError as error:
            if self._view is not None:
                log.warning("%s does not answer: %s", self._name, error)
            self._view = None  # another one may come, with other nodes
            with self.page.controls.lock:
                self.page.controls.say(f"**{self._name} does not answer**", running=False)
        else:
            self._show(view)

    def _looked(self) -> View:
        if self._view is not None:
            sight = self._hand.getSight()
            if sight.revision == self._view.revision:
                self._view.sight = sight
                return self._view
        self._view = look_at(self._hand)
        self.page.show(self._view.model, self._view.data())
        return self._view

    def _show(self, view: View) -> None:
        it = view.sight
        pace = "stands still" if it.paused else f"{it.realTimeFactor:.2f} times real time"
        lines = [f"simulated time {it.time:.2f} s, {pace}", self._far.said]
        with self.page.controls.lock:
            self.page.follow(view.seen())
            self.page.controls.say("  \n".join(filter(None, lines)), running=not it.paused)

    def run(self, going_on: Callable[[], bool] = lambda: True) -> None:
        """Follow until `going_on` says no. Raises `CannotFollow`."""
        while going_on():
            time.sleep(1 / LOOKS)
            self.look()

    def close(self) -> None:
        """The page is gone; the simulation goes on."""
        self.page.close()
