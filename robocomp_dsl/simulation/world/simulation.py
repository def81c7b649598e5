"""A running simulation of a scene, in real time or on the clock of its deployment.

In: a scene and options. Out: `devices` to serve, guarded by `lock`: hold it to access the world
while it runs. A world that has diverged is reset or stopped, depending on the options.
"""

from __future__ import annotations

import json
import logging
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

from robocomp_dsl.finding import Finding
from robocomp_dsl.hardware.description.scene import Scene
from robocomp_dsl.hardware.devices.errors import (
    CommandRefused,
    Diverged,
    SceneError,
    require_finite,
)
from robocomp_dsl.hardware.devices.skin import SkinSettings
from robocomp_dsl.hardware.servants.fair_lock import FairLock
from robocomp_dsl.hardware.servants.registry import SERVANTS
from robocomp_dsl.hardware.servants.serving import DevicePort, serve
from robocomp_dsl.runtime import ServedPort
from robocomp_dsl.runtime.clock import Clock
from robocomp_dsl.simulation.devices.skin_stream import SkinStream
from robocomp_dsl.simulation.scene import scene_devices
from robocomp_dsl.simulation.scene.found_files import with_found_files
from robocomp_dsl.simulation.scene.scene_joints import JointBoard
from robocomp_dsl.simulation.scene.scene_skins import build_skins
from robocomp_dsl.simulation.scene.scene_spec import build_spec
from robocomp_dsl.simulation.servants.registry import WORLD_SERVANTS
from robocomp_dsl.simulation.stepping.real_time import RealTimeDriver
from robocomp_dsl.simulation.stepping.select_driver import StepDriver, select_driver
from robocomp_dsl.simulation.world.limits import clamp_scene, require_limits
from robocomp_dsl.simulation.world.noise import NoiseLevel
from robocomp_dsl.simulation.world.overlaps import current_overlaps
from robocomp_dsl.simulation.world.state import SimulationState
from robocomp_dsl.simulation.world.world import World

_EARLY_S = 0.1
"""Simulated seconds after a reset; a world that diverges earlier counts as failed."""

_MAX_EARLY_FAILURES = 3
"""Consecutive early failures before the simulation stops."""

WORLD = ""
"""Id of the world itself among the devices."""

log = logging.getLogger("robocomp.simulation")


@dataclass(frozen=True, slots=True)
class SimulationOptions:
    """How a world runs.

    `step`: physics time step in s; `speed`: simulated seconds per second, 0: as fast as possible;
    `noise`: factor on the declared noise of devices; `skin`: settings of all skin;
    `reference_timeout`: time-out of streamed joint references [s], 0: none.
    """

    seed: int = 1
    step: float = 0.002
    speed: float = 1.0
    noise: float = 1.0
    diverged: Literal["reset", "stop"] = "reset"
    skin: SkinSettings = field(default_factory=SkinSettings)
    reference_timeout: float = 0.0


