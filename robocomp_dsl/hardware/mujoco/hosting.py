"""What a simulation lends to the devices that a deployment plugs together: boards and chains.

In: a simulation. Out: the parts of its board by name, as its ports are called, and the chains of
joints to a tip.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import mujoco

from robocomp_dsl.hardware.cartesian import Chain
from robocomp_dsl.hardware.control.errors import BadValue
from robocomp_dsl.hardware.errors import SceneError
from robocomp_dsl.hardware.mujoco.control_board_chain import chain_of
from robocomp_dsl.hardware.mujoco.scene_joints import JointBoard
from robocomp_dsl.hardware.mujoco.scene_spec import body_name
from robocomp_dsl.hardware.mujoco.simulation import Simulation
from robocomp_dsl.hardware.plumbing.boards import BoardPart
from robocomp_dsl.hardware.plumbing.description import DeviceSpec
from robocomp_dsl.hardware.plumbing.host import Hosted

_SLICE = 0.01

WHOLE = "ControlBoard"
"""The part of the joints that are in no group."""


class Plugged(Hosted):
    """The devices of a deployment on the boards of a world."""

    def __init__(self, simulation: Simulation, environment: Mapping[str, str]) -> None:
        self._simulation = simulation
        super().__init__(
            environment,
            lambda: board_parts(simulation),
            simulation.turns,
            lambda spec, joints: _chain(simulation, spec, joints),
            lambda: simulation.in_step,
        )

    def stop(self, passes: Callable[[], object] | None = None) -> None:
        """Park and close all; a world whose clock is stopped meanwhile goes on for this."""
        super().stop(passes or (self._go_on if self._simulation.in_step else None))

    def _go_on(self) -> None:
        with self._simulation.turns:
            self._simulation.advance(_SLICE)


def board_parts(simulation: Simulation) -> dict[str, BoardPart]:
    """Groups of joints as they are served, by the names of their ports."""
    found = (one for one in simulation.devices.values() if isinstance(one, JointBoard))
    board = next(found, None)
    if board is None:
        return {}
    groups: dict[str, list[str]] = {}
    for joint, group in board.groups.items():
        groups.setdefault(group or WHOLE, []).append(joint)
    return {name: BoardPart(board.board, tuple(names)) for name, names in groups.items()}


def _chain(
    simulation: Simulation, spec: DeviceSpec, joints: tuple[str, ...]
) -> tuple[Chain, tuple[str, ...]]:
    """Of those of `joints` that move the parameter `tip`, told in the body `base`, if given."""
    tip, base = str(spec.parameters.get("tip", "")), str(spec.parameters.get("base", ""))
    if not tip:
        raise BadValue(f"device `{spec.name}`: set `tip`, the body or site that it moves")
    if unknown := [key for key in spec.parameters if key not in ("tip", "base")]:
        raise BadValue(f"device `{spec.name}`: there is no parameter `{unknown[0]}`")
    model = simulation.world.model
    tip, base = _known(model, tip), _known(model, base)
    moving = tuple(one for one in joints if _moves(model, one, tip))
    if not moving:
        raise SceneError(f"device `{spec.name}`: no joint of its board moves `{tip}`")
    return chain_of(model, moving, tip, base=base), moving


def _known(model: Any, name: str) -> str:
    """What MuJoCo calls a body or site: as the model file does, or after a frame of a scene."""
    called = body_name(name)
    body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, called) if name else -1
    return called if body >= 0 else name


def _moves(model: Any, joint: str, tip: str) -> bool:
    try:
        chain_of(model, (joint,), tip)
    except SceneError as error:
        if "does not move" in str(error):
            return False
        raise
    return True
