"""RC3xx: types, operations and their patterns."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNKNOWN_TYPE = Code(
    "RC301",
    Severity.ERROR,
    "unknown type",
    """\
A type is built in (`bool byte short int long float double string`, and `unsigned` before `short`,
`int` or `long`), declared in the module (in any order), or declared in an imported file. The name
of its module before it is optional.

Wrong:

    struct Tag { Sting name; };

Right:

    struct Tag { string name; };
""",
)

AMBIGUOUS_TYPE = Code(
    "RC302",
    Severity.ERROR,
    "ambiguous type name",
    """\
Two imported modules declare a type with this name; write the module before the name.

Wrong, where both modules declare `Pose`:

    struct Grasp { Pose hand; };

Right:

    struct Grasp { RoboCompArm::Pose hand; };
""",
)

RECURSIVE_TYPE = Code(
    "RC303",
    Severity.ERROR,
    "recursive type",
    """\
A type must not contain itself, not even through a sequence: every value is a finite tree of known
depth, so that encoding is fast and decoding is safe.

Wrong:

    sequence<Node> NodeList;
    struct Node { string name; NodeList children; };

Right:

    struct Node { string name; int parent; };
    sequence<Node> NodeList;
""",
)

NOT_A_TYPE = Code(
    "RC304",
    Severity.ERROR,
    "not a data type",
    """\
Fields, parameters and elements have data types: built-in types, structs, enumerations, sequences
and dictionaries. Interfaces and exceptions are not data types.

Wrong, where `Laser` is an interface:

    struct Robot { Laser front; };

Right:

    struct Robot { TLaserData front; };
""",
)

NOT_AN_EXCEPTION = Code(
    "RC305",
    Severity.ERROR,
    "`throws` names a type that is not an exception",
    """\
`throws` lists exceptions, which are declared with the keyword `exception`.

Wrong:

    struct HardwareFailed { string what; };
    interface Arm { void home() throws HardwareFailed; };

Right:

    exception HardwareFailed { string what; };
    interface Arm { void home() throws HardwareFailed; };
""",
)

DICTIONARY_KEY = Code(
    "RC306",
    Severity.ERROR,
    "invalid key type of a dictionary",
    """\
Keys are compared for equality, so they are integers, strings, bools, enumerations, or structs of
these. Floating-point numbers are excluded because equal-looking values may differ in the last
digit; sequences and dictionaries have a variable size.

Wrong:

    dictionary<float, string> Names;

Right:

    dictionary<int, string> Names;
""",
)

DEFAULT_TYPE = Code(
    "RC307",
    Severity.ERROR,
    "the default of a field has the wrong type",
    """\
The default matches the type of its field: a number, `true` or `false`, a string in quotes, or the
name of an enumerator. Fields of other types have no default and start empty.

Wrong:

    struct Tag { int id = "7"; };

Right:

    struct Tag { int id = 7; };
""",
)

DEFAULT_VALUE = Code(
    "RC308",
    Severity.ERROR,
    "the default of a field is out of range",
    """\
The default is too large for the type, or not an enumerator of the enumeration. A `byte` is 0 to
255; `short`, `int` and `long` are signed integers of 16, 32 and 64 bits, and unsigned ones after
`unsigned`.

Wrong:

    enum Mode { Idle, Moving };
    struct Arm { byte joints = 300; Mode mode = Stopped; };

Right:

    struct Arm { short joints = 300; Mode mode = Idle; };
""",
)

EMPTY_ENUM = Code(
    "RC309",
    Severity.ERROR,
    "empty enumeration",
    """\
A field of an enumeration always holds one of its values, so an enumeration needs at least one.

Wrong:

    enum Mode { };

Right:

    enum Mode { Idle };
""",
)

DUPLICATE_ENUM_VALUE = Code(
    "RC310",
    Severity.ERROR,
    "duplicate value in an enumeration",
    """\
Messages carry the value, so the receiver could not distinguish the two names. An enumerator without
a number has the value of the preceding one plus 1.

Wrong:

    enum Mode { Idle = 1, Moving = 1 };

Right:

    enum Mode { Idle = 1, Moving = 2 };
""",
)

ENUM_VALUE = Code(
    "RC311",
    Severity.ERROR,
    "the value of an enumerator is out of range",
    """\
Enumerators are 32-bit signed integers: whole numbers from -2147483648 to 2147483647.

Wrong:

    enum Mode { Idle = 1.5 };

Right:

    enum Mode { Idle = 1 };
""",
)

ONE_WAY_OUTPUT = Code(
    "RC312",
    Severity.ERROR,
    "a one-way operation has an output",
    """\
