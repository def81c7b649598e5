"""RC970, RC980, RC99x: the findings of a configuration of yarp-bottle-generator.

An error: the original does something else than the file says, or cannot build its program. A
warning: the file is unusual, but has one meaning only.
"""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

INVALID_LINE = Code(
    "RC970",
    Severity.ERROR,
    "invalid line in a configuration of yarp-bottle-generator",
    """\
A line is `[section]`, `key = value`, a comment that starts with `;`, or empty. A section appears
once, and a key once in its section.

Wrong:

    [general]
    rate 20
    rate = 30
    rate = 40

Right:

    [general]
    rate = 20
""",
)

INVALID_VALUE = Code(
    "RC992",
    Severity.ERROR,
    "invalid value in a configuration of yarp-bottle-generator",
    """\
`to_ros`, `from_ros_topics` and `verbose` are true, false, 1 or 0; `num_mux`, `num_ports` and
`num_fields` are whole numbers from 1; `rate` is a number of Hz greater than 0; `function` is none,
none_double or deg_to_rad. The original runs without a conversion for an unknown function, waits
for ever with a rate of 0, and accepts a name without `/`, with blanks, or none.

Wrong:

    rate = 0
    function = degrees

Right:

    rate = 20
    function = deg_to_rad
""",
)

MISSING_KEY = Code(
    "RC993",
    Severity.ERROR,
    "a key or section is missing",
    """\
`[general]` needs output_name, num_mux, and ros_msg_name if to_ros is true; `[muxN]` needs
num_ports, ports and function; `[message]` and each nested section need num_fields, and `N_type`
for each N from 1 to num_fields.
""",
)

ASSUMED_KEY = Code(
    "RC994",
    Severity.WARNING,
    "a missing key has one possible value only",
    """\
Files for early versions of yarp-bottle-generator lack to_ros, from_ros_topics, rate or
ros_msg_name. The value is clear from the rest of the file; write it, so that a reader knows.
""",
)

COUNT_MISMATCH = Code(
    "RC995",
    Severity.ERROR,
    "a number does not match what the file lists",
    """\
num_ports is the number of names in `ports`, num_mux that of the sections `[mux1]`, `[mux2]`, …,
num_fields that of the fields of its section. The original takes `b,c` for one name if num_ports is
too small, opens ports without a name if it is too large, and ignores sections and fields behind
num_mux and num_fields.

Wrong:

    num_ports = 1
    ports = /left, /right

Right:

    num_ports = 2
    ports = /left, /right
""",
)

INVALID_FIELD = Code(
    "RC996",
    Severity.ERROR,
    "invalid field of a message",
    """\
The types of fields are single_value, list, timestamp, counter, mux and msg. `N_mux` names a
section `[muxN]`; `N_msg` names a nested section, which must not contain itself and must not be
called general, message or muxN. The original leaves out a field of another type, so that all later
fields move up, and recurses without end into a section that contains itself. It has no `mux` in a
nested section of a message for YARP, and one timestamp only in a message for ROS; a bridge in BDSL
has both.

Wrong:

    1_type = float64
    2_type = mux
    2_mux = arm

Right:

    1_type = mux
    1_mux = mux1
""",
)

INVALID_LITERAL = Code(
    "RC997",
    Severity.ERROR,
    "invalid constant",
    """\
A constant is a text in double quotes, a number, true or false; `list` takes several, separated by
commas. The original copies constants into C++ as they are, removes the blanks in texts of a list
and splits them at their commas.

Wrong:

    1_type = single_value
    1_msg = base_link
    2_type = list
    2_msg = "left", "right",

Right:

    1_msg = "base_link"
    2_msg = "left", "right"
""",
)

DIRECTION = Code(
    "RC998",
    Severity.ERROR,
    "inputs and output belong to the same middleware",
    """\
A configuration joins YARP ports to a ROS topic or ROS topics to a YARP port. With both from and to
ROS the original waits for a port that it never opened; with both from and to YARP nothing connects
its output. A bridge in BDSL joins any two middlewares:

    input left : double[] over yarp at "/left:o";
    output both over yarp at "/merged:i" { item left; };
""",
)

MESSAGE_TYPE = Code(
    "RC999",
    Severity.ERROR,
    "the fields do not fit the type of the ROS message",
    """\
The fields of `[message]` are those of `ros_msg_name`, in order and in number; a nested message is
a nested section, and a `mux` gives an array, or a message of numbers. The original never compares
them. The types of input topics are not in the file: they come from `--type TOPIC=PACKAGE/TYPE`, or
from a running ROS master that knows the topic.

Wrong:

    ros_msg_name = geometry_msgs/PointStamped
    [message]
    num_fields = 1

Right:

    num_fields = 2
""",
)

UNUSUAL = Code(
    "RC990",
    Severity.WARNING,
    "unusual configuration with one possible meaning",
    """\
A comma behind the last name of `ports`, and a `ros_msg_name` without its package, are accepted:
there is one name, and one such type. Correct them, because yarp-bottle-generator takes the comma as
a part of the name.
""",
)

FILE_EXISTS = Code(
    "RC980",
    Severity.ERROR,
    "the BDSL file exists",
    """\
`rcgen bridge X.ini` writes X.bdsl and generates the bridge from it. A file of this name that was
not generated from X.ini is kept. Once you edit the bridge itself, use

    rcgen migrate X.ini     # writes X-migrated/X.bdsl, which is yours
    rcgen bridge X.bdsl
""",
)
