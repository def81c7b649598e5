"""RC1xx, first part: what is not the form of the languages."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNEXPECTED = Code(
    "RC100",
    Severity.ERROR,
    "something else was expected here",
    """\
The text does not follow the grammar at this place. The message says what may stand here. Reading
goes on behind the next `;` or before the next `}`, so what else is wrong is shown in the same run.

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
    "a character has no meaning here",
    """\
Names consist of the letters A to Z, digits and `_`. Outside of texts and comments there are only a
few signs besides.

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
    "this is not a name",
    """\
A name consists of the letters A to Z, digits and `_`, and does not begin with a digit. It becomes a
name in generated code, which knows no others.

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
Every statement and every block ends with `;`. Where a line or block ends as well, nothing is in
doubt and a missing `;` is but a warning (RC150); within a line it is an error.

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

MISSING_SIGN = Code(
    "RC104",
    Severity.ERROR,
    "a sign is missing",
    """\
With the sign that the message names, the text makes sense.

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
Every `{` needs a `}`, and a `;` behind it. The note shows the innermost block that is still open
where something comes that cannot stand in it; the missing `}` may belong to a block inside of it.

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

UNCLOSED_TEXT = Code(
    "RC106",
    Severity.ERROR,
    "a text has no closing quote",
    """\
A text stands between double quotes in one line.

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
A comment that begins with `/*` ends with `*/`. Without it the rest of the file is a comment.

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

UNQUOTED_TEXT = Code(
    "RC108",
    Severity.ERROR,
    "a text stands in quotes",
    """\
Names of files, commands and addresses are texts and stand in double quotes.

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
    "a text stands in double quotes",
    """\
Single quotes and the typographic ones of a word processor are not quotes here.

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

MISSPELT_KEYWORD = Code(
    "RC110",
    Severity.ERROR,
    "this is no keyword",
    """\
A word stands where only a keyword may stand, and it is close to one.

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
In IDSL case counts. In CDSL, PDSL and DDSL it does not.

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

UNKNOWN_WORD = Code(
    "RC112",
    Severity.ERROR,
    "there is no such word in this place",
    """\
In some places only a few words may stand: `language` knows `Cpp`, `Cpp11` and `Python`, `gui` knows
`QWidget`, `QMainWindow` and `QDialog`, `options` knows `agmagent`, `InnerModelViewer` and `dsr`; a
pattern is `command`, `query` or `publish`; a unit of time is `ms`, `s`, `min` or `h`.

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

REPEATED = Code(
    "RC113",
    Severity.ERROR,
    "something is given twice",
    """\
Of what a file or block has but one, the first is used and the second is reported, because nobody
can tell which one was meant.

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
    "this belongs into another block",
    """\
Declarations belong into a module, operations into an interface, the lists of interfaces into
Communications.

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
    "this is not how IDSL names a container",
    """\
IDSL has sequences and dictionaries, and each needs a name of its own before it can be used: the
name is what the class in generated code is called.

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
Neither interfaces nor structs nor exceptions extend others. Repeat the members, or let a component
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

MERGE_MARK = Code(
    "RC117",
    Severity.ERROR,
    "a merge was never finished",
    """\
The lines `<<<<<<<`, `=======` and `>>>>>>>` are what git leaves where two versions of a file
contradict each other. Keep one version and delete the marks. Until then the first version is read.

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

TEXT_BEHIND_END = Code(
    "RC118",
    Severity.ERROR,
    "there is text behind the end of the block",
    """\
The block that the file is about has ended, but the text goes on. Mostly a `}` too many ended it too
early.

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
