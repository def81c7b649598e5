"""Shows a running simulation on a browser page, refreshed 20 times a second.

In: proxies of `Simulation` and `InnerModelManager`, served by any component. Out: a page that
follows the simulation: switches pause time, sliders move joints, numbers place nodes. When the
nodes of the simulation change or it restarts, the page is rebuilt.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.simulation.simulation_interface import InnerModelManagerProxy, SimulationProxy
from robocomp_dsl.simulation.view.browser import DEFAULT_VIEWPOINT, BrowserPage
from robocomp_dsl.simulation.view.live_state import LiveState, fetch_live_state
from robocomp_dsl.simulation.view.picture import Viewpoint
from robocomp_dsl.simulation.view.remote_simulation import RemoteSimulation

REFRESH_HZ = 20.0  # per second
CALL_TIMEOUT_S = 2.0

log = logging.getLogger("robocomp.view")


class LivePage:
    """Open until `close`; without `nodes` nodes cannot be moved.

    Raises the errors of `fetch_live_state`, and `OSError` if the port is in use.
    """

    def __init__(
        self,
        name: str,
        simulation: SimulationProxy,
        look: Viewpoint = DEFAULT_VIEWPOINT,
        *,
        port: int = 0,
        nodes: InnerModelManagerProxy | None = None,
    ) -> None:
        for proxy in filter(None, (simulation, nodes)):
            proxy.set_timeout(CALL_TIMEOUT_S)
        self._name, self._simulation, self._remote = (
            name,
            simulation,
            RemoteSimulation(simulation, nodes),
        )
        self._view: LiveState | None = fetch_live_state(simulation)
        view = self._view
        self.page = BrowserPage(name, view.model, view.data(), look, port=port, remote=self._remote)
        self._show(view)

    def refresh(self) -> None:
        """Show the current state. Raises `UnsupportedSimulation`."""
        try:
            view = self._fetch()
        except MiddlewareError as error:
            if self._view is not None:
                log.warning("%s does not answer: %s", self._name, error)
            self._view = None  # another simulation may start, with other nodes
            with self.page.controls.lock:
                self.page.controls.show_status(f"**{self._name} does not answer**", running=False)
        else:
            self._show(view)

    def _fetch(self) -> LiveState:
        if self._view is not None:
            sight = self._simulation.getSight()
            if sight.revision == self._view.revision:
                self._view.sight = sight
                return self._view
        self._view = fetch_live_state(self._simulation)
        self.page.show(self._view.model, self._view.data())
        return self._view

    def _show(self, view: LiveState) -> None:
        it = view.sight
        pace = "paused" if it.paused else f"{it.realTimeFactor:.2f} times real time"
        lines = [f"simulated time {it.time:.2f} s, {pace}", self._remote.error]
        with self.page.controls.lock:
            self.page.update(view.visual_state())
            self.page.controls.show_status("  \n".join(filter(None, lines)), running=not it.paused)

    def run(self, keep_running: Callable[[], bool] = lambda: True) -> None:
        """Follow until `keep_running` returns False. Raises `UnsupportedSimulation`."""
        while keep_running():
            time.sleep(1 / REFRESH_HZ)
            self.refresh()

    def close(self) -> None:
        """Close the page; the simulation continues."""
        self.page.close()
