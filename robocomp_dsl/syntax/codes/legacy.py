"""RC15x and RC16x: outdated syntax of older tools; it is accepted with a warning."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

LEGACY_SEMICOLON = Code(
    "RC150",
    Severity.WARNING,
    "a `;` is missing",
    """\
Every statement and every block ends with `;`. The line or block ends here, so the file is accepted
without it.

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
    "a `;` is superfluous",
    """\
One `;` ends a statement; a second `;` is ignored. Older tools wrote one in components without
options.

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
    "a comma after the last item",
    """\
A comma separates the items of a list; write none after the last item.

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

TRAILING_TEXT = Code(
    "RC153",
    Severity.WARNING,
    "text after the end of the block is ignored",
    """\
Older tools ignored the text after the end of the block, so leftovers went unnoticed.

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
Lines that begin with `#` are ignored, as in some older tools, whether they are comments or
preprocessor directives.

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
    "an operation has no return type",
    """\
Every operation begins with its return type or with `void`.

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
Generated code uses the name of the parameter. A parameter without a name is called `arg1`, `arg2`,
… by its position. An operation without parameters has empty parentheses.

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
    "`= 0` after an operation is ignored",
    """\
In C++ it marks a method that a derived class must implement. In IDSL this holds for all operations.

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
    "an `out` parameter precedes an input",
    """\
Generated Python code takes the inputs and returns the outputs. In C++ and Slice all outputs follow
the inputs, so the order of this operation's parameters would differ between languages.

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

MEANINGLESS_KEYWORD = Code(
    "RC159",
    Severity.WARNING,
    "a keyword has no effect here",
    """\
`out` applies to parameters and `idempotent` to operations only. Of the flags after a component
parameter, only `live` has an effect.

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
Files are imported by name, so a file should have one module. Further modules are read; move each
to its own file.

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
    "an obsolete setting is ignored",
    """\
The Eclipse-based generation of CDSL had the sections `RoboCompClasses` and `RoboCompModules` and
the settings `worker`, `useQt` and `qtversion`, and generated components for Android. They are
ignored.

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
    "outdated syntax of `gui`",
    """\
Name the toolkit and the window class: `gui Qt(QWidget);`. `QFrame` was replaced by `QWidget`.

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
    "outdated syntax of `statemachine`",
    """\
`statemachine` takes the path of the file that describes the state machine, in quotes.

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
Omit a role for which the component has no interfaces.

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
    "a component has no `Communications` block",
    """\
Without `Communications` a component neither offers nor uses an interface. If that is intended,
write an empty block.

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

LEGACY_TRANSITIONS = Code(
    "RC166",
    Severity.WARNING,
    "outdated spelling of `transitions`",
    """\
The block is called `transitions`. Other tools silently stop reading at the outdated spelling.

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
