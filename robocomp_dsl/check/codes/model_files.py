"""Findings about models in URDF and MJCF, and about simulated worlds."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

MODEL_FILE = Code(
    "RC651",
    Severity.ERROR,
    "the file contains no model",
    """\
A model is InnerModel (`<innerModel>`), URDF (`<robot>`) or MJCF (`<mujoco>`). The links of a robot
form a tree: each has at most one parent joint, and there are no cycles. MuJoCo's errors about MJCF
are reported with their line. Expand a xacro file first:

    xacro robot.urdf.xacro > robot.urdf
""",
)

MODEL_SIMPLIFIED = Code(
    "RC652",
    Severity.WARNING,
    "the model was simplified",
    """\
The model is used with a simplification: a mesh that is missing or cannot be read becomes a small
marker that touches nothing, a mesh in `.dae` its bounding box, a missing texture is left out, a
moving body without mass gets one. Convert meshes to `.obj` or `.stl`.

`rcgen simulator` also reports a joint that is too light for the torque of its motor at the time
step of the file (it gets more `armature`, because no controller could hold it), a joint in the
tuples of two boards, and an invalid `speed_JOINT` or `coupling_BOARD`.

`package://NAME/…` is searched in the folders of `--packages`, in the folders of
ROBOCOMP_PACKAGE_PATH, ROS_PACKAGE_PATH, AMENT_PREFIX_PATH and GAZEBO_MODEL_PATH, and in the parent
folders of the file and their subfolders.
""",
)

MODEL_OVERLAP = Code(
    "RC653",
    Severity.WARNING,
    "bodies overlap at the start",
    """\
When the simulation starts, they push each other apart, often violently. Move them, change the
start positions of the joints, or exclude the pair from collisions (in InnerModel: `collide="0"`).
""",
)

MODEL_UNLIKELY = Code(
    "RC893",
    Severity.WARNING,
    "a value of the model is unlikely",
    """\
The model can be simulated, but a value is probably in another unit, or missing: ranges of joints
in degrees where radians are expected or the reverse, lengths in mm, masses in g, moments of
inertia that do not fit the mass, joints without a name, joints of a URDF without `effort` or
`velocity`, and key frames beyond the limits of joints.

Wrong, because MJCF reads angles in degrees:

    <mujoco>
      <worldbody><body name="arm"><joint name="elbow" range="-1.5 1.5"/> … </body></worldbody>
    </mujoco>

Right:

    <mujoco>
      <compiler angle="radian"/>
      <worldbody><body name="arm"><joint name="elbow" range="-1.5 1.5"/> … </body></worldbody>
    </mujoco>
""",
)
