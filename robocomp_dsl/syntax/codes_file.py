"""RC0xx: findings about a file as such."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNREADABLE = Code(
    "RC001",
    Severity.ERROR,
    "the file cannot be read",
    """\
The file is missing, is a folder, is larger than 4 MB, is no text, or is a text in another encoding
than UTF-8. Open it in an editor and save it as UTF-8.
""",
)

NOTHING_IN_FILE = Code(
    "RC002",
    Severity.ERROR,
    "the file describes nothing",
    """\
Every file has one block that it is about: an IDSL file a module, a CDSL file a component, a PDSL
file a block of parameters, a DDSL file a deployment.

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
    "the file is written in another language than its name says",
    """\
The suffix of a file says what it describes: `.idsl` interfaces, `.cdsl` a component, `.pdsl` its
parameters, `.ddsl` a deployment. Rename the file.
""",
)

TOO_MANY = Code(
    "RC004",
    Severity.WARNING,
    "there are more findings than anyone reads",
    """\
After a hundred errors a file is not read any further; after a hundred warnings further ones are not
listed. Mostly one early mistake is behind them, or the file is no description at all.
""",
)

TOO_DEEP = Code(
    "RC005",
    Severity.ERROR,
    "blocks are nested too deeply",
    """\
About a hundred blocks inside one another are more than any description needs.
""",
)

GARBAGE = Code(
    "RC006",
    Severity.ERROR,
    "the file makes no sense",
    """\
After an error a hundred thousand words and signs followed without one that a statement or block
could end with. The file is no description, or a text or comment without an end is in it.
""",
)
