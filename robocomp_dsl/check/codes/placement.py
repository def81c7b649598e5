"""Finding codes of hosts and of the placement of components on them."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNKNOWN_LABEL = Code(
    "RC570",
    Severity.ERROR,
    "unknown label",
    """\
`on label` and `place by load on label` choose among the hosts that have the label.

Wrong:

    host robot { address "10.0.0.2"; labels arm; };
    component grasp on label gripper;

Right:

    host robot { address "10.0.0.2"; labels arm, gripper; };
    component grasp on label gripper;
""",
)

PLACED_TWICE = Code(
    "RC571",
    Severity.ERROR,
    "a component or a group is placed twice",
    """\
`on robot`, `on label gpu` and `place by load` each choose the host. One of them is enough; the
hosts or the label among which the load decides follow `place by load`.

Wrong:

    component vision on label gpu { place by load; };

Right:

    component vision { place by load on label gpu; };
""",
)

SHARED_ADDRESS = Code(
    "RC572",
    Severity.ERROR,
    "two hosts have the same address",
    """\
Each host is one user on one machine: two hosts would write into the same folders there.

Wrong:

    host left { address "10.0.0.2"; };
    host right { address "10.0.0.2"; };

Right:

    host left { address "10.0.0.2"; };
    host right { address "10.0.0.3"; };
""",
)

UNUSED_HOST = Code(
    "RC573",
    Severity.WARNING,
    "a host without components",
    """\
No component names the host, has one of its labels, or may be placed on it by load. `rcdeploy` does
not connect to it.

Without effect:

    host robot { address "10.0.0.2"; };
    component vision;

Better:

    host robot { address "10.0.0.2"; };
    component vision on robot;
""",
)

NO_CANDIDATE = Code(
    "RC574",
    Severity.ERROR,
    "no host to choose from",
    """\
`place by load` chooses among the hosts of the deployment.

Wrong:

    Deployment demo { component vision { place by load; }; };

Right:

    Deployment demo
    {
        host robot { address "10.0.0.2"; };
        host desk { address "10.0.0.3"; };
        component vision { place by load; };
    };
""",
)

LOCKSTEP_OVER_HOSTS = Code(
    "RC577",
    Severity.WARNING,
    "lock-step over several hosts may lose components",
    """\
In lock-step each step waits for the components on all hosts, so it takes a round trip through the
network. If a link is cut for longer than the step limit, its components time out. With `lost drop`
(the default) the others continue without them, and the run is not reproducible; with `lost stop`
the deployment fails instead.

Risky, where the components are on two hosts:

    clock sim from body lockstep;

Better:

    clock sim from body lockstep lost stop;
""",
)
