"""Finding codes of rcdeploy: reasons why a valid deployment cannot run on this machine."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

CONFIGURATION = Code(
    "RC901",
    Severity.ERROR,
    "invalid component configuration",
    """\
rcdeploy checks the file named by `config` (or the component's own `etc/config.yaml`) and the `set`
lines against the component's PDSL file before it starts any process.

Wrong, where the PDSL says `rate float 50 1:1000;`:

    rate: 5000
    rte: 20

Right:

    rate: 500
""",
)

EXECUTABLE = Code(
    "RC902",
    Severity.ERROR,
    "missing component executable",
    """\
`executable` is a command line that runs in the folder of the component's CDSL file. rcdeploy looks
for the program in that folder and in PATH. `python3` is the Python that runs rcdeploy.

Wrong, if no program `main` was built:

    component arm { executable "./main"; };

Right:

    component arm { executable "python3 main.py"; };      // the default
""",
)

NOT_GENERATED = Code(
    "RC903",
    Severity.ERROR,
    "component not generated",
    """\
A deployment starts `main.py` in the folder of the CDSL file. `rcgen component` writes that file:

    rcgen component components/arm/arm.cdsl
""",
)

PORT_TAKEN = Code(
    "RC904",
    Severity.ERROR,
    "TCP port in use",
    """\
`port N` makes a component listen on a fixed TCP port of this machine. Another process already
listens there: an earlier run, or another component of the deployment. Without `port` the component
uses any free port. The same holds for `port Laser over ice at "tcp -p N"`.
""",
)

NAME_TAKEN = Code(
    "RC908",
    Severity.ERROR,
    "component name in use",
    """\
A name belongs to one running component of a domain: two would both answer each call. Another
process of the domain has this name: a component that was started by hand, or one that an earlier
run left behind. Stop that process (the message has its pid), or use another domain:

    rcdeploy app.ddsl up --domain other
""",
)

OUTDATED = Code(
    "RC905",
    Severity.WARNING,
    "outdated generated code",
    """\
The generated files differ from what `rcgen component` would write now. The component may
use other interfaces or parameters than the deployment was checked with. Generate it again:

    rcgen component components/arm/arm.cdsl
""",
)

MIDDLEWARE = Code(
    "RC906",
    Severity.ERROR,
    "a middleware cannot be used on this machine",
    """\
A deployment runs each component in its own process, which `inproc` cannot connect. Some middlewares
need a package that is installed separately; the help of the finding names it.

Wrong:

    Deployment robot { middleware inproc; component arm; };

Right:

    Deployment robot { component arm; };      // zenoh, if the component names no other
""",
)

SCHEDULING = Code(
    "RC575",
    Severity.ERROR,
    "CPU cores or real-time priority not available",
    """\
`cores` are CPU cores that the machine has, counted from 0. `realtime priority` needs the permission
of the system: a line in /etc/security/limits.conf, valid from the next login, or the capability
CAP_SYS_NICE.

Wrong, on a machine with four cores:

    component motor { cores 4; realtime priority 50; };

Right:

    component motor { cores 3; realtime priority 50; };
    // in /etc/security/limits.conf:  @realtime - rtprio 99
""",
)

NO_FITTING_HOST = Code(
    "RC576",
    Severity.ERROR,
    "no host fits components that must run together",
    """\
The members of a group that is placed as one run on the same host, and so do two components whose
connection has no middleware that connects hosts, such as `local`. The host must be a candidate of
all of them.

Wrong:

    host robot { address "10.0.0.2"; labels gpu; };
    host desk { address "10.0.0.3"; labels arm; };
    component vision on label gpu;
    component motor on label arm;
    connect vision.JointMotor -> motor.JointMotor over local;

Right:

    connect vision.JointMotor -> motor.JointMotor over zenoh;
""",
)
