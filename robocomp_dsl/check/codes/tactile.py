"""RC82x, RC89x: tactile descriptions: generic parts, their limbs and skin."""

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

TACTILE_FRAME = Code(
    "RC828",
    Severity.ERROR,
    "wrong frame of a limb",
    """\
The frame of a limb has its origin on the proximal joint. Its x runs along the limb to the distal
joint. Its +z, theta = 0, points away from the trunk when all generic angles are zero and the arm
hangs beside the body. `position` and `rpy` place it in the frame of `body`. With another frame the
fields are elsewhere on the limb, and the robot moves towards a touch.

Wrong, if x of the body l_forearm is not along the forearm:

    limbs:
      lower_arm: {body: l_forearm, cone: {x: [26 mm, 96 mm], r: [37 mm, 33 mm]}}

Right:

    limbs:
      lower_arm: {body: l_forearm, rpy: [90 deg, -90 deg, 0], cone: {x: [26 mm, 96 mm], r: [37 mm,
        33 mm]}}
""",
)

TACTILE_DIRECTION = Code(
    "RC829",
    Severity.ERROR,
    "a servo of an arm moves it in another direction",
    """\
The five generic angles mean the same on every robot. At zero the arm hangs straight beside the
body, and the flexed forearm points forward. Positive angles: 0 raises the arm forward, 1 moves it
away from the body, 2 turns the flexed forearm inward, 3 flexes the elbow, 4 turns the forearm about
itself, its upper side inward. gamma and sigma convert the angles of the joints to them; |gamma| is
1 rad per rad. The model tells where each joint moves the arm.

Wrong, for a joint that raises the arm backward with positive angles:

    servos:
      - {joint: LShoulderPitch, gamma: 1, sigma: 90 deg, limits: [-2.08, 2.08], speed: 8.2}

Right:

    servos:
      - {joint: LShoulderPitch, gamma: -1, sigma: 90 deg, limits: [-2.08, 2.08], speed: 8.2}
""",
)

TACTILE_CHAIN = Code(
    "RC890",
    Severity.ERROR,
    "the chain differs from the model",
    """\
The axes of the Denavit-Hartenberg rows lie within 2 mm and 1 degree of the joints of the model,
seen from one of the bodies that carry the arm. The finding names the first servo that differs: the
mistake is in its row, in a row between it and the previous servo, or, for the first servo, in
`base`. With `tip`, the name of a body or site of the model, the end of the chain is checked, too.

Wrong, if the elbow is 105 mm from the shoulder:

    chain:
      rows: [{servo: 0, alpha: 90 deg}, {servo: 1, a: 1.05}]

Right:

    chain:
      rows: [{servo: 0, alpha: 90 deg}, {servo: 1, a: 105 mm}]
""",
)

TACTILE_SURFACE = Code(
    "RC891",
    Severity.WARNING,
    "the skin is away from the surface of the model",
    """\
More than 5 % of the taxels of a limb (of a limb without skin: of the points of its cone) are more
than 15 mm from the shapes of its `body` and `covers` in the model. Meshes count as their convex
hulls. Contacts of the model then fall beside the skin.

Wrong, if the forearm of the model is 28 mm thick:

    limbs:
      lower_arm: {body: LForeArm, cone: {x: [20 mm, 100 mm], r: [56 mm, 56 mm]}}

Right:

    limbs:
      lower_arm: {body: LForeArm, cone: {x: [20 mm, 100 mm], r: [28 mm, 28 mm]}}
""",
)

TAXELS_UNANSWERED = Code(
    "RC892",
    Severity.WARNING,
    "taxels without a receptive field",
    """\
A touch moves the arm only if its place is in a receptive field of the limb. More than 10 % of the
taxels of this limb are in no field; the finding has the share. Parts without fields are not
reported.

Wrong, for skin all around the limb:

    fields:
      - {name: outer, limb: lower_arm, x: 60 mm, theta: 0, radius: 35 mm, motion: [0, -0.25]}

Right:

    fields:
      - {name: outer, limb: lower_arm, x: 60 mm, theta: 0, radius: 35 mm, motion: [0, -0.25]}
      - {name: inner, limb: lower_arm, x: 60 mm, theta: 180 deg, radius: 35 mm, motion: [0, 0.25]}
""",
)
