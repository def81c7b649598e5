"""RC54x: the devices in a component of a deployment."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNKNOWN_DEVICE = Code(
    "RC540",
    Severity.ERROR,
    "unknown device",
    """\
`attach` and `on` refer to devices that the same component declares.

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

DEVICE_CYCLE = Code(
    "RC541",
    Severity.ERROR,
    "duplicate attachment or attachment cycle",
    """\
A device has one `attach` line, to one device or several. It must not be attached to itself,
directly or through other devices: a device is opened after the devices that it is attached to.

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
    "invalid device action",
    """\
The level of an action is a whole number from 0; several actions may have the same level. `attach`
and `detach` apply to devices with an `attach` line. Only `calibrate` and `park` take `by`, with a
device that is attached to the target.

Wrong:

    on startup level -1 calibrate arm;
    on shutdown level 2 detach arm by zeroing;

Right, where `attach zeroing to arm;` is written:

    on startup level 5 calibrate arm by zeroing;
    on shutdown level 1 park arm;
    on shutdown level 2 detach zeroing;
""",
)
