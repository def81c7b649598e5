"""The findings about the meaning of InnerModel files."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

BODY_TAG = Code(
    "RC801",
    Severity.ERROR,
    "this tag does not exist, or not here",
    """\
Tags are `transform`, `translation`, `rotation`, `joint`, `prismaticjoint`, `motor`, `plane`,
`mesh`, `differentialrobot`, `omnirobot`, `laser`, `rgbd`, `camera`, `imu`, `gps`, `ultrasound`,
`battery`, `touchsensor`, `pointcloud`, `display`, `axes`, `skin` with `patch` and `taxel`, and
`include`, in any case, inside one outermost `innerModel`.

Wrong:

    <innerModel> <trasform id="base"/> </innerModel>

Right:

    <innerModel> <transform id="base"/> </innerModel>
""",
)

BODY_ATTRIBUTE = Code(
    "RC802",
    Severity.ERROR,
    "the tag has no such attribute",
    """\
Attributes are case-sensitive, and each tag has its own. RoboComp stops at an unknown one. In a
simulation it is taken as the one that must be meant: `x` of a `translation` as `tx`, `TX` as `tx`.

Wrong:

    <translation id="arm" x="100"/>

Right:

    <translation id="arm" tx="100"/>
""",
)

BODY_VALUE = Code(
    "RC803",
    Severity.ERROR,
    "a value is not of the kind that its attribute takes",
    """\
Numbers have a decimal point; lengths are mm, angles rad, masses kg, unless a unit stands behind the
number (`mm`, `cm`, `m`; `rad`, `deg`; `kg`, `g`), which RoboComp itself does not read; ports, image
sizes and numbers of measures are whole; `collide` is 0 or 1; sizes and scales are one to three
numbers with commas between them. RoboComp reads 0 where it cannot read a number; here the default
is used.

Wrong:

    <transform id="arm" tx="0,5" rz="pi"/>

Right:

    <transform id="arm" tx="0.5" rz="3.14159265"/>
""",
)

BODY_DUPLICATE = Code(
    "RC804",
    Severity.ERROR,
    "two nodes have the same id",
    """\
Nodes are found by their ids, also those of included files.

Wrong:

    <plane id="wall"/> <plane id="wall"/>

Right:

    <plane id="wall1"/> <plane id="wall2"/>
""",
)

BODY_ID_MISSING = Code(
    "RC805",
    Severity.WARNING,
    "a node has no id",
    """\
Without an id nothing can refer to the node; it gets one that is made from its tag.

Right:

    <transform id="base" tx="100"/>
""",
)

BODY_INCLUDE = Code(
    "RC806",
    Severity.ERROR,
    "a file cannot be included",
    """\
`path` is looked for as written, then beside the file that includes it, then there by its last
part alone, because paths of other machines are common. A file must not include itself.

Right:

    <include path="robot.xml"/>
""",
)

BODY_NESTING = Code(
    "RC807",
    Severity.ERROR,
    "an element stands where none can be",
    """\
Only frames hold other nodes: transforms, joints, bases and touch sensors; and a `skin` holds
patches, a `patch` taxels. Elements nest at most 200 deep.

Wrong:

    <plane id="table"> <mesh id="cup" file="cup.obj"/> </plane>

Right:

    <plane id="table"/>
    <mesh id="cup" file="cup.obj"/>
""",
)

BODY_RULE = Code(
    "RC808",
    Severity.ERROR,
    "the attributes of a node do not fit together",
    """\
Limits have their smaller number first, no scale is 0, a motor stands in the joint that it drives,
a mesh has a file. A negative size or scale is allowed; it mirrors. A patch of skin is laid out by
`rings` round its cone, by a `file` of positions, or by its taxels: each has `x` and `theta` on the
cone, or a point and a normal.

Wrong:

    <joint id="elbow" min="1.5" max="-1.5"/>

Right:

    <joint id="elbow" min="-1.5" max="1.5"/>
""",
)

BODY_TOO_LARGE = Code(
    "RC809",
    Severity.ERROR,
    "the body has too many nodes",
    """\
A file that includes others many times over can describe more than any memory holds. Reading stops
at 100 000 nodes.
""",
)
