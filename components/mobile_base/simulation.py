"""Builds a simulated base with a laser in a room from parameters."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from mobile_base_generated.params import BaseGroup, LaserGroup, MobileBaseParams

from robocomp_dsl.hardware.devices.differential_robot import Mechanics
from robocomp_dsl.hardware.devices.laser import LaserSettings
from robocomp_dsl.simulation.devices.differential_robot import DifferentialRobot
from robocomp_dsl.simulation.devices.laser import Laser, LaserMount
from robocomp_dsl.simulation.scene.room import Room
from robocomp_dsl.simulation.world.world import World

HERE = Path(__file__).parent


@dataclass(frozen=True, slots=True)
class Simulation:
    """The world and the two devices in it."""

    world: World
    base: DifferentialRobot
    laser: Laser


def simulate(params: MobileBaseParams) -> Simulation:
    """Build it. Raises `ConfigError` for an invalid room, `SceneError` for an impossible one."""
    room = Room.read(HERE / params.room)
    base = DifferentialRobot(
        _mechanics(params.base),
        room.start,
        drift=params.base.drift,
        watchdog=params.base.watchdog / 1000,
    )
    mount = LaserMount(base.name, y=params.laser.height, z=params.laser.ahead)
    laser = Laser(_settings(params.laser), mount)
    return Simulation(World(room.spec(), (base, laser), seed=params.seed), base, laser)


def _mechanics(params: BaseGroup) -> Mechanics:
    return Mechanics(
        wheel_radius=params.wheel_radius,
        axis=params.axis,
        body_radius=params.radius,
        mass_kg=params.mass,
        encoder_steps=params.encoder_steps,
        gear_ratio=params.gear_ratio,
        max_adv=params.max_adv,
        max_rot=params.max_rot,
        max_acceleration=params.max_acceleration,
    )


def _settings(params: LaserGroup) -> LaserSettings:
    return LaserSettings(
        measures=params.measures,
        degrees=params.degrees,
        min_range=params.min_range,
        max_range=params.max_range,
        noise=params.noise,
        period=params.period / 1000,
    )
