"""RC4xx: the parameters of a component."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNKNOWN_KIND = Code(
    "RC401",
    Severity.ERROR,
    "there is no such kind of parameter",
    """\
A parameter is a `string`, an `int`, a `float`, a `bool`, or one of some names in braces.

Wrong:

    rate double 50;

Right:

    rate float 50;
    mode {position, velocity} position;
""",
)

PARAMETER_DEFAULT = Code(
    "RC402",
    Severity.ERROR,
    "the default of a parameter is of another kind",
    """\
A default is written as its kind asks: a text in quotes, a whole number for an `int`, a number for a
`float`, `true` or `false` for a `bool`. A parameter without a default must be given in the
configuration.

Wrong:

    motors int 2.5;
    device string /dev/ttyUSB0;

Right:

    motors int 2;
    device string "/dev/ttyUSB0";
""",
)

PARAMETER_CHOICE = Code(
    "RC403",
    Severity.ERROR,
    "the default of a parameter is not one of its values",
    """\
The default is none of the names in the braces, or does not fit into a number of 64 bits.

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
The range holds for the default as for every value that is given later.

Wrong:

    rate float 5000 [Hz] 1:1000;

Right:

    rate float 500 [Hz] 1:1000;
""",
)

EMPTY_RANGE = Code(
    "RC405",
    Severity.ERROR,
    "no value is within a range",
    """\
The smaller bound stands in front of the colon; both belong to the range.

Wrong:

    rate float 50 1000:1;

Right:

    rate float 50 1:1000;
""",
)

RANGE_WITHOUT_NUMBER = Code(
    "RC406",
    Severity.ERROR,
    "something that is not a number has a range",
    """\
Only an `int` or a `float` can have a range. The values of another kind are limited by naming them.

Wrong:

    device string "/dev/ttyUSB0" 0:3;

Right:

    device {front, rear} front;
""",
)

RANGE_BOUND = Code(
    "RC407",
    Severity.ERROR,
    "the bound of a range is of another kind",
    """\
The range of an `int` and the length of a list have whole bounds.

Wrong:

    motors int 2 0.5:8;

Right:

    motors int 2 1:8;
""",
)

GROUP_LENGTH = Code(
    "RC408",
    Severity.ERROR,
    "a list of groups has an impossible length",
    """\
The numbers in brackets say how many groups the list has at least and at most: from 0 to 100000.
`motors[3]` is a list of exactly 3, `motors[]` of any length, `motors` without brackets one group.

Wrong:

    motors[-1:32] { name string; };

Right:

    motors[0:32] { name string; };
""",
)
