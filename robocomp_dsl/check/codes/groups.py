"""RC56x: definitions and instances of groups, groups in one process."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNKNOWN_DEFINITION = Code(
    "RC560",
    Severity.ERROR,
    "unknown definition of a group",
    """\
A group outside of the deployment is a definition. `group left : arm;` is an instance of the
definition `arm`, which is in the same file or in an imported one.

Wrong:

    Deployment demo { group arm { component motor; }; group left : arm; };

Right:

    group arm { component motor; };
    Deployment demo { group left : arm; group right : arm; };
""",
)

DEFINITION_CYCLE = Code(
    "RC561",
    Severity.ERROR,
    "the definition of a group contains itself",
    """\
A definition may contain instances of other definitions, but not of itself, also not through others.

Wrong:

    group arm { component motor; group hand : gripper; };
    group gripper { component finger; group wrist : arm; };

Right:

    group arm { component motor; group hand : gripper; };
    group gripper { component finger; };
""",
)

INSTANCE_ITEM = Code(
    "RC562",
    Severity.ERROR,
    "an instance of a group has other components than its definition",
    """\
An instance has the components, connections and exports of its definition. It chooses a host, a
prefix, what it starts after, and values of parameters.

Wrong:

    group left : arm { component camera; };

Right:

    group left : arm { on robot; set motor.speed = 3; };
    component camera;
""",
)

UNKNOWN_MEMBER = Code(
    "RC563",
    Severity.ERROR,
    "`set` of a group names no component of it",
    """\
`set` of a group names a component of the group, then its parameter. Components of nested groups are
named with their group.

Wrong:

    group left : arm { set speed = 3; };

Right:

    group left : arm { set motor.speed = 3; set hand.finger.force = 2; };
""",
)

NO_DEFINITION = Code(
    "RC564",
    Severity.ERROR,
    "an imported deployment file defines no group",
    """\
The import of a DDSL file makes its definitions of groups visible: the groups outside of its
deployment. The deployment in it is not imported.

Wrong, in arm.ddsl, which another file imports:

    Deployment demo { group arm { component motor; }; };

Right:

    group arm { component motor; };
""",
)

SAME_DEFINITION = Code(
    "RC565",
    Severity.ERROR,
    "two imports define a group of the same name",
    """\
The name after the colon of `group left : arm;` must have one meaning.

Wrong, if both files define `arm`:

    import "nao/arm.ddsl";
    import "icub/arm.ddsl";

Right, with `group icub_arm { … };` in the second file:

    import "nao/arm.ddsl";
    import "icub/icub_arm.ddsl";
""",
)

ONE_PROCESS = Code(
    "RC566",
    Severity.ERROR,
    "a component cannot run in the process of its group",
    """\
All components of a group with `inprocess` run in one process of Python on one host. What belongs to
a process is written in the group: `memory`, `cpu`, `restart`. Programs and components with another
`executable` are processes of their own.

Wrong:

    group arm
    {
        inprocess;
        component motor { memory 100 MB; };
        program viewer { executable "viewer"; };
    };

Right:

    group arm { inprocess; memory 200 MB; component motor; };
    program viewer { executable "viewer"; };
""",
)

PROCESS_SETTING = Code(
    "RC567",
    Severity.ERROR,
    "a setting of a process is in a group without `inprocess`",
    """\
`memory`, `cpu`, `restart` and `ready within` are of one process. A group without `inprocess` has a
process for each component.

Wrong:

    group arm { memory 200 MB; component motor; component reflex; };

Right:

    group arm { component motor { memory 100 MB; }; component reflex { memory 100 MB; }; };
""",
)

ENVIRONMENT_CONFLICT = Code(
    "RC568",
    Severity.ERROR,
    "components of one process need different values of an environment variable",
    """\
A process has one environment. Components of a group with `inprocess` may set a variable only to the
same value.

Wrong:

    group arm { inprocess; component a { env MODE = x; }; component b { env MODE = y; }; };

Right:

    group arm { inprocess; component a { env MODE = x; }; };
    component b { env MODE = y; };
""",
)

TOO_LARGE = Code(
    "RC569",
    Severity.ERROR,
    "definitions of groups have too many instances",
    """\
A deployment may have 1000 instances of groups, and a definition may follow 50 others. More is
nearly always a mistake: ten definitions, each with four instances of the next one, are a million.

Wrong:

    group a { group x : b; group y : b; };  // and so on, thirty times
    group b { group x : c; group y : c; };

Right:

    group a { group x : b; };
    group b { component motor; };
""",
)
