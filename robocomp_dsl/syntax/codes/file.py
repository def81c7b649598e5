"""RC0xx: findings about a file as a whole."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNREADABLE = Code(
    "RC001",
    Severity.ERROR,
    "the file cannot be read",
    """\
The file is missing, is a folder, is larger than 4 MB, is binary, or is not encoded in UTF-8. Open
it in an editor and save it as UTF-8.
""",
)

NO_DECLARATION = Code(
    "RC002",
    Severity.ERROR,
    "the file contains no description",
    """\
Every file contains one top-level block: an IDSL file a module, a CDSL file a component, a PDSL file
a block of parameters, a DDSL file a deployment, a BDSL file a bridge.

Wrong:

    import "Laser.idsl";

Right:

    import "Laser.idsl";
    Component scanner
    {
        Communications { requires Laser; };
        language Python;
    };
""",
)

WRONG_LANGUAGE = Code(
    "RC003",
    Severity.ERROR,
    "the language of the file does not match its suffix",
    """\
The suffix of a file names its language: `.idsl` interfaces, `.cdsl` a component, `.pdsl` its
parameters, `.ddsl` a deployment, `.bdsl` a bridge. Rename the file.
""",
)

TOO_MANY_FINDINGS = Code(
    "RC004",
    Severity.WARNING,
    "too many findings in one file",
    """\
After 100 errors the rest of the file is skipped; after 100 warnings further warnings are not
listed. Usually one early mistake causes most of them, or the file is in another language.
""",
)

NESTED_TOO_DEEPLY = Code(
    "RC005",
    Severity.ERROR,
    "blocks are nested too deeply",
    """\
Blocks may be nested about 100 deep. Check for a missing `}` or for generated text.
""",
)

UNRECOVERABLE = Code(
    "RC006",
    Severity.ERROR,
    "too many syntax errors",
    """\
After an error, 100 000 tokens followed without the end of a statement or block; the rest of the
file is skipped. The file is in another language, or a string or comment in it has no end.
""",
)
