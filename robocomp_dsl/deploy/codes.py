"""The findings of rcdeploy: what this machine lacks to run a deployment that is right in itself."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

CONFIGURATION = Code(
    "RC901",
    Severity.ERROR,
    "a configuration does not fit the parameters of its component",
    """\
The file named by `config` (or the component's own `etc/config.yaml`) and the `set` lines are
checked against the PDSL file of the component before anything is started.

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
    "the executable of a component is not there",
    """\
`executable` is a command line that runs in the folder of the component's CDSL file; its program is
searched there and in PATH. `python3` means the Python that runs rcdeploy.

Wrong, where nothing called `main` was built:

    component arm { executable "./main"; };

Right:

    component arm { executable "python3 main.py"; };      // the default
""",
)

NOT_GENERATED = Code(
    "RC903",
    Severity.ERROR,
    "a component has not been generated",
    """\
A deployment starts `main.py` beside the CDSL file, which `rcgen component` writes.

    rcgen component components/arm/arm.cdsl
""",
)

PORT_TAKEN = Code(
    "RC904",
    Severity.ERROR,
    "the port of a component is in use",
    """\
`port N` makes a component listen on a fixed TCP port of this machine. Another process listens there
already: an earlier run, or another component of the deployment. Without `port` any free one is
used.
""",
)

OUTDATED = Code(
    "RC905",
    Severity.WARNING,
    "the generated code is older than its description",
    """\
The files under `generated/` are not those that `rcgen component` would write now; the component may
speak another interface or know other parameters than the deployment assumes.

    rcgen component components/arm/arm.cdsl
""",
)

MIDDLEWARE = Code(
    "RC906",
    Severity.ERROR,
    "a middleware that cannot connect processes",
    """\
A deployment runs each component in a process of its own and watches it over the middleware of the
deployment. That takes `zenoh`; `inproc` connects components within one process.

Wrong:

    Deployment robot { middleware inproc; component arm; };

Right:

    Deployment robot { component arm; };      // zenoh
""",
)

OTHER_MACHINE = Code(
    "RC907",
    Severity.ERROR,
    "a component is placed on another machine",
    """\
rcdeploy starts components on the machine that it runs on, and on no other yet. What is on
`localhost`, or on a host with that address, is started.

Not yet:

    host robot { address "10.0.0.2"; };
    component arm on robot;

For now:

    component arm on localhost;
""",
)
