"""RC4xx: the parameters of a component."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNKNOWN_PARAMETER_TYPE = Code(
    "RC401",
    Severity.ERROR,
    "unknown parameter type",
    """\
The type of a parameter is `string`, `int`, `float`, `bool`, or an enumeration in braces.

Wrong:

    rate double 50;

Right:

    rate float 50;
    mode {position, velocity} position;
""",
)

PARAMETER_DEFAULT_TYPE = Code(
    "RC402",
    Severity.ERROR,
    "the default of a parameter has the wrong type",
    """\
The default matches the type: a string in quotes for a `string`, an integer for an `int`, a number
for a `float`, `true` or `false` for a `bool`. A parameter without a default must be set in the
configuration.

Wrong:

    motors int 2.5;
    device string /dev/ttyUSB0;

Right:

    motors int 2;
    device string "/dev/ttyUSB0";
""",
)

PARAMETER_DEFAULT_VALUE = Code(
    "RC403",
    Severity.ERROR,
    "the default of a parameter is not one of its values",
    """\
The default is not one of the names in the braces, or does not fit in 64 bits.

Wrong:

    mode {position, velocity} speed;

Right:

    mode {position, velocity} velocity;
""",
)

DEFAULT_OUT_OF_RANGE = Code(
    "RC404",
    Severity.ERROR,
    "the default of a parameter is out of its range",
    """\
The range applies to the default as well as to configured values.

Wrong:

    rate float 5000 [Hz] 1:1000;

Right:

    rate float 500 [Hz] 1:1000;
""",
)

EMPTY_RANGE = Code(
    "RC405",
    Severity.ERROR,
    "empty range",
    """\
Write the smaller bound before the colon; both bounds are inclusive.

Wrong:

    rate float 50 1000:1;

Right:

    rate float 50 1:1000;
""",
)

RANGE_WITHOUT_NUMBER = Code(
    "RC406",
    Severity.ERROR,
    "range of a parameter that is not a number",
    """\
Only an `int` or a `float` can have a range. To limit other values, list them in braces.

Wrong:

    device string "/dev/ttyUSB0" 0:3;

Right:

    device {front, rear} front;
""",
)

RANGE_BOUND = Code(
    "RC407",
    Severity.ERROR,
    "the bound of a range has the wrong type",
    """\
The range of an `int` and the length of a list have integer bounds.

Wrong:

    motors int 2 0.5:8;

Right:

    motors int 2 1:8;
""",
)

LIST_LENGTH = Code(
    "RC408",
    Severity.ERROR,
    "invalid length of a list",
    """\
The numbers in brackets are the minimum and maximum number of groups or values, from 0 to 100000.
`motors[3]` is a list of exactly 3 groups, `motors[]` of any length; `motors` without brackets is
one group.

Wrong:

    motors[-1:32] { name string; };

Right:

    motors[0:32] { name string; };
""",
)

LIST_DEFAULT_LENGTH = Code(
    "RC409",
    Severity.ERROR,
    "the default of a list has a wrong number of values",
    """\
The default of a list has as many values as the brackets after its name permit. One value without
braces is the default of each element that the list has at least.

Wrong:

    weights[2:8] float {1.0};

Right:

    weights[2:8] float {1.0, 1.0, 0.5};
""",
)

DEFAULT_IS_LIST = Code(
    "RC410",
    Severity.ERROR,
    "a list is the default of a parameter that is no list",
    """\
The brackets after its name make a parameter a list, with the smallest and the largest number of its
elements: `[1:8]`; `[3]` is exactly three, `[]` any number.

Wrong:

    weights float {1.0, 2.0};

Right:

    weights[2] float {1.0, 2.0};
""",
)

UNUSED_DEFAULT = Code(
    "RC412",
    Severity.WARNING,
    "the default of a list is not used",
    """\
One value without braces is the default of each element that a list has at least. A list that may be
empty starts empty, so such a default is not used.

Wrong:

    weights[0:8] float 1.0;

Right:

    weights[0:8] float {1.0};
""",
)
