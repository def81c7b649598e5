"""RC54x: the devices in a component of a deployment."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNKNOWN_DEVICE = Code(
    "RC540",
    Severity.ERROR,
    "there is no such device",
    """\
`attach` and `on` speak of devices of the same component, by the names under which it declares them.

Wrong:

    component body {
        device arm : control_board { set part = LArm; };
        attach zeroing to arn;
    };

Right:

    component body {
        device arm : control_board { set part = LArm; };
        device zeroing : calibrator;
        attach zeroing to arm;
    };
""",
)

DEVICE_CIRCLE = Code(
    "RC541",
    Severity.ERROR,
    "devices cannot stand on each other like this",
    """\
A device is attached once, to one device or to several, and never to itself, not even by way of
others: what it stands on must be there before it.

Wrong:

    attach hand to wrist;
    attach wrist to hand;

Right:

    attach hand to wrist;
    attach wrist to arm;
""",
)

DEVICE_ACTION = Code(
    "RC542",
    Severity.ERROR,
    "an action cannot be done like this",
    """\
Levels of a phase are whole numbers from 0 upwards; several actions may have the same one. What is
attached or detached stands on others, by an `attach` line; only `calibrate` and `park` are done by
another device, one that is attached to theirs.

Wrong:

    on startup level -1 calibrate arm;
    on shutdown level 2 detach arm by zeroing;

Right, where `attach zeroing to arm;` is written:

    on startup level 5 calibrate arm by zeroing;
    on shutdown level 1 park arm;
    on shutdown level 2 detach zeroing;
""",
)
