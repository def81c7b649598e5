"""The findings about descriptions of touch: generic parts, their limbs and skin."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

TACTILE_FORM = Code(
    "RC821",
    Severity.ERROR,
    "a description of generic parts cannot be understood",
    """\
It is YAML: `robot`, `parts`, and in each part `servos`, and where it has them `chain`, `limbs`,
`skin` and `fields`; `model` may name the file of the body (InnerModel, MJCF or URDF). Numbers are
rad and m unless `deg` or `mm` stands behind them. The XML form of `Generic_Robot_Part` is read too.

Wrong:

    servos:
      - {joint: LShoulderPitch, gama: -1, sigma: 90°, limits: [-2.08, 2.08], speed: 8.2}

Right:

    servos:
      - {joint: LShoulderPitch, gamma: -1, sigma: 90 deg, limits: [-2.08, 2.08], speed: 8.2}
""",
)

TACTILE_JOINT = Code(
    "RC822",
    Severity.ERROR,
    "a servo is mapped to a joint that the robot does not have",
    """\
`joint` is the name of a joint of `model`. A generic servo that the robot lacks has no `joint`: then
it always reads its `sigma`.

Wrong:

    servos:
      - {joint: LWristYawn, gamma: 1, sigma: 0, limits: [-1.8, 1.8], speed: 24}

Right:

    servos:
      - {joint: LWristYaw, gamma: 1, sigma: 0, limits: [-1.8, 1.8], speed: 24}
""",
)

TACTILE_LIMITS = Code(
    "RC823",
    Severity.ERROR,
    "limits, start or sigma of a servo do not fit each other or the robot",
    """\
A generic angle is gamma times the joint's angle plus sigma. Start pose and, where there is no
joint, sigma lie within the limits; the limits within those of the joint in `model`; and no generic
angle is beyond a full turn, which mostly means degrees where radians were meant.

Wrong:

    servos:
      - {joint: LElbowRoll, gamma: -1, sigma: 90, limits: [-1.54, -0.03], speed: 7, start: 0.5}

Right:

    servos:
      - {joint: LElbowRoll, gamma: -1, sigma: 90 deg, limits: [-1.54, -0.03], speed: 7, start: -0.5}
""",
)

TACTILE_BODY = Code(
    "RC824",
    Severity.ERROR,
    "a limb is on a body that the robot does not have",
    """\
`body` and `covers` of a limb are names of bodies of `model`.

Wrong:

    limbs:
      lower_arm: {body: LForearm, cone: {x: [0.02, 0.1], r: [0.032, 0.026]}}

Right:

    limbs:
      lower_arm: {body: LForeArm, cone: {x: [0.02, 0.1], r: [0.032, 0.026]}}
""",
)

TAXELS_OFF_BODY = Code(
    "RC825",
    Severity.ERROR,
    "taxels are not on their body",
    """\
A taxel lies within 15 mm of the cone of its limb or patch; further away it would feel nothing. So
it is with a receptive field that has no taxel of its limb in it.
Mostly millimetres stand where metres were meant, or the frame is that of another limb.

Wrong:

    limbs:
      lower_arm: {body: LForeArm, cone: {x: [20 mm, 100 mm], r: [32 mm, 26 mm]}}
    skin:
      - {patch: forearm, limb: lower_arm, rings: {x: [33, 60], count: 8}}

Right:

    limbs:
      lower_arm: {body: LForeArm, cone: {x: [20 mm, 100 mm], r: [32 mm, 26 mm]}}
    skin:
      - {patch: forearm, limb: lower_arm, rings: {x: [33 mm, 60 mm], count: 8}}
""",
)

TACTILE_TWICE = Code(
    "RC826",
    Severity.ERROR,
    "something of a kind is there twice",
    """\
Frames tell values by the id of a taxel, so that it is one of a kind on the whole robot, as the
name of a patch is; two generic servos cannot command one joint, two limbs cannot lie on one body,
and the fields of a part have names of their own.

Wrong:

    skin:
      - {patch: left, limb: lower_arm, first_id: 0, rings: {x: [0.03, 0.06], count: 8}}
      - {patch: right, limb: lower_arm, first_id: 100, rings: {x: [0.03, 0.06], count: 8}}

Right:

    skin:
      - {patch: left, limb: lower_arm, first_id: 0, rings: {x: [0.03, 0.06], count: 8}}
      - {patch: right, limb: lower_arm, first_id: 192, rings: {x: [0.03, 0.06], count: 8}}
""",
)

TACTILE_MODEL = Code(
    "RC827",
    Severity.ERROR,
    "the model of a description cannot be read",
    """\
`model` is the path of an InnerModel, MJCF or URDF file, relative to the description. Without it
joints and bodies are not compared.

Wrong:

    robot: nao
    model: nao.osg

Right:

    robot: nao
    model: nao.xml
""",
)
