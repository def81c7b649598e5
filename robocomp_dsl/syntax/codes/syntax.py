"""RC10x and RC11x: syntax errors."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNEXPECTED = Code(
    "RC100",
    Severity.ERROR,
    "unexpected token",
    """\
The text does not match the grammar. The message lists what is allowed here. Parsing continues after
the next `;` or before the next `}`, so further errors are reported in the same run.

Wrong:

    module RoboCompLaser
    {
        struct { float dist; };
    };

Right:

    module RoboCompLaser
    {
        struct TData { float dist; };
    };
""",
)

STRAY_CHARACTER = Code(
    "RC101",
    Severity.ERROR,
    "invalid character",
    """\
Names consist of the letters A to Z, digits and `_`. Outside strings and comments, only a few
punctuation characters are allowed besides names.

Wrong:

    module RoboCompLaser
    {
        sequence<float> Scan; $
    };

Right:

    module RoboCompLaser
    {
        sequence<float> Scan;
    };
""",
)

BAD_NAME = Code(
    "RC102",
    Severity.ERROR,
    "invalid name",
    """\
A name consists of the letters A to Z, digits and `_`, and does not begin with a digit, because
generated code uses it as an identifier.

Wrong:

    Component my-robot
    {
        Communications { };
        language Python;
    };

Right:

    Component my_robot
    {
        Communications { };
        language Python;
    };
""",
)

MISSING_SEMICOLON = Code(
    "RC103",
    Severity.ERROR,
    "a `;` is missing",
    """\
Every statement and every block ends with `;`. At the end of a line or block a missing `;` is only a
warning (RC150); within a line it is an error.

Wrong:

    module RoboCompBase
    {
        struct Pose { float x float y; };
    };

Right:

    module RoboCompBase
    {
        struct Pose { float x; float y; };
    };
""",
)

MISSING_PUNCTUATION = Code(
    "RC104",
    Severity.ERROR,
    "missing punctuation",
    """\
The text is valid if you add the punctuation that the message names.

Wrong:

    module RoboCompBase
    {
        interface Base { void move(float x float y); };
    };

Right:

    module RoboCompBase
    {
        interface Base { void move(float x, float y); };
    };
""",
)

UNCLOSED_BLOCK = Code(
    "RC105",
    Severity.ERROR,
    "a block is not closed",
    """\
Every `{` needs a `};`. The note shows the innermost block that is open at a statement that is not
allowed in it; the missing `}` may belong to a nested block.

