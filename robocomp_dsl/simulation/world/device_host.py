"""Hosts the devices of a deployment on the boards of a simulated world.

In: a simulation. Out: the parts of its board by port name, and the chains of joints to a tip.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import mujoco

from robocomp_dsl.hardware.control.errors import BadValue
from robocomp_dsl.hardware.device_manager.boards import BoardPart
from robocomp_dsl.hardware.device_manager.description import DeviceSpec
from robocomp_dsl.hardware.device_manager.host import DeviceHost
from robocomp_dsl.hardware.devices.errors import SceneError
from robocomp_dsl.hardware.kinematics.cartesian import JointChain
from robocomp_dsl.simulation.devices.control_board_chain import extract_chain
from robocomp_dsl.simulation.scene.scene_joints import JointBoard
from robocomp_dsl.simulation.scene.scene_spec import body_name
from robocomp_dsl.simulation.world.simulation import Simulation

_SLICE = 0.01

UNGROUPED = "ControlBoard"
"""The part of the joints without a group."""


class SimulatedDeviceHost(DeviceHost):
    """The devices of a deployment on the boards of a world."""

    def __init__(self, simulation: Simulation, environment: Mapping[str, str]) -> None:
        self._simulation = simulation
        super().__init__(
            environment,
            lambda: board_parts(simulation),
            simulation.lock,
            lambda spec, joints: _chain(simulation, spec, joints),
            lambda: simulation.on_deployment_clock,
        )

    def stop(self, advance: Callable[[], object] | None = None) -> None:
        """Park and close all devices; a world on a deployment clock advances meanwhile."""
        super().stop(advance or (self._advance if self._simulation.on_deployment_clock else None))

    def _advance(self) -> None:
        with self._simulation.lock:
            self._simulation.advance(_SLICE)


def board_parts(simulation: Simulation) -> dict[str, BoardPart]:
    """Groups of joints by the names of their ports."""
    found = (device for device in simulation.devices.values() if isinstance(device, JointBoard))
    board = next(found, None)
    if board is None:
        return {}
    groups: dict[str, list[str]] = {}
    for joint, group in board.groups.items():
        groups.setdefault(group or UNGROUPED, []).append(joint)
    return {name: BoardPart(board.board, tuple(names)) for name, names in groups.items()}


def _chain(
    simulation: Simulation, spec: DeviceSpec, joints: tuple[str, ...]
) -> tuple[JointChain, tuple[str, ...]]:
    """The chain of the `joints` that move the parameter `tip`, in the body `base` if set."""
    tip, base = str(spec.parameters.get("tip", "")), str(spec.parameters.get("base", ""))
    if not tip:
        raise BadValue(f"device `{spec.name}`: set `tip`, the body or site that it moves")
    if unknown := [key for key in spec.parameters if key not in ("tip", "base")]:
        raise BadValue(f"device `{spec.name}`: there is no parameter `{unknown[0]}`")
    model = simulation.world.model
    tip, base = _known(model, tip), _known(model, base)
    moving = tuple(joint for joint in joints if _moves(model, joint, tip))
    if not moving:
        raise SceneError(f"device `{spec.name}`: no joint of its board moves `{tip}`")
    return extract_chain(model, moving, tip, base=base), moving


def _known(model: Any, name: str) -> str:
    """The MuJoCo name of a body or site of the model file, or of a frame of the scene."""
    called = body_name(name)
    body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, called) if name else -1
    return called if body >= 0 else name


def _moves(model: Any, joint: str, tip: str) -> bool:
    try:
        extract_chain(model, (joint,), tip)
    except SceneError as error:
        if "does not move" in str(error):
            return False
        raise
    return True
