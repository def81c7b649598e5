"""From parameters to a simulated base with a laser in a room."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from generated.params import BaseGroup, LaserGroup, MobileBaseParams

from robocomp_dsl.hardware.differential_robot import Mechanics
from robocomp_dsl.hardware.laser import LaserSettings
from robocomp_dsl.hardware.mujoco.differential_robot import DifferentialRobot
from robocomp_dsl.hardware.mujoco.laser import Laser, Mount
from robocomp_dsl.hardware.mujoco.room import Room
from robocomp_dsl.hardware.mujoco.world import World

HERE = Path(__file__).parent


@dataclass(frozen=True, slots=True)
class Simulation:
    """The world and the two devices in it."""

    world: World
    base: DifferentialRobot
    laser: Laser


def simulate(params: MobileBaseParams) -> Simulation:
    """Build it. Raises `ConfigError` for a wrong room, `SceneError` for an impossible one."""
    room = Room.read(HERE / params.room)
    base = DifferentialRobot(
        _mechanics(params.base),
        room.start,
        drift=params.base.drift,
        watchdog=params.base.watchdog / 1000,
    )
    mount = Mount(base.name, y=params.laser.height, z=params.laser.ahead)
    laser = Laser(_settings(params.laser), mount)
    return Simulation(World(room.spec(), (base, laser), seed=params.seed), base, laser)


def _mechanics(given: BaseGroup) -> Mechanics:
    return Mechanics(
        wheel_radius=given.wheel_radius,
        axis=given.axis,
        body_radius=given.radius,
        mass_kg=given.mass,
        encoder_steps=given.encoder_steps,
        gear_ratio=given.gear_ratio,
        max_adv=given.max_adv,
        max_rot=given.max_rot,
        max_acceleration=given.max_acceleration,
    )


def _settings(given: LaserGroup) -> LaserSettings:
    return LaserSettings(
        measures=given.measures,
        degrees=given.degrees,
        min_range=given.min_range,
        max_range=given.max_range,
        noise=given.noise,
        period=given.period / 1000,
    )
