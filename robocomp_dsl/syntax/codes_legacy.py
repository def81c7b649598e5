"""RC1xx, second part: forms that files of older tools have, understood and to be updated."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

LEGACY_SEMICOLON = Code(
    "RC150",
    Severity.WARNING,
    "a `;` is missing",
    """\
Every statement and every block ends with `;`. Here the line or block ends as well, so the text is
understood without it.

Wrong:

    import "Laser.idsl"
    Component scanner
    {
        Communications { requires Laser; };
        language Python;
    }

Right:

    import "Laser.idsl";
    Component scanner
    {
        Communications { requires Laser; };
        language Python;
    };
""",
)

EMPTY_STATEMENT = Code(
    "RC151",
    Severity.WARNING,
    "a `;` ends nothing",
    """\
One `;` ends a statement; a second one has nothing to end. Older tools left one behind where a
component has no options.

Wrong:

    module RoboCompBase
    {
        struct Pose { float x;; };
    };

Right:

    module RoboCompBase
    {
        struct Pose { float x; };
    };
""",
)

TRAILING_COMMA = Code(
    "RC152",
    Severity.WARNING,
    "nothing follows a comma",
    """\
A comma stands between the items of a list, and not behind the last one.

Wrong:

    module RoboCompBase
    {
        enum State { Idle, Moving, };
    };

Right:

    module RoboCompBase
    {
        enum State { Idle, Moving };
    };
""",
)

STRAY_TEXT = Code(
    "RC153",
    Severity.WARNING,
    "a few words stand behind the end",
    """\
Older tools read nothing behind the end of the block, so leftovers went unnoticed there.

Wrong:

    module RoboCompBase
    {
        struct Pose { float x; };
    };
    };

Right:

    module RoboCompBase
    {
        struct Pose { float x; };
    };
""",
)

HASH_COMMENT = Code(
    "RC154",
    Severity.WARNING,
    "a comment begins with `//`",
    """\
Lines that begin with `#` are read over, as some older tools did, whether they are comments or what
a preprocessor would read.

Wrong:

    module RoboCompBase
    {
        # where the robot is
        struct Pose { float x; };
    };

Right:

    module RoboCompBase
    {
        // where the robot is
        struct Pose { float x; };
    };
""",
)

NO_RESULT = Code(
    "RC155",
    Severity.WARNING,
    "an operation does not say what it returns",
    """\
Every operation begins with the type of what it returns, or with `void`.

Wrong:

    module RoboCompSpeech
    {
        interface Speech { flush(); };
    };

Right:

    module RoboCompSpeech
    {
        interface Speech { void flush(); };
    };
""",
)

UNNAMED_PARAMETER = Code(
    "RC156",
    Severity.WARNING,
    "a parameter has no name",
    """\
The name of a parameter is its name in generated code. One without is called `arg1`, `arg2`, … by
its place. An operation without parameters has empty parentheses.

Wrong:

    module RoboCompSpeech
    {
        interface Speech { bool say(string); };
    };

Right:

    module RoboCompSpeech
    {
        interface Speech { bool say(string text); };
    };
""",
)

PURE_VIRTUAL = Code(
    "RC157",
    Severity.WARNING,
    "`= 0` means nothing behind an operation",
    """\
In C++ it marks a method that a derived class must implement. In IDSL all operations are such.

Wrong:

    module RoboCompSpeech
    {
        interface Speech { bool say(string text) = 0; };
    };

Right:

    module RoboCompSpeech
    {
        interface Speech { bool say(string text); };
    };
""",
)

OUT_FIRST = Code(
    "RC158",
    Severity.WARNING,
    "an `out` parameter stands before an input",
    """\
Generated code takes the inputs and returns the outputs. In C++ and Slice all outputs stand behind
the inputs, so this operation would look different in each language.

Wrong:

    module RoboCompBase
    {
        interface Base { void get(out float x, int wheel); };
    };

Right:

    module RoboCompBase
    {
        interface Base { void get(int wheel, out float x); };
    };
""",
)

MEANINGLESS_WORD = Code(
    "RC159",
    Severity.WARNING,
    "a word means nothing here",
    """\
`out` marks a parameter and `idempotent` an operation; neither says anything about the other. Of the
flags behind a parameter of a component, only `live` has a meaning.

Wrong:

    module RoboCompBase
    {
        interface Base { out float speed(); };
    };

Right:

    module RoboCompBase
    {
        interface Base { float speed(); };
    };
""",
)

SEVERAL_MODULES = Code(
    "RC160",
    Severity.WARNING,
    "a file has several modules",
    """\
Files are found and imported by their names, so a file has one module. Further ones are read, but
better have files of their own.

Wrong:

    module RoboCompBase
    {
        struct Pose { float x; };
    };
    module RoboCompArm
    {
        struct Joint { float angle; };
    };

Right:

    module RoboCompBase
    {
        struct Pose { float x; };
    };
""",
)

NO_EFFECT = Code(
    "RC161",
    Severity.WARNING,
    "this has no effect any more",
    """\
The Eclipse-based generation of CDSL had the sections `RoboCompClasses` and `RoboCompModules` and
the settings `worker`, `useQt` and `qtversion`, and generated components for Android. They are read
over.

Wrong:

    Component scanner
    {
        Communications { };
        language Python;
        useQt qt4;
    };

Right:

    Component scanner
    {
        Communications { };
        language Python;
    };
""",
)

LEGACY_GUI = Code(
    "RC162",
    Severity.WARNING,
    "the window is named in an old way",
    """\
A window is named with its toolkit: `gui Qt(QWidget);`. `QFrame` became `QWidget`.

Wrong:

    Component scanner
    {
        Communications { };
        language Python;
        gui QWidget;
    };

Right:

    Component scanner
    {
        Communications { };
        language Python;
        gui Qt(QWidget);
    };
""",
)

LEGACY_STATEMACHINE = Code(
    "RC163",
    Severity.WARNING,
    "a state machine is named without its file",
    """\
A state machine is named by the file that describes it, in quotes.

Wrong:

    Component scanner
    {
        Communications { };
        language Python;
        stateMachine search;
    };

Right:

    Component scanner
    {
        Communications { };
        language Python;
        statemachine "search.smdsl";
    };
""",
)

EMPTY_LIST = Code(
    "RC164",
    Severity.WARNING,
    "a list of interfaces is empty",
    """\
What a component has no interfaces for is left out.

Wrong:

    Component scanner
    {
        Communications { requires; };
        language Python;
    };

Right:

    Component scanner
    {
        Communications { };
        language Python;
    };
""",
)

NO_COMMUNICATIONS = Code(
    "RC165",
    Severity.WARNING,
    "a component has no Communications",
    """\
Without Communications a component neither offers nor uses an interface. Where that is meant, an
empty block says so.

Wrong:

    Component scanner
    {
        language Python;
    };

Right:

    Component scanner
    {
        Communications { };
        language Python;
    };
""",
)

OLD_TRANSITIONS = Code(
    "RC166",
    Severity.WARNING,
    "the old spelling of `transitions`",
    """\
The block is called `transitions`. Other tools stop reading at the old spelling, without a word.

Wrong:

    game
    {
        initial_state waiting;
        states playing;
        transition { waiting => playing; };
    };

Right:

    game
    {
        initial_state waiting;
        states playing;
        transitions { waiting => playing; };
    };
""",
)
