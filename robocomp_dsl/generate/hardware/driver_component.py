"""Generates a component for a real device that mirrors a simulated one; the user writes the driver.

In: the simulator of a world, ids of devices in it, and properties of the simulated device. Out:
`OutputFile`s. The component serves the same interfaces with the same code; only `driver.py` talks
to the hardware, and a test checks it with the conformance rules of the simulated device.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from typing import Any

from robocomp_dsl.generate.hardware.skeleton import Skeleton, skeleton
from robocomp_dsl.generate.names import camel
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.plan import plan
from robocomp_dsl.generate.python.component_names import names_of
from robocomp_dsl.generate.simulator.handlers import simulator_code
from robocomp_dsl.generate.simulator.served_interfaces import published
from robocomp_dsl.generate.simulator.simulator import README, WORKER, Simulator, rows, world_files
from robocomp_dsl.generate.templates import render
from robocomp_dsl.model.component import Component

FOLDER = "python/hardware/"

PROTOCOLS: Mapping[str, tuple[str, str]] = {
    "differentialrobot": ("devices.mobile_base", "MobileBaseDevice"),
    "omnirobot": ("devices.mobile_base", "MobileBaseDevice"),
    "laser": ("devices.laser", "LaserDevice"),
    "joint": ("drivers.motor_bus", "MotorBus"),
    "prismaticjoint": ("drivers.motor_bus", "MotorBus"),
    "camera": ("devices.camera", "CameraDevice"),
    "rgbd": ("devices.camera", "CameraDevice"),
    "model_camera": ("devices.camera", "CameraDevice"),
    "model_rgbd": ("devices.camera", "CameraDevice"),
    "imu": ("devices.imu", "ImuDevice"),
    "model_imu": ("devices.imu", "ImuDevice"),
    "gps": ("devices.gps", "GpsDevice"),
    "ultrasound": ("devices.ultrasound", "UltrasoundDevice"),
    "model_range": ("devices.ultrasound", "UltrasoundDevice"),
    "battery": ("devices.battery", "BatteryDevice"),
    "touchsensor": ("devices.touch_sensor", "TouchSensorDevice"),
    "model_touch": ("devices.touch_sensor", "TouchSensorDevice"),
}
"""Module of `robocomp_dsl.hardware`, and the Protocol that a driver of each kind implements."""

JOINTS = ("joint", "prismaticjoint")


class UnsupportedDevice(Exception):
    """No driver component can be generated; the message gives the reason and the valid devices."""


@dataclass(frozen=True, slots=True)
class DriverComponent:
    """The simulator of a world, reduced to the ports of the devices `ids`."""

    simulator: Simulator
    ids: tuple[str, ...]
    kind: str

    @property
    def name(self) -> str:
        """Name of the component."""
        return self.simulator.name

    @property
    def title(self) -> str:
        """The name in CamelCase, as the first part of class names."""
        return camel(self.simulator.name)

    @property
    def devices(self) -> str:
        """The ids of the devices, joined."""
        return ", ".join(self.ids)

    @property
    def motors(self) -> bool:
        """Whether the device is a bus of motors."""
        return self.kind in JOINTS


def driver_component(simulator: Simulator, ids: Sequence[str], name: str) -> DriverComponent:
    """The driver component `name` for devices of one kind; a board's name selects all its motors.

    Raises `UnsupportedDevice`.
    """
    boards = {p.port: [id_ for id_, kind in p.devices if kind in JOINTS] for p in simulator.ports}
    ids = list(
        dict.fromkeys(
            joint for id_or_kind in ids for joint in boards.get(id_or_kind) or [id_or_kind]
        )
    )
    kinds = {id_: kind for port in simulator.ports for id_, kind in port.devices}
    there = {id_: kind for id_, kind in kinds.items() if kind in PROTOCOLS}
    found = [_kind(id_or_kind, kinds, there) for id_or_kind in ids]
    if any((id_or_kind in JOINTS) != (found[0] in JOINTS) for id_or_kind in found):
        raise UnsupportedDevice(
            "motors and other devices have drivers of their own: one component for each"
        )
    if len(ids) > 1 and found[0] not in JOINTS:
        raise UnsupportedDevice(f"a driver is for one `{found[0]}`; only motors share one")
    ports = [
        replace(port, devices=tuple(d for d in port.devices if d[0] in ids), with_=())
        for port in simulator.ports
    ]
    selected = tuple(port for port in ports if port.devices)
    return DriverComponent(
        replace(simulator, name=name, ports=selected, topics=published(selected)),
        tuple(ids),
        found[0],
    )


def _kind(id: str, kinds: Mapping[str, str], there: Mapping[str, str]) -> str:
    if id in there:
        return there[id]
    if id in kinds:
        raise UnsupportedDevice(f"there are no drivers for `{id}`, a `{kinds[id]}`")
    near = get_close_matches(id, there, n=1)
    ways = f"did you mean `{near[0]}`?" if near else "there are " + ", ".join(sorted(there))
    raise UnsupportedDevice(
        f"there is no device `{id}`: {ways if there else 'the world holds none'}"
    )


def descriptions(device: DriverComponent) -> list[OutputFile]:
    """The CDSL and the PDSL file; the user owns them afterwards."""
    imports = dict.fromkeys(port.interface for port in device.simulator.ports)
    imports |= dict.fromkeys(topic.topic.file for topic in device.simulator.topics)
    context: dict[str, Any] = {"device": device, "simulator": device.simulator, "imports": imports}
    return [
        OutputFile(
            f"{device.name}.{kind}", render(f"{FOLDER}hardware.{kind}.jinja", **context), True
        )
        for kind in ("cdsl", "pdsl")
    ]


def files(
    device: DriverComponent, component: Component, known: Mapping[str, object]
) -> list[OutputFile]:
    """All files except the descriptions. `known` has the values of the device's properties."""
    py_names, topics = names_of(component), device.simulator.topics
    # a device without subscribers is monitored as well
    code = simulator_code(device.simulator.source, component, py_names, topics, publish_always=True)
    module, protocol = PROTOCOLS[device.kind]
    bones: Skeleton = skeleton(module, protocol, known)
    context: dict[str, Any] = {"device": device, "code": code, "bones": bones}
    context["rows"] = rows(device.simulator.ports)
    user_files = ("driver.py", f"test_{device.name}.py", WORKER, README)
    sources = {f"test_{device.name}.py": "test_driver.py"}
    return [
        *(path for path in plan(component) if path.path not in (WORKER, README)),
        *world_files(device.simulator, py_names.package),
        OutputFile(
            f"{py_names.package}/hardware.py", render(f"{FOLDER}hardware.py.jinja", **context)
        ),
        *(
            OutputFile(
                path, render(f"{FOLDER}{sources.get(path, path)}.jinja", **context), write_once=True
            )
            for path in user_files
        ),
    ]
