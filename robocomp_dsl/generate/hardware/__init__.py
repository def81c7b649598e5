"""The real-hardware twin of a simulated device: the same component, with a driver to fill in.

In: the simulator of a world, ids of devices in it, and what the simulated device says of itself.
Out: `OutputFile`s. The component serves the same interfaces by the same code; what talks to the
hardware is `driver.py` alone, and a test holds it against what its simulated twin keeps to.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from typing import Any

from robocomp_dsl.generate import plan
from robocomp_dsl.generate.component_names import names_of
from robocomp_dsl.generate.hardware.skeleton import Skeleton, skeleton
from robocomp_dsl.generate.names import camel
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.simulator import README, WORKER, Simulator, rows, world_files
from robocomp_dsl.generate.simulator.handlers import simulator_code
from robocomp_dsl.generate.simulator.offers import published
from robocomp_dsl.generate.templates import render
from robocomp_dsl.model.component import Component

FOLDER = "python/hardware/"

PROTOCOLS: Mapping[str, tuple[str, str]] = {
    "differentialrobot": ("mobile_base", "MobileBaseDevice"),
    "omnirobot": ("mobile_base", "MobileBaseDevice"),
    "laser": ("laser", "LaserDevice"),
    "joint": ("motor_bus", "MotorBus"),
    "prismaticjoint": ("motor_bus", "MotorBus"),
    "camera": ("camera", "CameraDevice"),
    "rgbd": ("camera", "CameraDevice"),
    "model_camera": ("camera", "CameraDevice"),
    "model_rgbd": ("camera", "CameraDevice"),
    "imu": ("imu", "ImuDevice"),
    "model_imu": ("imu", "ImuDevice"),
    "gps": ("gps", "GpsDevice"),
    "ultrasound": ("ultrasound", "UltrasoundDevice"),
    "model_range": ("ultrasound", "UltrasoundDevice"),
    "battery": ("battery", "BatteryDevice"),
    "touchsensor": ("touch_sensor", "TouchSensorDevice"),
    "model_touch": ("touch_sensor", "TouchSensorDevice"),
}
"""Module of `robocomp_dsl.hardware` and Protocol that a driver of each kind keeps to."""

JOINTS = ("joint", "prismaticjoint")


class NoTwin(Exception):
    """There is nothing to make a twin of; the message says why, and what there is."""


@dataclass(frozen=True, slots=True)
class Twin:
    """`made` is the simulator of the world, with the ports of the devices `ids` alone."""

    made: Simulator
    ids: tuple[str, ...]
    kind: str

    @property
    def name(self) -> str:
        """Of the component."""
        return self.made.name

    @property
    def title(self) -> str:
        """The name as the first part of the name of a class."""
        return camel(self.made.name)

    @property
    def devices(self) -> str:
        """The devices, as a text."""
        return ", ".join(self.ids)

    @property
    def motors(self) -> bool:
        """Whether it is a bus of motors."""
        return self.kind in JOINTS


def twin(made: Simulator, ids: Sequence[str], name: str) -> Twin:
    """The twin called `name` of devices of one kind; a board's name is all its motors.

    Raises `NoTwin`.
    """
    boards = {p.port: [id_ for id_, kind in p.devices if kind in JOINTS] for p in made.ports}
    ids = list(dict.fromkeys(joint for one in ids for joint in boards.get(one) or [one]))
    kinds = {id_: kind for port in made.ports for id_, kind in port.devices}
    there = {id_: kind for id_, kind in kinds.items() if kind in PROTOCOLS}
    found = [_kind(one, kinds, there) for one in ids]
    if any((one in JOINTS) != (found[0] in JOINTS) for one in found):
        raise NoTwin("motors and other devices have drivers of their own: one component for each")
    if len(ids) > 1 and found[0] not in JOINTS:
        raise NoTwin(f"a driver is for one `{found[0]}`; only motors share one")
    ports = [
        replace(port, devices=tuple(d for d in port.devices if d[0] in ids), with_=())
        for port in made.ports
    ]
    kept = tuple(port for port in ports if port.devices)
    return Twin(replace(made, name=name, ports=kept, topics=published(kept)), tuple(ids), found[0])


def _kind(id: str, kinds: Mapping[str, str], there: Mapping[str, str]) -> str:
    if id in there:
        return there[id]
    if id in kinds:
        raise NoTwin(f"there are no drivers for `{id}`, a `{kinds[id]}`")
    near = get_close_matches(id, there, n=1)
    ways = f"did you mean `{near[0]}`?" if near else "there are " + ", ".join(sorted(there))
    raise NoTwin(f"there is no device `{id}`: {ways if there else 'the world holds none'}")


def descriptions(made: Twin) -> list[OutputFile]:
    """The CDSL and the PDSL file; both are the user's from now on."""
    imports = dict.fromkeys(one.interface for one in made.made.ports)
    imports |= dict.fromkeys(one.topic.file for one in made.made.topics)
    context: dict[str, Any] = {"twin": made, "simulator": made.made, "imports": imports}
    return [
        OutputFile(f"{made.name}.{kind}", render(f"{FOLDER}hardware.{kind}.jinja", **context), True)
        for kind in ("cdsl", "pdsl")
    ]


def files(made: Twin, component: Component, known: Mapping[str, object]) -> list[OutputFile]:
    """All files but the descriptions. `known` has the values of the properties of the device."""
    called, topics = names_of(component), made.made.topics
    # a device that nobody listens to is looked after as well
    code = simulator_code(made.made.source, component, called, topics, unheard=True)
    module, protocol = PROTOCOLS[made.kind]
    bones: Skeleton = skeleton(module, protocol, known)
    context: dict[str, Any] = {"twin": made, "code": code, "bones": bones}
    context["rows"] = rows(made.made.ports)
    kept = ("driver.py", f"test_{made.name}.py", WORKER, README)
    sources = {f"test_{made.name}.py": "test_driver.py"}
    return [
        *(one for one in plan(component) if one.path not in (WORKER, README)),
        *world_files(made.made),
        OutputFile("generated/hardware.py", render(f"{FOLDER}hardware.py.jinja", **context)),
        *(
            OutputFile(one, render(f"{FOLDER}{sources.get(one, one)}.jinja", **context), keep=True)
            for one in kept
        ),
    ]
