"""RC5xx: deployments."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNKNOWN_COMPONENT = Code(
    "RC501",
    Severity.ERROR,
    "a deployment uses a component that it does not import",
    """\
Behind the colon, or alone, stands the name of a component as its CDSL file declares it.

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
    "a name is not that of a component of the deployment",
    """\
`connect` and `after` speak of the components of this deployment by the name in front of the colon.

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
    "a component has no such port",
    """\
A port is called as the interface that the component uses, or by the name behind `as`. In front of
the arrow stands one that the component requires or publishes, behind it one that the other one
implements or subscribes to.

Wrong:

    connect reflex.Skn -> body.Skin;

Right:

    connect reflex.Skin -> body.Skin;
""",
)

PORT_ROLE = Code(
    "RC504",
    Severity.ERROR,
    "two ports have roles that do not fit",
    """\
A connection leads from who requires an interface to who implements it, or from who publishes a
topic to who subscribes to it.

Wrong, where `reflex` requires `Skin` and `body` implements it:

    connect body.Skin -> reflex.Skin;

Right:

    connect reflex.Skin -> body.Skin;
""",
)

INTERFACES_DIFFER = Code(
    "RC505",
    Severity.ERROR,
    "two ports speak of different interfaces",
    """\
Both ends of a connection use the same interface, whatever the ports are called.

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
A requirement has one server. A topic may be connected to several subscribers, to each of them once.

Wrong:

    connect reflex.Skin -> left.Skin;
    connect reflex.Skin -> right.Skin;

Right: a component that uses two servers requires the interface twice.

    requires Skin as left, Skin as right;             // in reflex.cdsl

    connect reflex.left -> left.Skin;
    connect reflex.right -> right.Skin;
""",
)

UNSERVED_REQUIREMENT = Code(
    "RC507",
    Severity.ERROR,
    "no component implements what another one requires",
    """\
Every requirement of a deployed component needs a component of the same deployment that implements
it. With exactly one they are connected without being told.

Wrong, where `wander` requires `Laser`:

    Deployment demo { component wander; };

Right:

    Deployment demo { component wander; component mobile_base; };
""",
)

AMBIGUOUS_REQUIREMENT = Code(
    "RC508",
    Severity.ERROR,
    "several components implement what another one requires",
    """\
Where more than one component could serve a requirement, the deployment says which one does.

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
    "nobody publishes what a component subscribes to",
    """\
A subscription hears all components of the deployment that publish the topic, unless connections
name some of them. Here there is none, so its methods are never called.

Silent, where `logger` subscribes to `LaserPub`:

    Deployment demo { component logger; };

Better:

    Deployment demo { component logger; component mobile_base; };
""",
)

AFTER_CYCLE = Code(
    "RC510",
    Severity.ERROR,
    "components wait for each other",
    """\
A component with `after` is started when those that it names are ready. In a circle none ever is.
Two components that need each other's operations need no `after`: a call waits for its server.

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
    "a component has no such parameter",
    """\
`set` names a parameter of the component's PDSL file; what is inside of groups is reached with dots
and, in a list, with a number from 0.

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
    "a parameter is set to a value of another kind",
    """\
The value is of the kind that the PDSL file gives the parameter.

Wrong, where the file says `rate float 50 [Hz] 1:1000;`:

    set rate = "fast";

Right:

    set rate = 100;
""",
)

SETTING_RANGE = Code(
    "RC513",
    Severity.ERROR,
    "a parameter is set to a value that it cannot have",
    """\
The value is within the range, or one of the choices, that the PDSL file gives the parameter.

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
`port` makes a component listen on a fixed TCP port, a whole number from 1 to 65535. It is seldom
needed: without it a free port is used, and components find each other.

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
Only one process of a machine can listen on a port.

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
    "an executable is not a command line",
    """\
`executable` is a program and its arguments as one types them, with quotes around what contains
spaces. No shell is involved.

Wrong:

    executable "python3 'my main.py";

Right:

    executable "python3 'my main.py'";
""",
)

UNKNOWN_PRIORITY = Code(
    "RC517",
    Severity.ERROR,
    "there is no such priority",
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
    "a number or a time of a deployment is out of range",
    """\
`max` and `depth` are whole numbers from 1. Times are above 0, up to a day, and have a unit: `ms`,
`s` or `min`.

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
    "there is no such host",
    """\
`on` places a component on a host that the deployment declares; without it the component runs on
this machine.

Wrong:

    component reflex on robot;

Right:

    host robot { address "127.0.0.1"; };
    component reflex on robot;
""",
)

PLACED_TWICE = Code(
    "RC520",
    Severity.ERROR,
    "a component is placed on two hosts",
    """\
What a group is placed on holds for all in it. A component, or a group inside, says the same or
nothing.

Wrong:

    group arm on robot { component motor on desk; };

Right:

    group arm on robot { component motor; };
""",
)

HOST_ADDRESS = Code(
    "RC521",
    Severity.ERROR,
    "a host has no address",
    """\
A host is reached by a name or by the numbers of its network address. `localhost` is this machine
and needs no declaration.

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
There is nothing to start.

Empty:

    Deployment demo { };

Better:

    Deployment demo { component mobile_base; };
""",
)

SEARCHED = Code(
    "RC523",
    Severity.ERROR,
    "a configuration cannot be searched for",
    """\
`context` and `from` let a component search for its configuration when it starts: in its working
folder, in those of the user, in installed ones. Their names stay inside these folders. `config`
names a file itself, which leaves nothing to search for.

Wrong:

    component arm { config "arm.yaml"; context "../lab"; };

Right:

    component arm { context "lab"; };
""",
)

PREFIX = Code(
    "RC524",
    Severity.ERROR,
    "a name that cannot be a prefix",
    """\
Under a prefix an instance, and all its topics and interfaces, have longer names for others:
`left/arm`. It is a name as others are, or several with `/` between them.

Wrong:

    component arm { prefix "left hand"; };

Right:

    component arm { prefix "left/hand"; };
""",
)
