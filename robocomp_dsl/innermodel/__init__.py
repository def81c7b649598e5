"""`InnerModel`: the transform tree of a robot and its world, for the code of any component."""

from robocomp_dsl.innermodel.errors import InnerModelError
from robocomp_dsl.innermodel.innermodel import InnerModel
from robocomp_dsl.innermodel.joints import InnerModelJoint, InnerModelPrismaticJoint

__all__ = ["InnerModel", "InnerModelError", "InnerModelJoint", "InnerModelPrismaticJoint"]
