"""RC527, RC55x: middlewares, quality of service, external programs, monitors and arbitration."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

NO_SHARED_MIDDLEWARE = Code(
    "RC550",
    Severity.ERROR,
    "two connected ports have no middleware in common",
    """\
The two ends of a connection use the same middleware. The nearest word decides: `over` of the
connection, `port` and `middleware` of the component in the deployment, the mark of the port in the
CDSL file, `middleware` of the CDSL file, `middleware` of the deployment. A port of which nothing is
said follows the other end.

Wrong, where `body` implements `Skin(local)` and `reflex` requires `Skin(zenoh)`:

    connect reflex.Skin -> body.Skin;

Right:

    connect reflex.Skin -> body.Skin over zenoh;
""",
)

UNSUITABLE_MIDDLEWARE = Code(
    "RC551",
    Severity.ERROR,
    "a middleware cannot carry a connection",
    """\
A middleware connects the components of one process, of one machine or of several machines; some
have only services or only topics, and some restrict the names of components and ports.

Wrong: each component is a process, except in a group with `inprocess`.

    connect reflex.Skin -> body.Skin over inproc;

Right:

    connect reflex.Skin -> body.Skin over zenoh;
""",
)

UNSUPPORTED_QOS = Code(
    "RC552",
    Severity.ERROR,
    "quality of service that the connection cannot have",
    """\
A middleware that does not honour an item of the quality of service cannot carry a connection that
asks for it. `keep all` excludes `best_effort`; `keep all`, `latched`, `deadline` and `liveliness`
are for topics.

Wrong, where `Skin` is a service:

    connect reflex.Skin -> body.Skin { latched; };

Right:

    connect reflex.Skin -> body.Skin { priority high; };
""",
)

ADDRESS = Code(
    "RC553",
    Severity.ERROR,
    "invalid address",
    """\
The address of an external program, or of a port that external programs call, is what its middleware
understands. A server, a publisher and a subscriber outside of the deployment have an address; a
client has none.

Wrong:

    extern laser over ice at "" implements Laser;

Right:

    extern laser over ice at "laser:tcp -h 10.0.0.2 -p 10001" implements Laser;
""",
)

SHARED_ADDRESS = Code(
    "RC554",
    Severity.ERROR,
    "two ports use the same address",
    """\
Only one port can be reached at an address of a middleware.

Wrong:

    component left : skin { port Skin over ice at "tcp -p 10001"; };
    component right : skin { port Skin over ice at "tcp -p 10001"; };

Right:

    component left : skin { port Skin over ice at "tcp -p 10001"; };
    component right : skin { port Skin over ice at "tcp -p 10002"; };
""",
)

EXTERNAL_INTERFACE = Code(
    "RC555",
    Severity.ERROR,
    "unknown interface of an external program",
    """\
An external program has an interface that a component of the deployment uses.

Wrong, where no imported component uses `Lasr`:

    extern laser over ice at "laser:tcp -h 10.0.0.2 -p 10001" implements Lasr;

Right:

    extern laser over ice at "laser:tcp -h 10.0.0.2 -p 10001" implements Laser;
""",
)

UNUSED_EXTERNAL = Code(
    "RC556",
    Severity.WARNING,
    "an external program without a connection",
    """\
A component uses an external program only through a `connect`.

Without effect:

    extern laser over ice at "laser:tcp -h 10.0.0.2 -p 10001" implements Laser;

Better:

    extern laser over ice at "laser:tcp -h 10.0.0.2 -p 10001" implements Laser;
    connect wander.Laser -> laser.Laser;
""",
)

MONITOR = Code(
    "RC557",
    Severity.ERROR,
    "invalid monitor",
    """\
A monitor is a class in a Python file; the path is relative to the DDSL file. Its methods fit the
operations of the interface, and its constructor takes the arguments in braces.

Wrong, where the class is called `Limit`:

    connect joystick.Speed -> base.Speed { monitor "limits.py" Limits { max = 3; }; };

Right:

    connect joystick.Speed -> base.Speed { monitor "limits.py" Limit { max = 3; }; };
""",
)

EXTERNAL_CONNECTION = Code(
    "RC559",
    Severity.ERROR,
    "invalid connection between external programs",
    """\
`connect` with a middleware connects ports of two programs, neither of which is a component. The
names of the ports are in quotes, as the middleware knows them; each connection is written once.

Wrong: a port of YARP starts with `/`.

    connect yarp "camera:o" -> "/view:i";

Right:

    connect yarp "/camera:o" -> "/view:i" carrier fast_tcp;
""",
)

ARBITRATION = Code(
    "RC558",
    Severity.ERROR,
    "invalid arbitration",
    """\
An arbitration names every connection into a port, with the events under which it
delivers. The monitors of the connections set the events. At most one condition holds at a time.

Wrong: both conditions hold if `seen` is set.

    arbitrate gaze.Target { from face.Target when seen; from scan.Target when seen || !stop; };

Right:

    arbitrate gaze.Target { from face.Target when seen; from scan.Target when !seen; };
""",
)

INTERFACE_VERSIONS = Code(
    "RC527",
    Severity.ERROR,
    "two versions of an interface in a connection",
    """\
The two components import different files, in which an operation that the first one uses differs:
in a parameter, a field, a type, a unit, its pattern, or it is missing. A call would raise
`InterfaceMismatch`, and messages of a topic would not arrive. Operations that only the second
component has do no harm.

Wrong, where `arm/Gripper.idsl` has another `close` than `hand/Gripper.idsl`:

    connect arm.Gripper -> hand.Gripper;

Right: both components import one `Gripper.idsl`, and are generated again.
""",
)
