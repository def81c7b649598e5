"""RC76x, RC77x: bridges: types, lengths and units of values."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNKNOWN_BRIDGE_FIELD = Code(
    "RC763",
    Severity.ERROR,
    "field or parameter that does not exist",
    """\
A path names fields of the message type, or parameters of the operation, from the outside to the
inside.

Wrong:

    header.frame = "rover_base";

Right:

    header.frame_id = "rover_base";
""",
)

VALUE_TYPE = Code(
    "RC764",
    Severity.ERROR,
    "value that does not fit the type",
    """\
Numbers fit wider numbers, and `double` fits `float`. Between strings and numbers, `number(x)` and
`text(x)` convert; `number(x)` also rounds to an integer and checks the range at run time. A scalar
takes one item of a list. A list or hub fits a struct item by item.

Wrong:

    header.frame_id = wheels[0];

Right:

    header.frame_id = text(wheels[0]);
""",
)

VALUE_LENGTH = Code(
    "RC765",
    Severity.ERROR,
    "wrong number of items",
    """\
A list or hub that is assigned to a struct has one item for each field, and as many as a list of
fixed length. Items are counted from 0. If a number of items is known at run time only, it is
checked then: a message that does not fit is dropped and counted.

Wrong:

    orientation = { 0.0, 0.0, 0.0 };

Right:

    orientation = { 0.0, 0.0, 0.0, 1.0 };
""",
)

UNIT_MISMATCH = Code(
    "RC766",
    Severity.ERROR,
    "units of different dimensions",
    """\
Units of the same dimension are converted automatically: mm to m, deg to rad, degC to K. Others
cannot be converted.

Wrong, where `distance` is in m:

    position = distance to [rad];

Right:

    range = distance to [mm];
""",
)

UNIT_DROPPED = Code(
    "RC767",
    Severity.WARNING,
    "value with a unit in a field without one",
    """\
The type of the message does not tell in which unit receivers read the field. Write `to [unit]`: it
converts if necessary, and states the unit in which the value is sent.

Wrong, where `angle` is in deg:

    data = angle;

Right:

    data = angle to [rad];
""",
)

MISSING_UNIT = Code(
    "RC768",
    Severity.ERROR,
    "conversion of a value without unit",
    """\
`to [unit]` converts from the unit of the value. Declare it where the value comes from.

Wrong:

    input angle : double over yarp at "/angle:o";
    output a : double over yarp at "/a:i" = angle to [rad];

Right:

    input angle : double [deg] over yarp at "/angle:o";
    output a : double over yarp at "/a:i" = angle to [rad];
""",
)

INVALID_UNIT = Code(
    "RC769",
    Severity.ERROR,
    "invalid unit",
    """\
A unit is a product of symbols with exponents: `rad/s`, `m/s^2`, `N m`, `1`. Only numbers have one.

Wrong:

    input speed : double [m//s] over yarp at "/speed:o";

Right:

    input speed : double [m/s] over yarp at "/speed:o";
""",
)

UNKNOWN_UNIT = Code(
    "RC770",
    Severity.WARNING,
    "unknown unit",
    """\
A unit that is not known converts to itself only. Check its spelling and case.

Wrong:

    input angle : double [degs] over yarp at "/angle:o";

Right:

    input angle : double [deg] over yarp at "/angle:o";
""",
)

ASSIGNED_TWICE = Code(
    "RC771",
    Severity.ERROR,
    "two assignments to one field",
    """\
A field gets one value. An assignment to a field and another one to a part of it contradict each
other; only `= value` of an output may be followed by assignments, which override parts of it.

Wrong:

    header = camera.header;
    header.frame_id = "eye";

Right:

    header.stamp = camera.header.stamp;
    header.frame_id = "eye";
""",
)

FUNCTION_ARGUMENTS = Code(
    "RC772",
    Severity.ERROR,
    "wrong arguments",
    """\
A function gets as many arguments as it has parameters, and a call gets every parameter of its
operation. `number`, `text`, `length` and `stamp` have one argument; that of `stamp` is an input.

Wrong:

    position = mirror();

Right:

    position = mirror(wheels);
""",
)

INVALID_ARITHMETIC = Code(
    "RC773",
    Severity.ERROR,
    "invalid arithmetic",
    """\
`+`, `-`, `*` and `/` calculate with numbers and lists of numbers, item by item. Two instants may be
subtracted. What is added has units of the same dimension.

Wrong:

    frame_id = "robot" + 1;

Right:

    x = left[0] + 1;
""",
)

INVALID_SELECTION = Code(
    "RC774",
    Severity.ERROR,
    "selection or field of a value that has none",
    """\
`value[0]` selects items of a list; `value.name` is a field of a struct, or a parameter of an
operation.

Wrong:

    x = imu[0];

Right:

    x = imu.angular_velocity.x;
""",
)

TIME_TYPE = Code(
    "RC775",
    Severity.ERROR,
    "type that cannot hold a time",
    """\
`now` and `stamp(input)` fit the ROS type `Time`, a `double [s]`, and 64-bit integers such as
`long [ns]`. Seconds since 1970 exceed an `int` in 2038, and a `float` has a resolution of 128 s.

Wrong, where `item` is an `int [s]`:

    item = now;

Right, where `item` is a `double [s]`:

    item = now;
""",
)
