"""RC5xx: deployments."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNKNOWN_COMPONENT = Code(
    "RC501",
    Severity.ERROR,
    "unknown component",
    """\
After the colon (or alone) write the component's name as declared in its CDSL file.

Wrong:

    import "../components/mujoco_robot/mujoco_robot.cdsl";
    Deployment demo { component body : robot; };

Right:

    Deployment demo { component body : mujoco_robot; };
""",
)

UNKNOWN_INSTANCE = Code(
    "RC502",
    Severity.ERROR,
    "unknown component instance",
    """\
`connect` and `after` refer to the components of this deployment by the name before the colon.

Wrong:

    component body : mujoco_robot;
    component reflex { after mujoco_robot; };

Right:

    component reflex { after body; };
""",
)

UNKNOWN_PORT = Code(
    "RC503",
    Severity.ERROR,
    "unknown port",
    """\
A port has the name of its interface, or the name after `as`. Before the arrow write a port that the
component requires or publishes; after the arrow, a port that the other component implements or
subscribes to.

Wrong:

    connect reflex.Skn -> body.Skin;

Right:

    connect reflex.Skin -> body.Skin;
""",
)

PORT_ROLE = Code(
    "RC504",
    Severity.ERROR,
    "the roles of two connected ports do not match",
    """\
A connection runs from the client (`requires`) to the server (`implements`), or from the publisher
to the subscriber.

Wrong, where `reflex` requires `Skin` and `body` implements it:

    connect body.Skin -> reflex.Skin;

Right:

    connect reflex.Skin -> body.Skin;
""",
)

INTERFACE_MISMATCH = Code(
    "RC505",
    Severity.ERROR,
    "two connected ports have different interfaces",
    """\
Both ends of a connection use the same interface; the names of the ports may differ.

Wrong:

    connect reflex.Skin -> body.Laser;

Right:

    connect reflex.Skin -> body.Skin;
""",
)

CONNECTED_TWICE = Code(
    "RC506",
    Severity.ERROR,
    "a port is connected twice",
    """\
A required port connects to exactly one server; a published port may connect to each subscriber
once.

Wrong:

    connect reflex.Skin -> left.Skin;
    connect reflex.Skin -> right.Skin;

Right: to use two servers, require the interface twice.

    requires Skin as left, Skin as right;             // in reflex.cdsl

    connect reflex.left -> left.Skin;
    connect reflex.right -> right.Skin;
""",
)

UNSATISFIED_REQUIREMENT = Code(
    "RC507",
    Severity.ERROR,
    "no server for a required interface",
    """\
Every required interface needs a component of the same deployment that implements it. If there is
exactly one, the two are connected automatically.

Wrong, where `wander` requires `Laser`:

    Deployment demo { component wander; };

Right:

    Deployment demo { component wander; component mobile_base; };
""",
)

AMBIGUOUS_REQUIREMENT = Code(
    "RC508",
    Severity.ERROR,
    "several servers for a required interface",
    """\
If several components implement a required interface, connect the port to one of them.

Wrong:

    component left : skin; component right : skin; component reflex;

Right:

    component left : skin; component right : skin; component reflex;
    connect reflex.Skin -> left.Skin;
""",
)

NO_PUBLISHER = Code(
    "RC509",
    Severity.WARNING,
    "no publisher for a subscription",
    """\
A subscriber receives from all publishers of the topic in the deployment, unless connections select
some of them. Here there is none, so the methods of the subscription are never called.

Without a publisher, where `logger` subscribes to `LaserPub`:

    Deployment demo { component logger; };

Better:

    Deployment demo { component logger; component mobile_base; };
""",
)

AFTER_CYCLE = Code(
    "RC510",
    Severity.ERROR,
    "cycle of `after`",
    """\
A component with `after` starts when the components that it names are ready. In a cycle none can
start. Components that call each other need no `after`: a call waits for its server.

Wrong:

    component arm { after hand; };
    component hand { after arm; };

Right:

    component arm { after hand; };
    component hand;
""",
)

UNKNOWN_SETTING = Code(
    "RC511",
    Severity.ERROR,
    "unknown parameter",
    """\
`set` names a parameter of the component's PDSL file. Write a dot before a parameter in a group and
an index, from 0, after the name of a group list.

Wrong:

    set rte = 100;
    set motors.min = -1;

Right:

    set rate = 100;
    set motors[0].min = -1;
""",
)

SETTING_TYPE = Code(
    "RC512",
    Severity.ERROR,
    "a parameter is set to a value of the wrong type",
    """\
The value must have the type that the PDSL file declares.

Wrong, where the file says `rate float 50 [Hz] 1:1000;`:

    set rate = "fast";

Right:

    set rate = 100;
""",
)

SETTING_RANGE = Code(
    "RC513",
    Severity.ERROR,
    "a parameter is set to a value out of range",
    """\
The value must be within the range, or one of the choices, that the PDSL file declares.

