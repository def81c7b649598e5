"""The body of the robot: laws of withdrawal and contacts of the robot with itself.

In: the tactile description and its model. Out: a `WithdrawalLaw`, and `SelfContacts` or None. The
model is loaded by MuJoCo, only if the description names one.
"""

from __future__ import annotations

from robocomp_dsl.finding import Finding
from robocomp_dsl.regular_file import read_bytes
from robocomp_dsl.runtime.parameters import ConfigError
from robocomp_dsl.tactile.arm.limb_kinematics import LimbKinematics
from robocomp_dsl.tactile.description.model import RobotDescription
from robocomp_dsl.tactile.reflex.pose_directions import PoseDirections
from robocomp_dsl.tactile.reflex.self_contact import SelfContacts
from robocomp_dsl.tactile.reflex.withdrawal_laws import FixedLaw, PoseLaw, WithdrawalLaw


def load_kinematics(robot: RobotDescription, part: str) -> LimbKinematics | None:
    """The model of the description; None if it names no MJCF or URDF file. Raises `ConfigError`."""
    if robot.model_file is None:
        return None
    from robocomp_dsl.hardware.description.findings import ModelFileError  # noqa: PLC0415
    from robocomp_dsl.hardware.description.model_kind import root_tag  # noqa: PLC0415
    from robocomp_dsl.simulation.models.body_model import BodyModel  # noqa: PLC0415 - slow

    try:
        if root_tag(read_bytes(robot.model_file)) == "innermodel":
            return None
        return BodyModel.load(robot, part)
    except (ModelFileError, OSError, KeyError) as error:
        why = getattr(error, "strerror", None) or str(error)
        message = f"the model `{robot.model}` cannot be used: {why}"
        remedy = f"correct it (`rcgen check {robot.file.name}`), or remove `model`"
        raise ConfigError([Finding(robot.model_place, message, help=remedy)]) from None


class RobotBody:
    """What the reflex knows about the body of its robot."""

    def __init__(self, kinematics: LimbKinematics | None, law: str, clearance: float) -> None:
        self.kinematics = kinematics
        self.self_contacts = SelfContacts(kinematics) if kinematics else None
        self.law: WithdrawalLaw
        self.use_law(law, clearance)

    def use_law(self, law: str, clearance: float) -> None:
        """Use the law `pose` or `fixed`. Without a model, `pose` is replaced by `fixed`."""
        self.directions = PoseDirections(self.kinematics, clearance) if self.kinematics else None
        if self.directions is None or law == "fixed":
            self.law = FixedLaw(self.directions)
        else:
            self.law = PoseLaw(self.directions)
