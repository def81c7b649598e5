"""RC80x, RC784 and RC785: the tags, attributes and values of InnerModel files."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

INNERMODEL_TAG = Code(
    "RC801",
    Severity.ERROR,
    "unknown or misplaced tag",
    """\
The tags are `transform`, `translation`, `rotation`, `joint`, `prismaticjoint`, `motor`, `plane`,
`mesh`, `differentialrobot`, `omnirobot`, `laser`, `rgbd`, `camera`, `imu`, `gps`, `ultrasound`,
`battery`, `touchsensor`, `pointcloud`, `display`, `axes`, `skin` with `patch` and `taxel`, and
`include`, in any case, inside one root element `innerModel`.

Wrong:

    <innerModel> <trasform id="base"/> </innerModel>

Right:

    <innerModel> <transform id="base"/> </innerModel>
""",
)

INNERMODEL_ATTRIBUTE = Code(
    "RC802",
    Severity.ERROR,
    "unknown attribute",
    """\
Attributes are case-sensitive, and each tag has its own. RoboComp rejects unknown attributes. A
simulation uses the attribute that is obviously intended: `tx` for `x` of a `translation` or for
`TX`.

Wrong:

    <translation id="arm" x="100"/>

Right:

    <translation id="arm" tx="100"/>
""",
)

INNERMODEL_VALUE = Code(
    "RC803",
    Severity.ERROR,
    "invalid value of an attribute",
    """\
Numbers have a decimal point. Lengths are mm, angles rad and masses kg, unless a unit follows the
number (`mm`, `cm`, `m`; `rad`, `deg`; `kg`, `g`), which RoboComp itself does not support. Ports,
image sizes and numbers of measures are integers; `collide` is 0 or 1; sizes and scales are one to
three numbers separated by commas. RoboComp uses 0 for an invalid number; this tool uses the
default.

Wrong:

    <transform id="arm" tx="0,5" rz="pi"/>

Right:

    <transform id="arm" tx="0.5" rz="3.14159265"/>
""",
)

INNERMODEL_DUPLICATE_ID = Code(
    "RC804",
    Severity.ERROR,
    "two nodes have the same id",
    """\
Nodes are identified by their ids; ids are unique across included files.

Wrong:

    <plane id="wall"/> <plane id="wall"/>

Right:

    <plane id="wall1"/> <plane id="wall2"/>
""",
)

INNERMODEL_MISSING_ID = Code(
    "RC805",
    Severity.WARNING,
    "a node has no id",
    """\
Nothing can refer to a node without an id; it gets an id that is generated from its tag.

Right:

    <transform id="base" tx="100"/>
""",
)

INNERMODEL_INCLUDE = Code(
    "RC806",
    Severity.ERROR,
    "a file cannot be included",
    """\
`path` is relative to the including file. If there is no such file, its last part is searched in the
same folder, because files often contain paths of other machines. A file must not include itself.

Right:

    <include path="robot.xml"/>
""",
)

INNERMODEL_NESTING = Code(
    "RC807",
    Severity.ERROR,
    "an element is not allowed here",
    """\
Only frames contain other nodes: transforms, joints, bases and touch sensors. A `skin` contains
patches, a `patch` contains taxels. Elements nest at most 200 deep.

Wrong:

    <plane id="table"> <mesh id="cup" file="cup.obj"/> </plane>

Right:

    <plane id="table"/>
    <mesh id="cup" file="cup.obj"/>
""",
)

INNERMODEL_RULE = Code(
    "RC808",
    Severity.ERROR,
    "the attributes of a node are inconsistent",
    """\
`min` is at most `max`, no scale is 0, a motor is a child of the joint that it drives, and a mesh
has a file. A negative size or scale is allowed; it mirrors. The taxels of a skin patch are given by
`rings` around its cone, by a `file` of positions, or by `taxel` elements, each with `x` and `theta`
on the cone, or with a point and a normal.

Wrong:

    <joint id="elbow" min="1.5" max="-1.5"/>

Right:

    <joint id="elbow" min="-1.5" max="1.5"/>
""",
)

MISSING_WORLD_FILE = Code(
    "RC788",
    Severity.WARNING,
    "meshes or pictures of the world are not found",
    """\
Worlds name their meshes and pictures by paths of the computer on which they were written. A file
is searched by the end of its path: in the folders of `--files` and of ROBOCOMP_FILES, beside the
world, and in the folders above it; at last, in the first two, without regard to upper and lower
case. For `/home/robocomp/robocomp/files/osgModels/table.osg`, any of these finds it:

    rcgen view room.xml --files ~/robocomp/files
    export ROBOCOMP_FILES=~/robocomp/files:~/my_meshes

A missing mesh is a marker of 2 cm, which touches nothing, is not seen by sensors, and does not
count for what the view shows; a missing picture is grey. `rcgen check` reports missing files only
with `--files` or ROBOCOMP_FILES.
""",
)

INNERMODEL_TOO_LARGE = Code(
    "RC809",
    Severity.ERROR,
    "too many nodes",
    """\
Files that include others many times can exceed the available memory. Reading stops at 100 000
nodes.
""",
)

INNERMODEL_TOUCH = Code(
    "RC784",
    Severity.ERROR,
    "a touch sensor contains no shape that collides",
    """\
A `touchsensor` feels the contacts of the shapes in it: planes and meshes with `collide="1"`, in the
sensor or in frames in it. Without one it could never be touched and would always read 0. A
simulation leaves such a sensor out. A shape of the robot outside the sensor is not part of it.

Wrong:

    <touchsensor id="bump" type="bumper"/>

Right:

    <touchsensor id="bump" type="bumper">
        <plane id="bump_plate" pz="200" size="400,100,20" collide="1"/>
    </touchsensor>
""",
)

INNERMODEL_HOME = Code(
    "RC785",
    Severity.WARNING,
    "`home` is outside the limits of the joint",
    """\
A joint starts at its `home`, which is also where the command to go to zero sends it. A simulation
uses the nearest position between `min` and `max`, as RoboComp does.

Wrong:

    <joint id="elbow" min="-1" max="1" home="1.5"/>

Right:

    <joint id="elbow" min="-1" max="1" home="1"/>
""",
)