Wrong:

    module RoboCompBase
    {
        struct Pose { float x;

        interface Base { Pose where(); };
    };

Right:

    module RoboCompBase
    {
        struct Pose { float x; };

        interface Base { Pose where(); };
    };
""",
)

UNCLOSED_STRING = Code(
    "RC106",
    Severity.ERROR,
    "a string has no closing quote",
    """\
A string is enclosed in double quotes on one line.

Wrong:

    import "Laser.idsl;
    Component scanner
    {
        Communications { requires Laser; };
        language Python;
    };

Right:

    import "Laser.idsl";
    Component scanner
    {
        Communications { requires Laser; };
        language Python;
    };
""",
)

UNCLOSED_COMMENT = Code(
    "RC107",
    Severity.ERROR,
    "a comment is never closed",
    """\
A comment that begins with `/*` ends with `*/`. Without `*/` the rest of the file is a comment.

Wrong:

    module RoboCompBase
    {
        /* where the robot is
        struct Pose { float x; };
    };

Right:

    module RoboCompBase
    {
        /* where the robot is */
        struct Pose { float x; };
    };
""",
)

UNQUOTED_STRING = Code(
    "RC108",
    Severity.ERROR,
    "missing quotes around a string",
    """\
File names, commands and addresses are strings: write them in double quotes.

Wrong:

    import Laser.idsl;
    Component scanner
    {
        Communications { requires Laser; };
        language Python;
    };

Right:

    import "Laser.idsl";
    Component scanner
    {
        Communications { requires Laser; };
        language Python;
    };
""",
)

WRONG_QUOTES = Code(
    "RC109",
    Severity.ERROR,
    "wrong quotes around a string",
    """\
Strings use double quotes. Single quotes and the typographic quotes of a word processor are invalid.

Wrong:

    import 'Laser.idsl';
    Component scanner
    {
        Communications { requires Laser; };
        language Python;
    };

Right:

    import "Laser.idsl";
    Component scanner
    {
        Communications { requires Laser; };
        language Python;
    };
""",
)

MISSPELLED_KEYWORD = Code(
    "RC110",
    Severity.ERROR,
    "misspelled keyword",
    """\
Only a keyword is allowed here, and this identifier resembles one.

Wrong:

    import "Laser.idsl";
    Component scanner
    {
        Communications { reqires Laser; };
        language Python;
    };

Right:

    import "Laser.idsl";
    Component scanner
    {
        Communications { requires Laser; };
        language Python;
    };
""",
)

KEYWORD_CASE = Code(
    "RC111",
    Severity.ERROR,
    "the keywords of IDSL are written in lower case",
    """\
IDSL is case-sensitive. The other languages are not.

Wrong:

    Module RoboCompBase
    {
        struct Pose { float x; };
    };

Right:

    module RoboCompBase
    {
        struct Pose { float x; };
    };
""",
)

UNKNOWN_CHOICE = Code(
    "RC112",
    Severity.ERROR,
    "unknown value for a setting",
    """\
Some settings accept only a few values: `language` accepts `Cpp`, `Cpp11` and `Python`; `gui`
accepts `QWidget`, `QMainWindow` and `QDialog`; `options` accepts `agmagent`, `InnerModelViewer` and
`dsr`; a pattern is `command`, `query` or `publish`; a unit of time is `ms`, `s`, `min` or `h`.

Wrong:

    Component scanner
    {
        Communications { };
        language Pyton;
    };

Right:

    Component scanner
    {
        Communications { };
        language Python;
    };
""",
)

DUPLICATE = Code(
    "RC113",
    Severity.ERROR,
    "duplicate statement",
    """\
This statement may occur once in a file or block. The first one is used; delete the wrong one.

Wrong:

    Component scanner
    {
        Communications { };
        language Python;
        period 20;
        period 50;
    };

Right:

    Component scanner
    {
        Communications { };
        language Python;
        period 20;
    };
""",
)

MISPLACED = Code(
    "RC114",
    Severity.ERROR,
    "this belongs in another block",
    """\
Declarations belong in a module, operations in an interface, lists of interfaces in
`Communications`.

Wrong:

    module RoboCompBase
    {
        void stop();
    };

Right:

    module RoboCompBase
    {
        interface Base { void stop(); };
    };
""",
)

TEMPLATE_TYPE = Code(
    "RC115",
    Severity.ERROR,
    "container type of another language",
    """\
IDSL has sequences and dictionaries. Declare each with a name before you use it: the class in
generated code has this name.

Wrong:

    module RoboCompSpeech
    {
        struct Phrase { string text; };
        vector<Phrase> Phrases;
    };

Right:

    module RoboCompSpeech
    {
        struct Phrase { string text; };
        sequence<Phrase> Phrases;
    };
""",
)

INHERITANCE = Code(
    "RC116",
    Severity.ERROR,
    "IDSL has no inheritance",
    """\
Interfaces, structs and exceptions cannot extend others. Repeat the members, or let a component
implement several interfaces.

Wrong:

    module RoboCompBase
    {
        interface Base { void stop(); };
        interface OmniBase extends Base { void strafe(float speed); };
    };

Right:

    module RoboCompBase
    {
        interface Base { void stop(); };
        interface OmniBase { void strafe(float speed); };
    };
""",
)

MERGE_CONFLICT = Code(
    "RC117",
    Severity.ERROR,
    "unresolved merge conflict",
    """\
git writes the lines `<<<<<<<`, `=======` and `>>>>>>>` where two versions of a file conflict. Keep
one version and delete the conflict markers. Until then the first version is used.

Wrong:

    module RoboCompBase
    {
    <<<<<<< HEAD
        struct Pose { float x; };
    =======
        struct Pose { double x; };
    >>>>>>> other
    };

Right:

    module RoboCompBase
    {
        struct Pose { double x; };
    };
""",
)

TEXT_AFTER_END = Code(
    "RC118",
    Severity.ERROR,
    "text after the end of the top-level block",
    """\
The top-level block of the file has ended, but more text follows. Usually an extra `}` ended the
block too early.

Wrong:

    Component scanner
    {
        Communications { }; };
        language Python;
        period 20;
    };

Right:

    Component scanner
    {
        Communications { };
        language Python;
        period 20;
    };
""",
)