class Simulation:
    """Stopped until `start`; the content of `devices` changes with the scene."""

    def __init__(self, scene: Scene, options: SimulationOptions = SimulationOptions()) -> None:
        self._scene = scene
        self.options = options
        self.lock = FairLock()
        self.noise = NoiseLevel(options.noise)
        self.skin = SkinStream()
        self._skin_settings = options.skin
        self._reference_timeout = options.reference_timeout
        self._skins: set[str] = set()
        self.seed = options.seed
        self.failure = ""
        self._failed = 0
        self.revision = 0
        self.physics = True
        self.devices: dict[str, Any] = {}
        self.step_driver: StepDriver = select_driver(self, None, 1.0)
        self.set_speed(options.speed)
        self.reset()

    @classmethod
    def read(cls, path: Path, options: SimulationOptions = SimulationOptions()) -> Simulation:
        """The scene in a JSON file written by `rcgen simulator`. Raises `SceneError`.

        Meshes and pictures that are not where they were are searched in ROBOCOMP_FILES.
        """
        scene = Scene.of_data(read_data(path)["scene"], path.parent)
        return cls(with_found_files(scene, path.parent, log), options)

    # -- while the caller holds the lock ------------------------------------------------------

    def reset(self) -> None:
        """Reset the state and the time to the start. Raises `SceneError`."""
        self.reset_state()
        self.step_driver.on_reset(0.0)

    def reset_state(self) -> None:
        """Reset the state to the start; keep the clock. Raises `SceneError`."""
        self.switch_to(self._build(self._scene))

    def restore(self, branch: SimulationState) -> None:
        """Continue from `state`, at its time."""
        self.revision += 1
        self.switch_to(branch)
        self.step_driver.on_reset(self.world.advanced_to)

    @property
    def world(self) -> World:
        """The current physics."""
        return self.state.world

    @property
    def time(self) -> float:
        """Simulated time in s."""
        return self.world.time

    @property
    def dt(self) -> float:
        """Physics time step in s."""
        return self.world.step

    @property
    def time_to_next_step(self) -> float:
        """Simulated seconds until the next step."""
        return self.world.step - (self.world.advanced_to - self.world.time)

    def switch_to(self, branch: SimulationState) -> None:
        """Continue from `state`; its devices replace the current ones."""
        self._close_devices(besides=branch.devices)
        self.state = branch
        self._scene = branch.scene
        branch.set_physics(self.physics)
        self.devices.clear()
        self.devices.update(branch.devices)
        self.devices[WORLD] = self
        self._follow_skin(branch)
        for device in branch.devices.values():
            if hasattr(device, "lock"):  # its thread reads the world
                device.lock = self.lock
        self.set_reference_timeout(self._reference_timeout)
        self.failure = ""

    def _close_devices(self, besides: Mapping[str, Any]) -> None:
        """Free the resources of all devices except those in `besides`."""
        used = {id(device) for device in besides.values()}
        for device in self.devices.values():
            if hasattr(device, "close") and id(device) not in used:
                device.close()

    def _follow_skin(self, branch: SimulationState) -> None:
        """Connect the skin of the new state to the subscribers."""
        ids = [skin.id for skin in branch.scene.skins]
        self.skin.follow(branch.devices[ids[0]] if ids else None)
        self.skin.configure(self._skin_settings)
        self._skins.update(ids)
        self.devices.update(dict.fromkeys(self._skins, self.skin))

    def set_reference_timeout(self, seconds: float) -> None:
        """Set the time-out of streamed torques and currents [s]; 0: none."""
        self._reference_timeout = seconds
        for device in dict.fromkeys(self.state.devices.values()):
            if isinstance(device, JointBoard):
                device.settings.set_reference_timeout(seconds)

    def set_skin(self, settings: SkinSettings) -> None:
        """Set the parameters of all skin."""
        self._skin_settings = settings
        self.skin.configure(settings)

    def rebuild(self, scene: Scene, forget: Collection[str] = ()) -> None:
        """Switch to another scene; parts in both keep their state. Raises `SceneError`."""
        require_limits(scene)
        existing = scene_devices.unmoved(self.state.scene, scene, self.state.devices)
        state = self._build(scene, existing, self.world, forget)
        self.revision += 1
        failure = self.failure
        self.switch_to(state)
        self.failure = failure

    def _build(
        self,
        scene: Scene,
        existing: Mapping[str, Any] = MappingProxyType({}),
        before: World | None = None,
        forget: Collection[str] = (),
    ) -> SimulationState:
        try:
            scene, clamped = clamp_scene(scene)
            spec, notes = build_spec(scene)
            if before is None:  # a change at run time must not make one
                scene = scene_devices.without_blind_sensors(scene, spec, notes)
            self.notes = clamped + notes
            spec.option.timestep = self.options.step
            parts = scene_devices.build_devices(scene, self.noise, existing)
            parts |= build_skins(scene, self.noise, self._skin_settings, existing)
            unique = dict.fromkeys(parts.values())
            world = World(
                spec, unique, seed=self.seed, before=before, forget=forget, start=scene.model
            )
        except ValueError as error:  # MuJoCo rejects a body
            raise SceneError(f"MuJoCo cannot build the world: {error}") from None
        return SimulationState(scene, world, parts)

    def fork(self) -> SimulationState:
        """A copy of the current state, for a snapshot or an independent simulation."""
        return self.state.fork(shared=(self.noise, self.lock))

    def set_physics(self, on: bool) -> None:
        """Enable or disable gravity and contacts."""
        self.physics = on
        self.state.set_physics(on)

    def set_speed(self, speed: float) -> None:
        """Set the simulated seconds per second; 0: as fast as possible. Raises `CommandRefused`."""
        require_finite(speed=speed)
        if speed < 0:
            raise CommandRefused(f"`speed` is {speed:g}, it cannot be negative")
        self.step_driver.set_speed(speed)

    def advance(self, seconds: float) -> None:
        """Advance time. A world that diverges is reset or stopped, as configured.

        One that diverges early after every reset is stopped.
        """
        self.raise_if_failed()
        try:
            self.world.advance(seconds)
        except Diverged as error:
            log.error("%s", error)  # noqa: TRY400 - the message says it all
            self._failed = self._failed + 1 if self.world.time < _EARLY_S else 0
            if self.options.diverged == "stop" or self._failed >= _MAX_EARLY_FAILURES:
                self.failure = str(error)
                raise
            self.reset()

    def raise_if_failed(self) -> None:
        """Raises `Diverged` if the world has stopped permanently."""
        if self.failure:
            raise Diverged(self.failure)

    def overlaps(self) -> list[Finding]:
        """Bodies that overlap now, the deepest first."""
        return current_overlaps(self.world.model, self.world.data)

    # -- at any time --------------------------------------------------------------------------

    @property
    def on_deployment_clock(self) -> bool:
        """Whether a deployment clock drives it, so that results must be deterministic."""
        return not isinstance(self.step_driver, RealTimeDriver)

    def serve(
        self, ports: Iterable[ServedPort], chosen: dict[str, list[str]]
    ) -> dict[str, DevicePort]:
        """The ports of a component, served by the devices that `chosen` lists for each."""
        servants = {**SERVANTS, **WORLD_SERVANTS}
        return serve(
            servants, ports, chosen, self.devices, self.lock, lambda: self.on_deployment_clock
        )

    def start(self, clock: Clock | None = None) -> None:
        """Start: on `clock`, or on the wall clock. Raises `CommandRefused`."""
        self.step_driver = select_driver(self, clock, self.step_driver.speed)
        self.step_driver.start()

    def stop(self) -> None:
        """Stop permanently."""
        self.step_driver.stop()
        with self.lock:
            self._close_devices(besides={})

    def dispatch_events(self) -> None:
        """Call subscribers of new events; from one thread, without holding the lock."""
        self.skin.dispatch()


def read_data(path: Path) -> dict[str, Any]:
    """The scene data that `rcgen simulator` generated. Raises `SceneError`."""
    try:
        data: dict[str, Any] = json.loads(path.read_text("utf-8"))
    except (OSError, ValueError) as error:
        raise SceneError(f"`{path}` cannot be read: {error}") from None
    return data
