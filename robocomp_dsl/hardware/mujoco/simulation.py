"""A scene that runs by itself, at a `pace` of its own or that of its deployment.

In: a scene and options. Out: `devices` to be served, under `turns`, the only way to touch the world
while it runs. A world that has diverged is started again or stopped, as the options say.
"""

from __future__ import annotations

import json
import logging
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

from robocomp_dsl.hardware.errors import CommandRefused, Diverged, SceneError, finite
from robocomp_dsl.hardware.findings import Finding
from robocomp_dsl.hardware.mujoco.branch import Branch
from robocomp_dsl.hardware.mujoco.noise import NoiseLevel
from robocomp_dsl.hardware.mujoco.overlaps import overlaps_of
from robocomp_dsl.hardware.mujoco.scene_devices import parts_of
from robocomp_dsl.hardware.mujoco.scene_joints import JointBoard
from robocomp_dsl.hardware.mujoco.scene_limits import fitting
from robocomp_dsl.hardware.mujoco.scene_skins import skin_parts
from robocomp_dsl.hardware.mujoco.scene_spec import build_spec
from robocomp_dsl.hardware.mujoco.skin_stream import SkinStream
from robocomp_dsl.hardware.mujoco.world import World
from robocomp_dsl.hardware.pace import Pace, pace_for
from robocomp_dsl.hardware.pace.own import OwnPace
from robocomp_dsl.hardware.scene import Scene
from robocomp_dsl.hardware.serving import Port, serve
from robocomp_dsl.hardware.skin import SkinSettings
from robocomp_dsl.hardware.turns import Turns
from robocomp_dsl.runtime import ServedPort
from robocomp_dsl.runtime.clock import Clock

_SOON = 0.1
"""Simulated seconds after a reset in which a sound world does not diverge."""

_MOST_FAILED = 3
"""Worlds that diverge so soon one after the other, and no more is tried."""

WORLD = ""
"""The world itself among the devices."""

log = logging.getLogger("robocomp.simulation")


@dataclass(frozen=True, slots=True)
class Options:
    """How a world runs.

    `step` of the physics in s; `speed` in simulated seconds per second, 0: as fast as it can;
    `noise` is a factor on what the devices declare; `skin` is how all skin in it is set up;
    `reference_timeout` is how long who pushes joints may be silent [s], 0: for ever.
    """

    seed: int = 1
    step: float = 0.002
    speed: float = 1.0
    noise: float = 1.0
    diverged: Literal["reset", "stop"] = "reset"
    skin: SkinSettings = field(default_factory=SkinSettings)
    reference_timeout: float = 0.0


