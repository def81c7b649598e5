"""The findings about models in URDF and MJCF, and about worlds that are looked at."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

MODEL_FILE = Code(
    "RC651",
    Severity.ERROR,
    "there is no model in the file",
    """\
A model is InnerModel (`<innerModel>`), URDF (`<robot>`) or MJCF (`<mujoco>`). The links of a robot
make one tree: each hangs on one joint at most, and never on itself by way of others. What MuJoCo
says about its own format is passed on with the line. A xacro file must be expanded first:

    xacro robot.urdf.xacro > robot.urdf
""",
)

MODEL_SIMPLIFIED = Code(
    "RC652",
    Severity.WARNING,
    "something is otherwise than described",
    """\
There is a model, with something simpler in place of what was described: a mesh that is missing or
in a format that is not read becomes a box (`.obj` and `.stl` are read; of `.dae`, `.osg` and
`.3ds` the size), a missing texture is left out, a body that moves and has no mass gets one.

`rcgen simulator` tells so, too, when a joint is too light for the torque of its motor at the step
of the file (it gets more `armature`: no regulator could hold it), when a joint is in the tuples of
two boards, and when a `speed_JOINT` or `coupling_BOARD` is none.

`package://NAME/…` is looked for in the folders given with `--packages`, in those that
ROBOCOMP_PACKAGE_PATH, ROS_PACKAGE_PATH, AMENT_PREFIX_PATH and GAZEBO_MODEL_PATH list, and in the
folders above the file and beside those.
""",
)

MODEL_OVERLAP = Code(
    "RC653",
    Severity.WARNING,
    "bodies are in each other at the start",
    """\
As soon as time runs, they push each other apart, often violently. Move them, give the joints
another start, or exclude the pair from collisions (in InnerModel: `collide="0"`).
""",
)
