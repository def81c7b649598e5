"""A running simulation on a page: what it shows is where everything is, some 20 times a second.

In: a proxy of `Simulation`, whoever serves it. Out: a page that follows; its switches hold the time
of the simulation. When the simulation has other nodes, or is started again, so does the page.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from typing import Any

from robocomp_dsl.hardware.simulation_interface import Refused, SimulationProxy
from robocomp_dsl.hardware.view.browser import PLAIN, Page
from robocomp_dsl.hardware.view.picture import Look
from robocomp_dsl.hardware.view.running import View, look_at
from robocomp_dsl.runtime.errors import MiddlewareError

LOOKS = 20.0  # per second
PATIENCE_S = 2.0

log = logging.getLogger("robocomp.view")


class FarHand:
    """Holds the time of the simulation. `said` is what did not work out."""

    def __init__(self, hand: SimulationProxy) -> None:
        self._hand = hand
        self.said = ""

    def run(self, on: bool) -> None:
        """See `controls.Far`."""
        self._try(self._hand.resume if on else self._hand.pause)

    def reset(self) -> None:
        """See `controls.Far`."""
        self._try(self._hand.reset)

    def _try(self, ask: Callable[[], Any]) -> None:
        try:
            ask()
        except (MiddlewareError, Refused) as error:
            self.said = f"it refuses: {error}"
        else:
            self.said = ""


class LivePage:
    """Open until `close`. Raises as `look_at` does, and `OSError` when the port is taken."""

    def __init__(
        self, name: str, hand: SimulationProxy, look: Look = PLAIN, *, port: int = 0
    ) -> None:
        hand.set_timeout(PATIENCE_S)
        self._name, self._hand, self._far = name, hand, FarHand(hand)
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