Wrong, where the file says `rate float 50 [Hz] 1:1000;`:

    set rate = 5000;

Right:

    set rate = 500;
""",
)

PORT_NUMBER = Code(
    "RC514",
    Severity.ERROR,
    "a port number is out of range",
    """\
`port` makes a component listen on a fixed TCP port, from 1 to 65535. It is seldom needed: without
it a free port is used, and components discover each other.

Wrong:

    port 70000;

Right:

    port 7451;
""",
)

SHARED_PORT = Code(
    "RC515",
    Severity.ERROR,
    "two components use the same TCP port",
    """\
Only one process per machine can listen on a port.

Wrong:

    component left : skin { port 7451; };
    component right : skin { port 7451; };

Right:

    component left : skin { port 7451; };
    component right : skin { port 7452; };
""",
)

COMMAND_LINE = Code(
    "RC516",
    Severity.ERROR,
    "invalid command line",
    """\
`executable` is a program with its arguments; quote arguments that contain spaces. It is run without
a shell.

Wrong:

    executable "python3 'my main.py";

Right:

    executable "python3 'my main.py'";
""",
)

UNKNOWN_PRIORITY = Code(
    "RC517",
    Severity.ERROR,
    "unknown priority",
    """\
The priority of a connection is `background`, `low`, `normal`, `high` or `realtime`.

Wrong:

    connect reflex.Skin -> body.Skin { priority urgent; };

Right:

    connect reflex.Skin -> body.Skin { priority high; };
""",
)

DEPLOYMENT_NUMBER = Code(
    "RC518",
    Severity.ERROR,
    "a number or duration of a deployment is out of range",
    """\
`max` and `depth` are whole numbers from 1. Durations are above 0 and up to a day, and have a unit:
`ms`, `s` or `min`. `memory` is at least 1 MB; `cpu` is a share of one core above 0 %. `cores` are
counted from 0; `realtime priority` is from 1 to 99.

Wrong:

    restart on-failure max 0 in 60 s;
    ready within 0 s;

Right:

    restart never;
    ready within 10 s;
""",
)

UNKNOWN_HOST = Code(
    "RC519",
    Severity.ERROR,
    "unknown host",
    """\
`on` assigns a component to a host that the deployment declares; without it the component runs on
this machine.

Wrong:

    component reflex on robot;

Right:

    host robot { address "127.0.0.1"; };
    component reflex on robot;
""",
)

CONFLICTING_HOSTS = Code(
    "RC520",
    Severity.ERROR,
    "a component is assigned to two hosts",
    """\
The host of a group applies to all its components. A component or nested group names the same host
or none.

Wrong:

    group arm on robot { component motor on desk; };

Right:

    group arm on robot { component motor; };
""",
)

HOST_ADDRESS = Code(
    "RC521",
    Severity.ERROR,
    "invalid or missing host address",
    """\
The address of a host is a host name, an alias in ~/.ssh/config or an IP address, also with the port
of its ssh server: `10.0.0.2:2222`, `[fe80::1]:2222`. `localhost` is this machine and needs no
declaration.

Wrong:

    host robot { user nao; };

Right:

    host robot { address "10.0.0.2"; user nao; };
""",
)

EMPTY_DEPLOYMENT = Code(
    "RC522",
    Severity.WARNING,
    "a deployment or a group has no components",
    """\
A deployment or group without components starts nothing.

Empty:

    Deployment demo { };

Better:

    Deployment demo { component mobile_base; };
""",
)

CONFIG_SEARCH = Code(
    "RC523",
    Severity.ERROR,
    "invalid configuration search",
    """\
With `context` and `from` a component searches for its configuration when it starts: in its working
folder, in the folders of the user and in installed ones. The names must not leave these folders.
`config` names the file itself, so it cannot be combined with a search.

Wrong:

    component arm { config "arm.yaml"; context "../lab"; };

Right:

    component arm { context "lab"; };
""",
)

INVALID_PREFIX = Code(
    "RC524",
    Severity.ERROR,
    "invalid prefix",
    """\
A prefix is a namespace for an instance with all its topics and interfaces: `left/arm`. It is one
name, or several names separated by `/`.

Wrong:

    component arm { prefix "left hand"; };

Right:

    component arm { prefix "left/hand"; };
""",
)

READY_PATTERN = Code(
    "RC525",
    Severity.ERROR,
    "invalid regular expression",
    """\
`ready when log matches` takes a regular expression of Python. The program is ready when a line of
its output contains a match.

Wrong:

    ready when log matches "(listening";

Right:

    ready when log matches "listening on port [0-9]+";
""",
)

PROGRAM = Code(
    "RC526",
    Severity.ERROR,
    "invalid setting of a program",
    """\
A `program` is a process that knows nothing of components. It has a command line, and no ports,
parameters, devices, configuration or prefix. It gets no other arguments than those written.

Wrong:

    program camera { set rate = 20; };

Right:

    program camera { executable "camera_server --rate 20"; ready when port 8080 answers; };
""",
)
