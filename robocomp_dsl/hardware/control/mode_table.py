"""The modes of all joints of a board. Coupled joints change together or not at all."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from robocomp_dsl.hardware.control.errors import ModeRefused, NotEquipped
from robocomp_dsl.hardware.control.joints import BoardSpec, Bools, Ints
from robocomp_dsl.hardware.control.modes import Interaction, Mode, next_mode


class ModeTable:
    """Control mode, interaction mode and calibration of each joint."""

    def __init__(self, spec: BoardSpec) -> None:
        self._spec = spec
        self._sets = [spec.coupled(i) for i in range(len(spec.joints))]
        self.calibrated: Bools = np.array([joint.calibrated for joint in spec.joints])
        self.modes = [Mode.IDLE if done else Mode.NOT_CONFIGURED for done in self.calibrated]
        self._interactions = [Interaction.STIFF] * len(spec.joints)
        self.acting: dict[int, Mode] = {}
        self._yielding: set[int] = set()

    @property
    def interactions(self) -> tuple[Interaction, ...]:
        """Interaction modes; a joint with a fault reports stiff until the fault is cleared.

        A joint made compliant by `make_compliant` reports compliant.
        """
        if Mode.HW_FAULT not in self.modes and not self._yielding:
            return tuple(self._interactions)
        return tuple(map(self._interaction, range(len(self.modes))))

    def _interaction(self, joint: int) -> Interaction:
        if self.modes[joint] is Mode.HW_FAULT:
            return Interaction.STIFF
        return Interaction.COMPLIANT if joint in self._yielding else self._interactions[joint]

    @property
    def effective(self) -> list[Mode]:
        """The modes that drive the motors; during calibration they differ from `modes`."""
        return [self.acting.get(i, mode) for i, mode in enumerate(self.modes)]

    def coupled(self, joints: Ints) -> Ints:
        """`joints` and all joints coupled with them, ascending."""
        return np.unique(np.concatenate([self._sets[i] for i in joints.tolist()] or [joints]))

    def request(self, joints: Ints, requested: Sequence[Mode]) -> Ints:
        """Change control modes; returns the changed joints. `ModeRefused` changes none."""
        asked: dict[int, Mode] = {}
        for joint, mode in zip(joints.tolist(), requested, strict=True):
            for coupled in self._sets[joint].tolist():
                if asked.setdefault(coupled, mode) is not mode:
                    name = self._spec.names[coupled]
                    raise ModeRefused(f"`{name}` is coupled with a joint that gets another mode")
        names, done = self._spec.names, self.calibrated
        found = {
            joint: next_mode(names[joint], self.modes[joint], mode, calibrated=bool(done[joint]))
            for joint, mode in asked.items()
        }
        changed = [
            joint
            for joint, mode in found.items()
            if mode is not self.modes[joint] or joint in self._yielding
        ]
        for joint in changed:
            self.force(joint, found[joint])
        return np.array(sorted(changed), dtype=np.int64)

    def force(self, joint: int, mode: Mode, acting: Mode | None = None) -> None:
        """Force a joint into a mode; its motor is driven as in `acting`, if set."""
        self.modes[joint] = mode
        self._yielding.discard(joint)
        self.acting.pop(joint, None)
        if acting is not None:
            self.acting[joint] = acting

    def make_compliant(self, joint: int) -> None:
        """Let a joint hold its position, compliant if possible, until the next command."""
        self.force(joint, Mode.POSITION)
        if self._spec.joints[joint].torque_control:
            self._yielding.add(joint)

    def request_interaction(self, joints: Ints, requested: Sequence[Interaction]) -> None:
        """Change interaction modes; all or none. Raises `NotEquipped`, `ModeRefused`."""
        for joint, interaction in zip(joints.tolist(), requested, strict=True):
            spec = self._spec.joints[joint]
            if interaction is Interaction.COMPLIANT and not spec.torque_control:
                raise NotEquipped(f"`{spec.name}` has no torque control and cannot be compliant")
            if self.modes[joint] is Mode.HW_FAULT:
                raise ModeRefused(f"`{spec.name}` has a hardware fault; clear it first (`fidl`)")
        for joint, interaction in zip(joints.tolist(), requested, strict=True):
            self._interactions[joint] = interaction
            self._yielding.discard(joint)