class Simulation:
    """Not running until `start`; what is in `devices` changes with the scene."""

    def __init__(self, scene: Scene, options: Options = Options()) -> None:
        self._scene = scene
        self.options = options
        self.turns = Turns()
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
        self.pace: Pace = pace_for(self, None, 1.0)
        self.set_speed(options.speed)
        self.reset()

    @classmethod
    def read(cls, path: Path, options: Options = Options()) -> Simulation:
        """The scene in a JSON file that `rcgen simulator` wrote. Raises `SceneError`."""
        return cls(Scene.of_data(read_data(path)["scene"], path.parent), options)

    # -- while it is the caller's turn --------------------------------------------------------

    def reset(self) -> None:
        """Everything as it was at the start, time included. Raises `SceneError`."""
        self.renew()
        self.pace.anew(0.0)

    def renew(self) -> None:
        """Everything as it was at the start, but for the clock. Raises `SceneError`."""
        self.become(self._built(self._scene))

    def restore(self, branch: Branch) -> None:
        """Go on from here, at its time."""
        self.revision += 1
        self.become(branch)
        self.pace.anew(self.world.reached)

    @property
    def world(self) -> World:
        """The physics as it is now."""
        return self.branch.world

    @property
    def time(self) -> float:
        """Simulated time in s."""
        return self.world.time

    @property
    def dt(self) -> float:
        """Length of one step of the physics in s."""
        return self.world.step

    @property
    def left(self) -> float:
        """Simulated seconds to the next step."""
        return self.world.step - (self.world.reached - self.world.time)

    def become(self, branch: Branch) -> None:
        """Go on from here; the devices of before are no longer those of the world."""
        self.branch = branch
        self._scene = branch.scene
        branch.set_physics(self.physics)
        self.devices.clear()
        self.devices.update(branch.devices)
        self.devices[WORLD] = self
        self._follow_skin(branch)
        for one in branch.devices.values():
            if hasattr(one, "turns"):  # it looks at the world when it likes
                one.turns = self.turns
        self.set_reference_timeout(self._reference_timeout)
        self.failure = ""

    def _follow_skin(self, branch: Branch) -> None:
        """The skin of this world goes on where that of the last one was."""
        ids = [one.id for one in branch.scene.skins]
        self.skin.follow(branch.devices[ids[0]] if ids else None)
        self.skin.adjust(self._skin_settings)
        self._skins.update(ids)
        self.devices.update(dict.fromkeys(self._skins, self.skin))

    def set_reference_timeout(self, seconds: float) -> None:
        """How long who pushes torques or currents may be silent [s]; 0: for ever."""
        self._reference_timeout = seconds
        for one in dict.fromkeys(self.branch.devices.values()):
            if isinstance(one, JointBoard):
                one.settings.set_reference_timeout(seconds)

    def set_skin(self, settings: SkinSettings) -> None:
        """Set up all skin anew."""
        self._skin_settings = settings
        self.skin.adjust(settings)

    def rebuild(self, scene: Scene, forget: Collection[str] = ()) -> None:
        """Another scene, in which all that is still there goes on. Raises `SceneError`."""
        made = self._built(scene, self.branch.devices, self.world, forget)
        self.revision += 1
        failure = self.failure
        self.become(made)
        self.failure = failure

    def _built(
        self,
        scene: Scene,
        kept: Mapping[str, Any] = MappingProxyType({}),
        before: World | None = None,
        forget: Collection[str] = (),
    ) -> Branch:
        try:
            scene, told = fitting(scene)
            spec, notes = build_spec(scene)
            self.notes = told + notes
            spec.option.timestep = self.options.step
            parts = parts_of(scene, self.noise, kept)
            parts |= skin_parts(scene, self.noise, self._skin_settings, kept)
            unique = dict.fromkeys(parts.values())
            world = World(
                spec, unique, seed=self.seed, before=before, forget=forget, start=scene.model
            )
        except ValueError as error:  # what MuJoCo says of a body that it does not take
            raise SceneError(f"MuJoCo cannot build the world: {error}") from None
        return Branch(scene, world, parts)

    def copy(self) -> Branch:
        """The world as it is now, to be kept or to go on by itself."""
        return self.branch.copy(shared=(self.noise, self.turns))

    def set_physics(self, on: bool) -> None:
        """Gravity and contacts, or neither."""
        self.physics = on
        self.branch.set_physics(on)

    def set_speed(self, speed: float) -> None:
        """Simulated seconds per second; 0: as fast as it can. Raises `CommandRefused`."""
        finite(speed=speed)
        if speed < 0:
            raise CommandRefused(f"`speed` is {speed:g}, it cannot be negative")
        self.pace.set_speed(speed)

    def advance(self, seconds: float) -> None:
        """Let time pass. A world that diverges is reset, or stays where it is, as configured.

        One that diverges soon after every reset stays, too: it would for ever.
        """
        self.judge()
        try:
            self.world.advance(seconds)
        except Diverged as error:
            log.error("%s", error)  # noqa: TRY400 - the message is all there is to know
            self._failed = self._failed + 1 if self.world.time < _SOON else 0
            if self.options.diverged == "stop" or self._failed >= _MOST_FAILED:
                self.failure = str(error)
                raise
            self.reset()

    def judge(self) -> None:
        """Pass while it is well. Raises `Diverged` for a world that has stopped for good."""
        if self.failure:
            raise Diverged(self.failure)

    def overlaps(self) -> list[Finding]:
        """What is in each other now, the deepest first."""
        return overlaps_of(self.world.model, self.world.data)

    # -- at any time --------------------------------------------------------------------------

    @property
    def in_step(self) -> bool:
        """Whether its time is that of a deployment, where nothing may be left to chance."""
        return not isinstance(self.pace, OwnPace)

    def serve(self, ports: Iterable[ServedPort], chosen: dict[str, list[str]]) -> dict[str, Port]:
        """The ports of a component, answered by the devices that `chosen` lists for each."""
        return serve(ports, chosen, self.devices, self.turns, lambda: self.in_step)

    def start(self, clock: Clock | None = None) -> None:
        """Let it run: by `clock`, or by that of the machine. Raises `CommandRefused`."""
        self.pace = pace_for(self, clock, self.pace.speed)
        self.pace.start()

    def stop(self) -> None:
        """Let it rest for good."""
        self.pace.stop()

    def tell(self) -> None:
        """Let others hear of what has happened, from one thread and outside of the turn."""
        self.skin.tell()


def read_data(path: Path) -> dict[str, Any]:
    """What `rcgen simulator` wrote. Raises `SceneError`."""
    try:
        data: dict[str, Any] = json.loads(path.read_text("utf-8"))
    except (OSError, ValueError) as error:
        raise SceneError(f"`{path}` cannot be read: {error}") from None
    return data
