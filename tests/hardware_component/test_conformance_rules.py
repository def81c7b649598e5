"""Rules for devices: each is broken by a device that does what it must not."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.hardware.conformance.joints import JointSubset
from robocomp_dsl.hardware.conformance.rules import RULES, Violation
from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.commands import Commands
from robocomp_dsl.hardware.control.joints import BoardSpec, JointSpec, MotorSpec
from robocomp_dsl.hardware.control.settings import ControlSettings
from robocomp_dsl.hardware.devices.battery import Charge
from robocomp_dsl.hardware.devices.camera import CameraSettings, Picture
from robocomp_dsl.hardware.devices.errors import CommandRefused
from robocomp_dsl.hardware.devices.imu import Inertial
from robocomp_dsl.hardware.devices.laser import LaserSettings, Scan
from robocomp_dsl.hardware.devices.mobile_base import BaseLimits, MobileBaseState
from robocomp_dsl.hardware.kinematics.geodesy import GeoPoint
from robocomp_dsl.hardware.kinematics.planar import ORIGIN, Pose

Device = Any


class Clock:
    """Time that the rules let pass."""

    def __init__(self) -> None:
        self.now = 0.0

    def advance(self, seconds: float) -> None:
        self.now += seconds


def good_laser(clock: Clock) -> Device:
    settings = LaserSettings(measures=5, degrees=90.0, min_range=10.0, max_range=100.0)
    result = SimpleNamespace(settings=settings)
    distances = np.array([10, 20, 50, 90, 100], np.float32)
    result.scan = lambda: Scan(clock.now, settings.angles(), distances.copy())
    return result


def good_base(clock: Clock) -> Device:
    limits = BaseLimits()
    at, since, speed = {"odometry": ORIGIN, "corrected": ORIGIN}, [0.0], [0.0, 0.0]

    def go_on() -> None:
        passed = clock.now - since[0]
        for name, pose in at.items():
            moved = Pose(pose.x, pose.z + speed[0] * passed, pose.alpha + speed[1] * passed)
            at[name] = moved
        since[0] = clock.now

    def set_speed(side: float, adv: float, rot: float) -> None:
        if not (math.isfinite(adv) and abs(adv) <= limits.max_adv):
            raise CommandRefused("no")
        go_on()
        speed[:] = [adv, rot]

    def state() -> MobileBaseState:
        go_on()
        adv, rot = speed
        known = (at["odometry"], at["corrected"])
        return MobileBaseState(clock.now, *known, 0.0, adv, rot, bool(adv or rot))

    def put(name: str) -> Callable[[Pose], None]:
        def to(pose: Pose) -> None:
            go_on()
            at[name] = pose

        return to

    return SimpleNamespace(
        limits=limits,
        set_speed=set_speed,
        stop=lambda: set_speed(0, 0, 0),
        state=state,
        set_odometry=put("odometry"),
        correct=put("corrected"),
    )


def good_imu(clock: Clock) -> Device:
    def measure() -> Inertial:
        return Inertial(clock.now, (0.0, 9.81, 0.0), (0, 0, 0), (0, 0, 1.0), (0, 0, 0), 20.0)

    return SimpleNamespace(measure=measure, reset=lambda: None)


def good_camera(clock: Clock) -> Device:
    it = CameraSettings(width=4, height=3, depth=True)

    def picture() -> Picture:
        colour = np.full((3, 4, 3), int(clock.now * 10) % 256, np.uint8)
        return Picture(clock.now, colour, np.full((3, 4), np.inf, np.float32))

    return SimpleNamespace(settings=it, picture=picture)


NAMES = ("pan", "tilt")


class Plant:
    """Two joints without load, led by a board that steps as time advance."""

    def __init__(self, clock: Clock) -> None:
        clock.advance = self.advance  # type: ignore[method-assign]
        joints = tuple(JointSpec(name, -1.0, 1.0, 3.0, 5.0) for name in NAMES)
        self.board = Board(BoardSpec(joints, tuple(MotorSpec(name) for name in NAMES)))
        self.commands, self.settings = Commands(self.board), ControlSettings(self.board)
        self.position, self.velocity = np.zeros(2), np.zeros(2)
        self.board.begin(self.position, self.velocity)

    def advance(self, seconds: float) -> None:
        for _ in range(round(seconds / 0.002)):
            torque = self.board.step(self.position, self.velocity, 0.002)
            self.velocity = self.velocity + (torque - 0.2 * self.velocity) / 0.05 * 0.002
            self.position = self.position + self.velocity * 0.002


GOOD: dict[str, Callable[[Clock], Device]] = {
    "laser": good_laser,
    "omnirobot": good_base,
    "differentialrobot": good_base,
    "imu": good_imu,
    "camera": good_camera,
    "rgbd": good_camera,
    "joint": Plant,
    "prismaticjoint": Plant,
    "gps": lambda _: SimpleNamespace(
        place=lambda: GeoPoint(39.0, -6.0, 400.0), position=lambda: (0, 0, 0), reset=lambda: None
    ),
    "ultrasound": lambda _: SimpleNamespace(distance=lambda: 500.0, mounted=lambda: ORIGIN),
    "battery": lambda _: SimpleNamespace(charge=lambda: Charge(0.5, 24.0, 10.0, 3600.0)),
    "touchsensor": lambda _: SimpleNamespace(value=lambda: 0.0),
}
GOOD |= {f"model_{kind}": GOOD[kind] for kind in ("camera", "rgbd", "imu")}
GOOD["model_touch"] = GOOD["touchsensor"]
GOOD["model_range"] = GOOD["ultrasound"]


@pytest.mark.parametrize("kind", RULES)
def test_conformance_rules_accept_correct_devices(kind: str) -> None:
    for rule in RULES[kind]:
        clock = Clock()
        device = GOOD[kind](clock)
        rule.check(subject(device), clock.advance)


def subject(device: Device) -> Device:
    return JointSubset(device, NAMES) if isinstance(device, Plant) else device


def scanned(change: Callable[[Scan], Scan]) -> Callable[[Device], None]:
    def spoil(laser: Device) -> None:
        usual = laser.scan
        laser.scan = lambda: change(usual())

    return spoil


def answer(name: str, result: Callable[[], object]) -> Callable[[Device], None]:
    return lambda device: setattr(device, name, result)


def measured(**wrong: Any) -> Callable[[Device], None]:
    def spoil(imu: Device) -> None:
        usual = imu.measure
        imu.measure = lambda: replace(usual(), **wrong)

    return spoil


def stated(**wrong: Any) -> Callable[[Device], None]:
    def spoil(base: Device) -> None:
        usual = base.state
        base.state = lambda: replace(usual(), **wrong)

    return spoil


def seen(**wrong: Any) -> Callable[[Device], None]:
    def spoil(camera: Device) -> None:
        usual = camera.picture
        camera.picture = lambda: replace(usual(), **wrong)

    return spoil


def written_over(name: str, field: str) -> Callable[[Device], None]:
    """The same arrays again and again."""

    def spoil(device: Device) -> None:
        usual = getattr(device, name)
        saved = getattr(usual(), field).copy()

        def give() -> Any:
            result = usual()
            saved[...] = result.time * 7
            return replace(result, **{field: saved})

        setattr(device, name, give)

    return spoil


def stuck(plant: Device) -> None:
    plant.board.limits.torque[:] = 0.0


def broken_encoder(plant: Device) -> None:
    plant.board.state = lambda: SimpleNamespace(
        position=np.array([np.nan, 0]), velocity=np.zeros(2)
    )


def always_driven(plant: Device) -> None:
    usual = plant.board.state
    plant.board.state = lambda: replace(usual(), torque=np.ones(2))


def obedient(plant: Device) -> None:
    plant.commands.position_move = lambda *_: None


SPOILT = [
    ("laser", 0, scanned(lambda s: replace(s, distances=s.distances[:4]))),
    ("laser", 0, scanned(lambda s: replace(s, angles=s.angles.astype(float)))),
    ("laser", 1, scanned(lambda s: replace(s, angles=-s.angles))),
    ("laser", 2, scanned(lambda s: replace(s, distances=s.distances * 2))),
    ("laser", 2, scanned(lambda s: replace(s, distances=s.distances * np.float32("nan")))),
    ("laser", 3, scanned(lambda s: replace(s, time=1.0))),
    ("laser", 3, written_over("scan", "distances")),
    ("ultrasound", 0, answer("distance", lambda: -1.0)),
    ("ultrasound", 1, answer("mounted", lambda: Pose(math.nan, 0, 0))),
    ("omnirobot", 0, stated(time=1.0)),
    ("omnirobot", 0, stated(adv=math.nan)),
    ("omnirobot", 1, answer("set_speed", lambda *_: None)),
    ("omnirobot", 2, answer("correct", lambda *_: None)),
    ("omnirobot", 2, answer("set_odometry", lambda *_: None)),
    ("omnirobot", 3, answer("set_speed", lambda *_: None)),
    ("omnirobot", 3, answer("stop", lambda *_: None)),
    ("omnirobot", 4, answer("set_speed", lambda *_: None)),
    ("imu", 0, measured(acceleration=(0.0, 0.0, 0.0))),
    ("imu", 0, measured(angular_velocity=(0.0, 1.0, 0.0))),
    ("imu", 1, measured(field=(0.0, 0.0, 40.0))),
    ("imu", 2, measured(orientation=(0.0, 1.0, 0.0))),
    ("imu", 3, measured(time=1.0)),
    ("gps", 0, answer("place", lambda: GeoPoint(139.0, -6.0, 400.0))),
    ("gps", 1, answer("position", lambda: (1e6, 0.0, 0.0))),
    ("battery", 0, answer("charge", lambda: Charge(50.0, 24.0, 10.0, 3600.0))),
    ("battery", 0, answer("charge", lambda: Charge(0.5, 0.0, 10.0, 3600.0))),
    ("touchsensor", 0, answer("value", lambda: -1.0)),
    ("camera", 0, seen(colour=np.zeros((4, 3, 3), np.uint8))),
    ("camera", 0, seen(colour=np.zeros((3, 4, 3)))),
    ("camera", 1, seen(time=1.0)),
    ("camera", 1, written_over("picture", "colour")),
    ("rgbd", 2, seen(depth=np.full((3, 4), np.nan, np.float32))),
    ("rgbd", 2, seen(depth=np.zeros((0, 0), np.float32))),
    ("joint", 0, broken_encoder),
    ("joint", 1, always_driven),
    ("joint", 2, obedient),
    ("joint", 3, stuck),
]


@pytest.mark.parametrize(("kind", "at", "spoil"), SPOILT, ids=lambda value: str(value)[:20])
def test_conformance_rule_finds_device_that_breaks_it(
    kind: str, at: int, spoil: Callable[[Device], None]
) -> None:
    clock = Clock()
    device = GOOD[kind](clock)
    spoil(device)
    with pytest.raises(Violation, match=r"\w"):
        RULES[kind][at].check(subject(device), clock.advance)


def test_conformance_rules_each_have_a_device_that_breaks_them() -> None:
    spoilt = {RULES[kind][at] for kind, at, _ in SPOILT}
    assert {rule for rules in RULES.values() for rule in rules} == spoilt