A `[command]` is sent to one component and a `[publish]` to all subscribers; neither has a reply, so
they have no result and no `out` parameter. A `[query]` has a reply.

Wrong:

    [command] bool stop();

Right:

    [query] bool stop();
    [command] void stop();
""",
)

IMPLIED_RESPONSE = Code(
    "RC313",
    Severity.NOTE,
    "a parameter is interpreted as the response of a query",
    """\
A `[query]` with two structs that returns an `int` is interpreted as request and response, even
without `out`: RoboComp's communication patterns are used this way. If the name of the type ends in
`resp` or `response`, nothing is reported. Write `out` to make it explicit.

    [query] int say(Phrase phrase, Outcome outcome);
    [query] int say(Phrase phrase, out Outcome outcome);      // the same
""",
)

TOPIC_WITH_OUTPUT = Code(
    "RC314",
    Severity.WARNING,
    "an interface with outputs is used as a topic",
    """\
Published messages are sent to every subscriber and have no reply. So a topic has only the
operations that are `void`, without `out` and without `throws`. The others have no method at a
subscriber, and raise `NotPublishable` if they are called on a published port.

Not published:

    interface Laser { TLaserData getLaserData(); };
    Component base { Communications { publishes Laser; }; language Python; };

Better:

    interface LaserPub { void pushLaserData(TLaserData scan); };
    Component base { Communications { publishes LaserPub; }; language Python; };
""",
)

PATTERN_AND_ROLE = Code(
    "RC315",
    Severity.ERROR,
    "the pattern of an operation does not match the role of the port",
    """\
A `[command]` or `[query]` has one receiver, which implements it; a `[publish]` has any number of
subscribers. The pattern of an operation and the role of the port must agree. Operations without a
pattern match every role.

Wrong:

    interface Base { [publish] void moved(Pose pose); };
    Component base { Communications { implements Base; }; language Python; };

Right:

    Component base { Communications { publishes Base; }; language Python; };
""",
)

MIXED_INTERFACE = Code(
    "RC316",
    Severity.WARNING,
    "an interface mixes called and published operations",
    """\
A port either calls or publishes, so no port can use all of such an interface.

Wrong:

    interface Base
    {
        [command] void stop();
        [publish] void moved(Pose pose);
    };

Right:

    interface Base { [command] void stop(); };
    interface BasePub { [publish] void moved(Pose pose); };
""",
)

EXCESSIVE_TYPE = Code(
    "RC317",
    Severity.ERROR,
    "a type is nested too deeply or too large",
    """\
Types may be nested 64 deep, and one value consists of at most 100000 built-in values, not counting
the elements of sequences. Hand-written types are far smaller; check the program that generated this
one.

Wrong: a struct of 10 structs of 10 structs of 10 structs of 10 structs of 100 floats.

Right: a `sequence<float>`.
""",
)

UNIT_WITHOUT_NUMBER = Code(
    "RC318",
    Severity.WARNING,
    "unit of a value that is not a number",
    """\
Only numbers have a unit in brackets; strings, bools and enumerations have none.

Wrong:

    string name [mm];

Right:

    float width [mm];
""",
)

UNIT_CASE = Code(
    "RC319",
    Severity.WARNING,
    "unusual spelling of a unit",
    """\
Case distinguishes units: `mm` and `Mm`, `s` and `S`. A unit is written as its symbol.

Wrong:

    float rate [hz];

Right:

    float rate [Hz];
""",
)

UNKNOWN_UNIT = Code(
    "RC224",
    Severity.ERROR,
    "unknown unit",
    """\
Brackets behind the name of a field or parameter have its unit: symbols such as `m`, `rad`, `Nm`,
`degC`, `%`, `px`, `bytes`, `ticks`, with prefixes, `/`, `*` and powers: `mm/s^2`. What is counted,
such as apples, belongs into the comment. A whole number is the length of an array.

Wrong:

    struct Basket { int size [apples]; double weights[n]; };

Right:

    struct Basket { int size;  /** Number of apples. */ double weights[8] [kg]; };
""",
)

EXCEPTION_WITHOUT_REPLY = Code(
    "RC320",
    Severity.WARNING,
    "callers never receive the exception of a one-way operation",
    """\
A `[command]` and a `[publish]` have no reply, so an exception of the implementation only appears in
its log, whether it is declared or not. A `[query]` has a reply, even without a result, and raises
the exception at the caller.

Without effect:

    [command] void setSpeed(Speed speed) throws HardwareFailed;

Better:

    [query] void setSpeed(Speed speed) throws HardwareFailed;
    [command] void setSpeed(Speed speed);
""",
)
