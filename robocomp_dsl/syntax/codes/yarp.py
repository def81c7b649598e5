"""RC123 to RC126: definitions of YARP (`.thrift`, `.bottle`)."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

THRIFT_STATEMENT = Code(
    "RC123",
    Severity.ERROR,
    "invalid statement in a Thrift definition",
    """\
A `.thrift` file is read as yarpidl_thrift reads it: `include`, `namespace`, `const`, `typedef`,
`enum`, `struct`, `exception` and `service`. A field has a number, a type and a name.

Wrong:

    service Motor {
        bool move_to(1: double);
    }

Right:

    service Motor {
        bool move_to(1: double angle);
    }

The built-in types are `bool`, `i8`, `i16`, `i32`, `i64`, `double`, `string` and `binary`; of others
there are `list<type>`, `set<type>` and `map<type, type>`.
""",
)

THRIFT_UNSUPPORTED = Code(
    "RC124",
    Severity.ERROR,
    "Thrift declaration that IDSL cannot express",
    """\
A value of an IDSL type always has all its fields, so there are no unions. `senum` was removed from
Thrift.

Wrong:

    union Target {
        1: double angle
        2: string name
    }

Right:

    enum TargetKind { ANGLE, NAME }

    struct Target {
        1: TargetKind kind
        2: double angle
        3: string name
    }
""",
)

THRIFT_LEFT_OUT = Code(
    "RC125",
    Severity.WARNING,
    "part of a Thrift definition that is not imported",
    """\
The definition is imported, but without this part: a constant or default that is a list or a map; an
optional field without a default, which YARP always sends; the layout of a C++ class that
`yarp.name` names, which only that class knows. Write its fields:

Wrong:

    struct Location {
    } (
        yarp.name = "yarp::dev::Nav2D::Map2DLocation"
    )

Right:

    struct Location {
        1: string map_id
        2: double x
        3: double y
        4: double theta
        5: string description
    } (
        yarp.name = "yarp::dev::Nav2D::Map2DLocation"
    )

Known are `yarp::sig::Vector`, `yarp::sig::VectorOf<double>`, `<float>` and `<int>`,
`yarp::conf::float32_t` and `float64_t`.
""",
)

BOTTLE_STATEMENT = Code(
    "RC126",
    Severity.ERROR,
    "invalid field in a Bottle definition",
    """\
A `.bottle` file describes the items of a Bottle in order. Each is a list: a type, a name and, of
numbers, a unit; or a name and the items of a nested list. `*` behind the name stands for any number
of values, which are a nested list. After `#` follows a comment.

Wrong:

    (angle double)

Right:

    (float64 angle [deg])
    (target (float64 x [m]) (float64 y [m]))
    (string names *)

The types are `bool`, `int8`, `int16`, `int32` (`int`), `int64`, `float32`, `float64` (`double`),
`string` and `blob`.
""",
)
