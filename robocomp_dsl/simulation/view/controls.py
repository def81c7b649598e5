"""The control panel of the browser view: display options, joint sliders, node poses.

In: a viser server, a stage and the state behind it. Out: changes of the state, under a lock. For a
remote world (`SimulationControl`) they are commands, and the page shows the results.
"""

from __future__ import annotations

import html
import math
import threading
import time
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.simulation.view.nodes import kind_of, moves, quaternion, roll_pitch_yaw, tree
from robocomp_dsl.simulation.view.picture import Viewpoint
from robocomp_dsl.simulation.view.remote_simulation import SimulationControl
from robocomp_dsl.simulation.view.stage import Floats, Stage
from robocomp_dsl.simulation.world.visual_state import capture

_MOST_SLIDERS = 80
_HELD_S = 1.0
"""Time after a slider was moved until it shows the joint's position again."""


class Controls:
    """`lock` guards `data`; `running`: whether time advances."""

    def __init__(
        self,
        server: Any,
        stage: Stage,
        data: Any,
        look: Viewpoint,
        remote: SimulationControl | None = None,
    ) -> None:
        self._remote = remote
        self.gui, self.stage, self.data = server.gui, stage, data
        self.model = stage.model
        self.lock = threading.RLock()
        self.running = False
        self._start = data.qpos.copy()
        self._quiet = False
        self._sliders: list[tuple[Any, int]] = []
        self._touched: dict[int, float] = {}
        tabs = self.gui.add_tab_group()
        with tabs.add_tab("View"):
            self._view(look)
        with tabs.add_tab("Joints"):
            self._joints()
        with tabs.add_tab("Nodes"):
            self._nodes()

    # -- display ------------------------------------------------------------------------------

    def _view(self, look: Viewpoint) -> None:
        stage = self.stage
        self._status = self.gui.add_markdown("", visible=self._remote is not None)
        remote = self._remote
        self._switch("Frames", look.frames, stage.show_frames)
        self._switch("Names", look.names, stage.show_names)
        self._switch("Contacts", look.contacts, stage.show_contacts)
        self._time = self._switch("Let time run", False, self._run)
        if remote:
            self.gui.add_button("Step of 10 ms").on_click(lambda _: remote.step(0.01))
            speed = self.gui.add_number("Speed (0: full)", remote.speed(), min=0.0, step=0.1)
            speed.on_update(lambda _: remote.set_speed(speed.value))
        self.gui.add_button("Back to the start").on_click(lambda _: self.reset())

    def _switch(self, label: str, on: bool, act: Any) -> Any:
        box = self.gui.add_checkbox(label, on)

        def switched(_: Any) -> None:
            with self.lock:
                if not self._quiet:
                    act(box.value)

        box.on_update(switched)
        if on:
            act(True)
        return box

    def _run(self, on: bool) -> None:
        self.running = on
        if self._remote:
            self._remote.run(on)

    def show_status(self, text: str, running: bool) -> None:
        """Show the status of a remote world; call it while holding the lock."""
        self.running = running
        if self._status.content != text:
            self._status.content = text
        if self._time.value != running:
            self._quiet = True
            self._time.value = running
            self._quiet = False

    def reset(self) -> None:
        """Reset the joints to the start, at rest."""
        if self._remote:
            self._remote.reset()
            return
        with self.lock:
            mujoco.mj_resetData(self.model, self.data)
            self.data.qpos[:] = self._start
            self._changed()

    def _changed(self) -> None:
        mujoco.mj_forward(self.model, self.data)
        self.stage.update(capture(self.model, self.data))
        self.tell()

    def tell(self) -> None:
        """Show the joints' positions on the sliders."""
        self._quiet = True
        now = time.monotonic()
        for slider, address in self._sliders:
            if now < self._touched.get(address, 0.0):
                continue
            value = float(np.clip(self.data.qpos[address], slider.min, slider.max))
            if abs(slider.value - value) > 1e-4:
                slider.value = value
        self._quiet = False

    # -- joints -------------------------------------------------------------------------------

    def _joints(self) -> None:
        simple = [j for j in range(self.model.njnt) if kind_of(self.model, j) in {"hinge", "slide"}]
        if not simple:
            self.gui.add_markdown("Nothing here turns or slides.")
        for j in simple[:_MOST_SLIDERS]:
            self._slider(j)
        if len(simple) > _MOST_SLIDERS:
            self.gui.add_markdown(f"… and {len(simple) - _MOST_SLIDERS} more joints.")

    def _slider(self, j: int) -> None:
        model = self.model
        hinge = kind_of(model, j) == "hinge"
        address = int(model.jnt_qposadr[j])
        widest = math.pi if hinge else self.stage.extent
        low, high = model.jnt_range[j].tolist() if model.jnt_limited[j] else (-widest, widest)
        now = float(self.data.qpos[address])
        low, high = min(low, now), max(high, now, low + 1e-6)
        label = f"{model.joint(j).name or f'joint{j}'} [{'rad' if hinge else 'm'}]"
        slider = self.gui.add_slider(label, low, high, (high - low) / 1000, now)
        self._sliders.append((slider, address))

        def moved(_: Any) -> None:
            if self._quiet:
                return
            if self._remote:
                self._touched[address] = time.monotonic() + _HELD_S
                self._remote.move(model.joint(j).name, slider.value, hinge)
            else:
                with self.lock:
                    self.data.qpos[address] = slider.value
                    self.data.qvel[model.jnt_dofadr[j]] = 0.0
                    self._changed()

        slider.on_update(moved)

    # -- nodes --------------------------------------------------------------------------------

    def _nodes(self) -> None:
        names = self.stage.names
        if len(names) < 2:
            self.gui.add_markdown("There are no nodes.")
            return
        choice = self.gui.add_dropdown("Node", tuple(f"{i}: {n}" for i, n in enumerate(names) if i))
        about = self.gui.add_markdown("")
        zero = (0.0, 0.0, 0.0)
        place = self.gui.add_vector3("place [m]", zero, step=0.001)
        turn = self.gui.add_vector3("roll pitch yaw [rad]", zero, step=0.001)

        def chosen() -> int:
            return int(choice.value.partition(":")[0])

        def show(_: Any) -> None:
            body = chosen()
            self._quiet = True
            position, quat = self._stands(body)
            place.value = tuple(position.tolist())
            turn.value = roll_pitch_yaw(quat)
            about.content = html.escape(self._about(body))
            self._quiet = False

        def put(_: Any) -> None:
            if not self._quiet:
                with self.lock:
                    self.place(chosen(), np.array(place.value), quaternion(turn.value))

        choice.on_update(show)
        place.on_update(put)
        turn.on_update(put)
        show(None)
        with self.gui.add_folder("Tree", expand_by_default=True):
            self.gui.add_markdown(tree(self.model, names))

    def place(self, body: int, position: Any, quat: Any) -> None:
        """Set the pose of a body in its parent; a free body is moved by its joint."""
        if self._remote:
            above = int(self.model.body_parentid[body])
            names = self.stage.names
            self._remote.place(
                names[body],
                names[above] if above else "",
                np.asarray(position),
                np.asarray(quat),
            )
            return
        self.model.body_pos[body], self.model.body_quat[body] = position, quat
        first = int(self.model.body_jntadr[body])
        if first >= 0 and kind_of(self.model, first) == "free":
            at = int(self.model.jnt_qposadr[first])
            self.data.qpos[at : at + 7] = (*position, *quat)
        self._changed()

    def _stands(self, body: int) -> tuple[Floats, Floats]:
        """Position and quaternion in the parent: of the model, or received if it is remote."""
        if self._remote:
            return self.stage.relative[body, :3], self.stage.relative[body, 3:]
        return self.model.body_pos[body], self.model.body_quat[body]

    def _about(self, body: int) -> str:
        above = self.stage.names[self.model.body_parentid[body]]
        return f"in {above}; {float(self.model.body_mass[body]):.3g} kg; {moves(self.model, body)}"
