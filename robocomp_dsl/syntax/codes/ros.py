"""RC12x: ROS definitions (`.msg`, `.srv`, `.action`)."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

ROS_STATEMENT = Code(
    "RC121",
    Severity.ERROR,
    "invalid statement in a ROS definition",
    """\
Each line of a `.msg`, `.srv` or `.action` file has one field, `type name` with an optional default
value, or one constant, `type NAME=value`. After `#` follows a comment. A service has one line `---`
between request and response; an action has two, between goal, result and feedback.

Wrong:

    float32[] ranges;
    float32

Right:

    float32[] ranges
    float32 range_max

Arrays are written `float64[36]`, `float64[<=10]` (at most 10 elements) and `float64[]`.
""",
)

ROS_UNSUPPORTED_TYPE = Code(
    "RC122",
    Severity.ERROR,
    "ROS type without a common encoding",
    """\
`wstring`, `wchar` and `long double` are encoded differently by the middlewares of ROS 2, so a value
could arrive changed. Use `string`, which is UTF-8, and `float64`.

Wrong:

    wstring label

Right:

    string label
""",
)
