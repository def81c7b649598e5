"""RC75x, RC76x: bridges: ports, hubs, outputs and services."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNKNOWN_BRIDGE_NAME = Code(
    "RC750",
    Severity.ERROR,
    "name that the bridge does not declare",
    """\
An expression uses inputs, hubs, functions, `now` and `counter`; that of a service uses `request`,
earlier calls and `now`. The order of declarations does not matter.

Wrong:

    output states : double[] over yarp at "/states" = weels;

Right:

    output states : double[] over yarp at "/states" = wheels;
""",
)

RESERVED_BRIDGE_NAME = Code(
    "RC751",
    Severity.ERROR,
    "reserved name",
    """\
`now`, `counter`, `request`, `result`, `number`, `text`, `length`, `stamp`, `true` and `false` have
a meaning in expressions, so nothing else can have these names.

Wrong:

    input counter : int over yarp at "/count:o";

Right:

    input count : int over yarp at "/count:o";
""",
)

UNUSED_IN_BRIDGE = Code(
    "RC752",
    Severity.WARNING,
    "input, hub or function that nothing uses",
    """\
An input that no hub, output or time stamp uses is received for nothing.

Wrong:

    input left : double[] over yarp at "/left:o";
    input right : double[] over yarp at "/right:o";
    output all : double[] over yarp at "/all:i" = left;

Right:

    hub both = left, right;
    output all : double[] over yarp at "/all:i" = both;
""",
)

HUB_CYCLE = Code(
    "RC753",
    Severity.ERROR,
    "hub that contains itself",
    """\
The values of a hub are those of inputs, possibly of other hubs, but not of itself.

Wrong:

    hub a = left, b;
    hub b = a, right;

Right:

    hub a = left, right;
    hub b = a;
""",
)

HUB_POLICY = Code(
    "RC754",
    Severity.ERROR,
    "settings of a hub that do not fit together",
    """\
`synchronised` compares the time stamps of at least two inputs, with a tolerance above zero. A hub
in another hub has the policy `latest`; the policy of the outer hub decides.

Wrong:

    hub pair = left { policy synchronised within 20 ms; };

Right:

    hub pair = left, right { policy synchronised within 20 ms; };
""",
)

BRIDGE_RATE = Code(
    "RC755",
    Severity.ERROR,
    "rate that is out of range",
    """\
A rate is above 0 and at most 10000 Hz. Without a rate an output is sent when what it reads has
arrived anew.

Wrong:

    rate 20000 Hz;

Right:

    rate 20 Hz;
""",
)

EMPTY_BRIDGE = Code(
    "RC756",
    Severity.ERROR,
    "bridge or output without content",
    """\
A bridge has at least one output or service. An output has a value, fields or items.

Wrong:

    output states : sensor_msgs::JointState over ros1 at "/states";

Right:

    output states : sensor_msgs::JointState over ros1 at "/states" { position = wheels; };
""",
)

BRIDGE_TRIGGER = Code(
    "RC757",
    Severity.ERROR,
    "output that is never sent",
    """\
An output without a rate is sent when an input arrives that it reads. If it reads none, it needs a
rate.

Wrong:

    output beat : int over yarp at "/beat:i" = counter;

Right:

    output beat : int over yarp at "/beat:i" = counter { rate 1 Hz; };
""",
)

BRIDGE_ADDRESS = Code(
    "RC758",
    Severity.ERROR,
    "address that the middleware does not allow",
    """\
`at` names the peer: a topic or service of ROS such as `/base/scan`, a port of YARP such as
`/robot/laser:o`, a proxy or endpoint of Ice such as `laser:tcp -h 10.0.0.2 -p 10001`. Over
middlewares that connect components only, it is the name of a component. What the bridge calls has
an address if the middleware cannot find it itself.

Wrong:

    input scan : sensor_msgs::LaserScan over ros2 at "/front scan";

Right:

    input scan : sensor_msgs::LaserScan over ros2 at "/front_scan";
""",
)

BRIDGE_LOOP = Code(
    "RC759",
    Severity.ERROR,
    "bridge that receives what it sends",
    """\
An input and an output with the same address over the same middleware form a loop: each message
causes the next one.

Wrong:

    input in : double[] over yarp at "/data";
    output out : double[] over yarp at "/data" = in;

Right:

    input in : double[] over yarp at "/data:o";
    output out : double[] over yarp at "/copy:i" = in;
""",
)

SHARED_ADDRESS = Code(
    "RC760",
    Severity.WARNING,
    "two outputs with one address",
    """\
Receivers cannot tell which of the two outputs sent a message. Two services with one address are
an error.

Wrong:

    output a : int over ros1 at "/a" = x;
    output b : int over ros1 at "/a" = y;

Right:

    output a : int over ros1 at "/a" = x;
    output b : int over ros1 at "/b" = y;
""",
)

BRIDGE_OPERATION = Code(
    "RC761",
    Severity.ERROR,
    "type that does not fit an input, output, service or call",
    """\
An input or output has a data type, a ROS message, or a one-way operation
`Module::Interface.operation`. A service or call has a ROS service or an operation that is no topic.

Wrong:

    input base : RoboCompLaser::Laser over zenoh;

Right:

    input scan : RoboCompLaserPub::LaserPub.pushLaserData over zenoh;
""",
)

OUTPUT_FORM = Code(
    "RC762",
    Severity.ERROR,
    "content of an output that does not fit its type",
    """\
A struct is built field by field, `= value` gives the whole message, and `item` builds a message
without a type. A message that is no struct has no fields.

Wrong:

    output states : sensor_msgs::JointState over ros1 at "/states" { item wheels; };

Right:

    output states : sensor_msgs::JointState over ros1 at "/states" { position = wheels; };
""",
)
