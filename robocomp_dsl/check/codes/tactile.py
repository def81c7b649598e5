"""RC82x: tactile descriptions: generic parts, their limbs and skin."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

TACTILE_SYNTAX = Code(
    "RC821",
    Severity.ERROR,
    "invalid tactile description",
    """\
A tactile description is a YAML file with `robot` and `parts`. Each part has `servos` and optionally
`chain`, `limbs`, `skin` and `fields`; `model` optionally names the robot model (InnerModel, MJCF or
URDF). Numbers are in rad and m unless `deg` or `mm` follows. The XML format of `Generic_Robot_Part`
is supported as well.

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
    "unknown joint of a servo",
    """\
`joint` is the name of a joint of `model`. For a generic servo that the robot does not have, omit
`joint`: its position is then always `sigma`.

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
    "inconsistent limits, start or sigma of a servo",
    """\
A generic angle is gamma times the joint angle plus sigma. The start pose, and sigma of a servo
without a joint, lie within the limits; the limits lie within the joint limits of `model`; generic
angles are at most a full turn (a larger one is usually in degrees instead of radians).

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
    "unknown body of a limb",
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

TAXELS_OFF_SURFACE = Code(
    "RC825",
    Severity.ERROR,
    "taxels are off the surface of their body",
    """\
A taxel lies within 15 mm of the cone of its limb or patch; further away it would sense nothing. A
receptive field contains at least one taxel of its limb. Usually the cause is millimetres instead of
metres, or the frame of another limb.

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

TACTILE_DUPLICATE = Code(
    "RC826",
    Severity.ERROR,
    "duplicate in a tactile description",
    """\
Skin frames identify values by taxel id, so taxel ids are unique on the robot, and so are the names
of patches. Two generic servos cannot command the same joint, two limbs cannot cover the same body,
and the fields of a part have different names.

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
    "the model of a tactile description cannot be read",
    """\
`model` is the path of an InnerModel, MJCF or URDF file, relative to the description. Without
`model`, joints and bodies are not checked.

Wrong:

    robot: nao
    model: nao.osg

Right:

    robot: nao
    model: nao.xml
""",
)
