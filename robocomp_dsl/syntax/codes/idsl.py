"""RC223, RC225: arrays, bounds and unsigned integers of IDSL."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

INVALID_LENGTH = Code(
    "RC223",
    Severity.ERROR,
    "invalid array or number of elements",
    """\
A field may be an array of a fixed number of elements, from 1 to 1000000. It has one dimension, and
starts with zeros. A sequence may have a largest number of elements. A parameter, a result or an
element is not an array: declare a struct with the array, or a named sequence.

Wrong:

    struct Pose { double covariance[6][6]; };
    interface Localizer { void setPose(double pose[6]); };

Right:

    sequence<double, 6> Values;
    struct Pose { double covariance[36]; };
    interface Localizer { void setPose(Values pose); };
""",
)

UNSIGNED_TYPE = Code(
    "RC225",
    Severity.ERROR,
    "unknown unsigned type",
    """\
The integers without a sign are `byte` (8 bits), `unsigned short` (16), `unsigned int` (32) and
`unsigned long` (64).

Wrong:

    struct Frame { unsigned number; unsigned char checksum; };

Right:

    struct Frame { unsigned int number; byte checksum; };
""",
)
