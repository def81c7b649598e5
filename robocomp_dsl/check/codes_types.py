"""RC3xx: types, operations and their patterns."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNKNOWN_TYPE = Code(
    "RC301",
    Severity.ERROR,
    "there is no such type",
    """\
A type is built in (`bool byte short int long float double string`) or declared: in the module, in
any order, or in an imported file, with or without the name of its module in front.

Wrong:

    struct Tag { Sting name; };

Right:

    struct Tag { string name; };
""",
)

AMBIGUOUS_TYPE = Code(
    "RC302",
    Severity.ERROR,
    "the name of a type has several meanings",
    """\
Two imported modules declare a type of this name; the module in front of it says which one is meant.

Wrong, where both modules declare `Pose`:

    struct Grasp { Pose hand; };

Right:

    struct Grasp { RoboCompArm::Pose hand; };
""",
)

RECURSIVE_TYPE = Code(
    "RC303",
    Severity.ERROR,
    "a type contains itself",
    """\
A value of a type that contains itself has no layout of its own, and no end. This holds for a
sequence of itself, too: every value is a finite tree of known depth, which is what makes it fast to
pack and safe to unpack.

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
    "something that is not a data type is used as one",
    """\
Fields, parameters and elements are data: built-in types, structs, enumerations, sequences and
dictionaries. Interfaces and exceptions are not.

Wrong, where `Laser` is an interface:

    struct Robot { Laser front; };

Right:

    struct Robot { TLaserData front; };
""",
)

NOT_AN_EXCEPTION = Code(
    "RC305",
    Severity.ERROR,
    "an operation throws something that is not an exception",
    """\
Behind `throws` stand exceptions, which are declared with the word `exception`.

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
    "a type cannot be the key of a dictionary",
    """\
Keys are compared, so they are whole numbers, strings, bools, enumerations, or structs of these.
Numbers with a fraction are not: two that look the same may differ in the last digit. Sequences and
dictionaries can grow.

Wrong:

    dictionary<float, string> Names;

Right:

    dictionary<int, string> Names;
""",
)

DEFAULT_TYPE = Code(
    "RC307",
    Severity.ERROR,
    "the default of a field is of another type",
    """\
A default is written as a value of the type of its field: a number, `true` or `false`, a text in
quotes, or the name of an enumerator. Other types begin empty.

Wrong:

    struct Tag { int id = "7"; };

Right:

    struct Tag { int id = 7; };
""",
)

DEFAULT_VALUE = Code(
    "RC308",
    Severity.ERROR,
    "the default of a field is not a value of its type",
    """\
The default is too large for the type, or not one of the names of the enumeration. A `byte` is 0 to
255, a `short` has 16 bits, an `int` 32, a `long` 64, all three with a sign.

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
    "an enumeration has no values",
    """\
A field of an enumeration always holds one of its values, so there must be one.

Wrong:

    enum Mode { };

Right:

    enum Mode { Idle };
""",
)

REPEATED_ENUM_VALUE = Code(
    "RC310",
    Severity.ERROR,
    "two names of an enumeration have the same value",
    """\
The wire carries the value, so the receiver could not tell the two names apart. Without a number an
enumerator has the value of the one before it plus 1.

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
Enumerations have 32 bits on the wire: the values are whole numbers from -2147483648 to 2147483647.

Wrong:

    enum Mode { Idle = 1.5 };

Right:

    enum Mode { Idle = 1 };
""",
)

ONE_WAY_OUTPUT = Code(
    "RC312",
    Severity.ERROR,
    "an operation that travels one way has an output",
    """\
A `[command]` goes to one component and a `[publish]` to all that listen; neither is answered, so
there is no result and no `out`. A `[query]` is answered.

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
    "a parameter is taken for the response of a query",
    """\
A `[query]` of two structs that returns an `int` is read as request and response, although no `out`
is written: that is how the communication patterns of RoboComp are used. Where the type of the
response is called `…resp` or `…response` this is clear and not remarked upon. `out` makes it plain.

    [query] int say(Phrase phrase, Outcome outcome);
    [query] int say(Phrase phrase, out Outcome outcome);      // the same
""",
)

TOPIC_WITH_OUTPUT = Code(
    "RC314",
    Severity.ERROR,
    "an interface that gives something back is used as a topic",
    """\
What is published goes to every subscriber and none answers. So all operations of a topic are
`void`, without `out` and without `throws`.

Wrong:

    interface Laser { TLaserData getLaserData(); };
    Component base { Communications { publishes Laser; }; language Python; };

Right:

    interface LaserPub { void pushLaserData(TLaserData scan); };
    Component base { Communications { publishes LaserPub; }; language Python; };
""",
)

PATTERN_AND_ROLE = Code(
    "RC315",
    Severity.ERROR,
    "an operation is marked for another role",
    """\
A `[command]` or `[query]` has one receiver, which implements it; a `[publish]` has any number,
which subscribe to it. The mark of an operation and the role of the port must agree. Operations
without a mark fit their role.

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
    "an interface mixes operations that are called and operations that are published",
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
    "a type is too deep or too large",
    """\
A type nests at most 64 types, and without counting what its sequences hold, one value of it
consists of at most 100000 built-in values. What people write is far below; a program that writes
interfaces can go wrong.

Wrong: a struct of 10 structs of 10 structs of 10 structs of 10 structs of 100 floats.

Right: a `sequence<float>`.
""",
)

UNIT_WITHOUT_NUMBER = Code(
    "RC318",
    Severity.WARNING,
    "something that is not a number has a unit",
    """\
A unit in brackets tells what a number counts. Strings, bools and enumerations count nothing.

Wrong:

    string name [mm];

Right:

    float width [mm];
""",
)

UNIT_CASE = Code(
    "RC319",
    Severity.WARNING,
    "a unit is not written as usual",
    """\
Units are documentation and any is accepted, but upper and lower case make another unit of some:
`mm` and `Mm`, `s` and `S`. The symbols of the International System are used where they exist.

Wrong:

    float rate [hz];

Right:

    float rate [Hz];
""",
)

UNHEARD_EXCEPTION = Code(
    "RC320",
    Severity.WARNING,
    "the exception of an operation that travels one way reaches nobody",
    """\
A `[command]` and a `[publish]` are not answered, so an exception that the implementation raises
ends in its log, whether it is declared or not. As a `[query]` the operation is answered, also when
it has no result, and the exception arrives at the caller.

Of no use:

    [command] void setSpeed(Speed speed) throws HardwareFailed;

Better:

    [query] void setSpeed(Speed speed) throws HardwareFailed;
    [command] void setSpeed(Speed speed);
""",
)
