"""Table of the interfaces that the devices of a scene are served as.

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
    """Devices of a `kind` serve `interface` of the file with the same name.

    `shared`: one port for all of them, named after the interface; else one port each, named after
    the device, with `_suffix` appended if the device serves several. `opt_in`: generated only on
    request, because a newer interface replaces it.
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
"""The interfaces that are generated only on request."""

BOARDS = "ControlBoard"
"""The shared interface that has one port per group of joints, named after the group. Joints without
a group share the port named after the interface."""


OF_THE_WORLD = ("InnerModelManager", "Simulation")
"""Interfaces of the world as a whole."""

COMPONENT = "Component"
"""Interfaces that every component serves."""

DEFAULT_RATE = 50.0
"""Default rate of a skin [Hz]."""

CLOCK = "Clock"
"""The topic of simulated time, published by the clock source of a deployment."""


_ON_A_BASE = ("Laser", "RGBD", "Camera")
"""Interfaces that also report the state of the base that carries the device."""

DEFAULT_PERIOD = 10
"""Default period of a topic [ms]."""


@dataclass(frozen=True, slots=True)
class Topic:
    """The topic that publishes the result of `query` of a port that serves `interface`.

    It is published every `period` ms while it has subscribers; or, if `immediate`, whenever there
    is new data; or, with `on_change` (`query` is empty), in periods in which the servant has news,
    for which lock-step waits if the topic is `expensive`.
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
    """A port, and its devices (id, kind); no devices: the world as a whole.

    `with_` are further devices that the first one needs.
    """

    port: str
    interface: str
    devices: tuple[tuple[str, str], ...] = ()
    with_: tuple[str, ...] = ()

    @property
    def ids(self) -> list[str]:
        """All devices of a servant; an empty id is the world."""
        return [*(id_ for id_, _ in self.devices or (("", ""),)), *self.with_]


def served(scene: dict[str, Any], also: Sequence[str] = ()) -> tuple[ServedAs, ...]:
    """The ports for a lowered scene, in the order of the table; `also` lists opt-in interfaces."""
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
    """A topic as the port `port`; its data come from the port `source`."""

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
    """The ports with the port of all boards replaced by one port per group of joints."""
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
    """A unique port name; case is ignored."""
    name = names.identifier(preferred, ())
    while name.lower() in taken:
        name += "_"
    taken.add(name.lower())
    return name


def identifier(written: str) -> str:
    """A text as an identifier of the languages, short enough for a line of code."""
    name = re.sub(r"[^A-Za-z0-9_]", "_", written).strip("_")[:36]
    return name if name[:1].isalpha() else f"n{name}"


def not_served(scene: dict[str, Any]) -> Sequence[tuple[str, str]]:
    """Devices (id, kind) without an interface."""
    kinds = {entry.kind for entry in SERVED if not entry.opt_in}
    return [(d["id"], d["kind"]) for d in scene["devices"] if d["kind"] not in kinds]


SKIN_RATES = (1.0, 1000.0)
"""The permitted range of the rate [Hz]."""


def skin_rate(scene: dict[str, Any]) -> float:
    """The rate of the fastest skin [Hz]; 0 without skin. All skin is sampled together."""
    rates = [
        d["settings"].get("rate", DEFAULT_RATE) for d in scene["devices"] if d["kind"] == "skin"
    ]
    slowest, fastest = SKIN_RATES
    return float(min(max(*rates, slowest), fastest)) if rates else 0.0


def _bases(scene: dict[str, Any]) -> Callable[[str, dict[str, Any]], tuple[str, ...]]:
    """Finds the mobile base under a device, for interfaces that report its state."""
    parents = {frame["id"]: frame["parent"] for frame in scene["frames"]}
    bases = {d["frame"]: d["id"] for d in scene["devices"] if d["kind"].endswith("robot")}

    def beside(interface: str, device: dict[str, Any]) -> tuple[str, ...]:
        at = device["frame"] if interface in _ON_A_BASE else ""
        while at and at not in bases:
            at = parents[at]
        return (bases[at],) if at else ()

    return beside
