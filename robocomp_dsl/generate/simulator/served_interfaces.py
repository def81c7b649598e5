"""Which interfaces the devices of a scene are served as: one table.

In: the devices of a lowered scene. Out: the ports of the component that serves them.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from robocomp_dsl.generate import names


@dataclass(frozen=True, slots=True)
class ServedInterface:
    """Devices of a `kind` serve `interface` of the file of that name.

    `shared`: one port for all of them, called as the interface; else one for each, called as the
    device, with `_suffix` behind it where the device serves more than one. `asked`: only for those
    who ask for it, because there is a newer interface for the same.
    """

    kind: str
    interface: str
    shared: bool = False
    suffix: str = ""
    opt_in: bool = False


SERVED = (
    ServedInterface("differentialrobot", "DifferentialRobot"),
    ServedInterface("omnirobot", "OmniRobot"),
    ServedInterface("differentialrobot", "GenericBase", suffix="base"),
    ServedInterface("omnirobot", "GenericBase", suffix="base"),
    ServedInterface("differentialrobot", "FullPoseEstimation", suffix="pose"),
    ServedInterface("omnirobot", "FullPoseEstimation", suffix="pose"),
    ServedInterface("laser", "Laser"),
    ServedInterface("joint", "JointMotor", shared=True),
    ServedInterface("prismaticjoint", "JointMotor", shared=True),
    ServedInterface("joint", "ControlBoard", shared=True),
    ServedInterface("prismaticjoint", "ControlBoard", shared=True),
    ServedInterface("camera", "CameraSimple"),
    ServedInterface("rgbd", "CameraRGBDSimple", shared=True),
    ServedInterface("rgbd", "RGBD"),
    ServedInterface("imu", "IMU"),
    ServedInterface("gps", "GPS"),
    ServedInterface("ultrasound", "Ultrasound", shared=True),
    ServedInterface("battery", "BatteryStatus"),
    ServedInterface("touchsensor", "TouchSensor", shared=True),
    ServedInterface("model_camera", "CameraSimple"),
    ServedInterface("model_rgbd", "CameraSimple"),
    ServedInterface("model_rgbd", "CameraRGBDSimple", shared=True),
    ServedInterface("model_imu", "IMU"),
    ServedInterface("cartesian", "CartesianController"),
    ServedInterface("model_touch", "TouchSensor", shared=True),
    ServedInterface("model_range", "Ultrasound", shared=True),
    ServedInterface("display", "Display"),
    ServedInterface("skin", "Skin", shared=True),
    ServedInterface("joint", "JointMotorSimple", shared=True, opt_in=True),
    ServedInterface("prismaticjoint", "JointMotorSimple", shared=True, opt_in=True),
    ServedInterface("camera", "Camera", shared=True, opt_in=True),
    ServedInterface("rgbd", "Camera", shared=True, opt_in=True),
    ServedInterface("model_camera", "Camera", shared=True, opt_in=True),
    ServedInterface("model_rgbd", "Camera", shared=True, opt_in=True),
)

OPT_IN = tuple(dict.fromkeys(row.interface for row in SERVED if row.opt_in))
"""What can be asked for."""

BOARDS = "ControlBoard"
"""The shared interface that has a port for each group of joints, called as the group; those of no
group share the port that is called as the interface."""


OF_THE_WORLD = ("InnerModelManager", "Simulation")
"""Interfaces that are served for the world as a whole."""

COMPONENT = "Component"
"""What every component serves of itself."""

DEFAULT_RATE = 50.0
"""Of a skin that does not tell its rate [Hz]."""

CLOCK = "Clock"
"""The topic on which it tells the time, where it makes that of a deployment."""


_ON_A_BASE = ("Laser", "RGBD", "Camera")
"""Interfaces that tell the state of the base under the device, too."""

DEFAULT_PERIOD = 10
"""How often a topic is published that says nothing else [ms]."""


@dataclass(frozen=True, slots=True)
class Topic:
    """What the answer of `asked` of a port that serves `interface` is published as.

    Every `period` ms, if it is heard; or `at_once`, when there is something new, whatever the
    period; or in those periods in which the servant has `news` (`asked` is empty), which it waits
    for in lock-step if they are `dear`.
    """

    interface: str
    query: str
    published: str
    operation: str
    file: str
    period: int = DEFAULT_PERIOD
    immediate: bool = False
    on_change: bool = False
    expensive: bool = False


TOPICS = (
    Topic(
        "DifferentialRobot",
        "",
        "DifferentialRobotPub",
        "pushBaseState",
        "DifferentialRobotPub",
        on_change=True,
    ),
    Topic("OmniRobot", "getBaseState", "OmniRobotPub", "pushBaseState", "OmniRobotPub"),
    Topic(
        "FullPoseEstimation",
        "getFullPoseEuler",
        "FullPoseEstimationPub",
        "newFullPose",
        "FullPoseEstimationPub",
    ),
    Topic("Laser", "", "LaserPub", "pushLaserData", "LaserPub", on_change=True),
    Topic("JointMotor", "getAllMotorState", "JointMotorPub", "motorStates", "JointMotorPub"),
    Topic("ControlBoard", "getState", "ControlBoardState", "boardState", "ControlBoard"),
    Topic("IMU", "getDataImu", "IMUPub", "publish", "IMUPub", period=5),
    Topic(
        "CameraRGBDSimple",
        "",
        "CameraRGBDSimplePub",
        "pushRGBD",
        "CameraRGBDSimplePub",
        on_change=True,
        expensive=True,
    ),
    Topic("Skin", "getFrame", "SkinFrame", "frame", "Skin", immediate=True),
    Topic("Skin", "getContacts", "SkinContacts", "contacts", "Skin", immediate=True),
)


@dataclass(frozen=True, slots=True)
class ServedAs:
    """A port, and the devices (id, kind) that it stands for; none: the world as a whole.

    `with_` are devices that the first one needs beside it.
    """

    port: str
    interface: str
    devices: tuple[tuple[str, str], ...] = ()
    with_: tuple[str, ...] = ()

    @property
    def ids(self) -> list[str]:
        """All devices that a servant is given; an empty id is the world."""
        return [*(id_ for id_, _ in self.devices or (("", ""),)), *self.with_]


def served(scene: dict[str, Any], also: Sequence[str] = ()) -> tuple[ServedAs, ...]:
    """The ports for a lowered scene, in the order of the table; `also` is asked for."""
    offers = [entry for entry in SERVED if not entry.opt_in or entry.interface in also]
    together = dict.fromkeys(offer.interface for offer in offers if offer.shared)
    taken = {entry.lower() for entry in (*together, *OF_THE_WORLD, CLOCK, COMPONENT)}
    found: list[ServedAs] = []
    beside = _bases(scene)
    for interface in dict.fromkeys(offer.interface for offer in offers):
        kinds = {offer.kind: offer for offer in offers if offer.interface == interface}
        here = [d for d in scene["devices"] if d["kind"] in kinds]
        if here and interface in together:
            pairs = tuple((d["id"], d["kind"]) for d in here)
            found.append(ServedAs(interface, interface, pairs, beside(interface, here[0])))
            continue
        for device in here:
            suffix = kinds[device["kind"]].suffix
            port = _free("_".join(filter(None, (identifier(device["id"]), suffix))), taken)
            pair = (device["id"], device["kind"])
            found.append(ServedAs(port, interface, (pair,), beside(interface, device)))
    return (*_boards(found, scene, taken), *(ServedAs(name, name) for name in OF_THE_WORLD))


@dataclass(frozen=True, slots=True)
class Published:
    """A topic as the port `port`; its data are those of the port `source`."""

    port: str
    source: str
    topic: Topic


def published(ports: Sequence[ServedAs]) -> tuple[Published, ...]:
    """The topics of served ports."""
    return tuple(
        Published(t.published if p.port == p.interface else f"{p.port}_pub", p.port, t)
        for p in ports
        for t in TOPICS
        if t.interface == p.interface
    )


def period_of(topics: Sequence[Published]) -> int:
    """The period in ms of a component that publishes `topics`."""
    return (
        math.gcd(*(topic.topic.period for topic in topics if not topic.topic.immediate))
        or DEFAULT_PERIOD
    )


def _boards(ports: Sequence[ServedAs], scene: dict[str, Any], taken: set[str]) -> list[ServedAs]:
    """The same ports, with one for each group of joints in the place of that for all boards."""
    groups = {d["id"]: d["settings"].get("board", "") for d in scene["devices"]}
    split: list[ServedAs] = []
    for served_as in ports:
        if served_as.interface != BOARDS:
            split.append(served_as)
            continue
        for group in dict.fromkeys(groups[id_] for id_, _ in served_as.devices):
            port = _free(identifier(group), taken) if group else served_as.port
            here = tuple(pair for pair in served_as.devices if groups[pair[0]] == group)
            split.append(ServedAs(port, served_as.interface, here))
    return split


def _free(preferred: str, taken: set[str]) -> str:
    """The name of a port that no other has; upper and lower case are the same."""
    name = names.identifier(preferred, ())
    while name.lower() in taken:
        name += "_"
    taken.add(name.lower())
    return name


def identifier(written: str) -> str:
    """A text as a name of the languages, not too long for a line of code."""
    name = re.sub(r"[^A-Za-z0-9_]", "_", written).strip("_")[:36]
    return name if name[:1].isalpha() else f"n{name}"


def not_served(scene: dict[str, Any]) -> Sequence[tuple[str, str]]:
    """Devices (id, kind) that no interface is there for."""
    kinds = {entry.kind for entry in SERVED if not entry.opt_in}
    return [(d["id"], d["kind"]) for d in scene["devices"] if d["kind"] not in kinds]


SKIN_RATES = (1.0, 1000.0)
"""Hz: what the parameter takes."""


def skin_rate(scene: dict[str, Any]) -> float:
    """The rate of the fastest skin [Hz]; 0 without one: they tell their frames together."""
    rates = [
        d["settings"].get("rate", DEFAULT_RATE) for d in scene["devices"] if d["kind"] == "skin"
    ]
    slowest, fastest = SKIN_RATES
    return float(min(max(*rates, slowest), fastest)) if rates else 0.0


def _bases(scene: dict[str, Any]) -> Callable[[str, dict[str, Any]], tuple[str, ...]]:
    """What finds the mobile base under a device, for interfaces that tell its state."""
    parents = {frame["id"]: frame["parent"] for frame in scene["frames"]}
    bases = {d["frame"]: d["id"] for d in scene["devices"] if d["kind"].endswith("robot")}

    def beside(interface: str, device: dict[str, Any]) -> tuple[str, ...]:
        at = device["frame"] if interface in _ON_A_BASE else ""
        while at and at not in bases:
            at = parents[at]
        return (bases[at],) if at else ()

    return beside
