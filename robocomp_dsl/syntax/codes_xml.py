"""The findings about the form of InnerModel files."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

XML_TAG = Code(
    "RC180",
    Severity.ERROR,
    "a tag or attribute is not written as XML has it",
    """\
A tag is `<name attribute="value" …>` or ends in `/>`; values stand in quotes, attributes have
spaces between them. Inside a value `<` and `&` are written `&lt;` and `&amp;`.

Wrong:

    <transform id="base tx=100 />

Right:

    <transform id="base" tx="100"/>
""",
)

XML_DUPLICATE = Code(
    "RC181",
    Severity.ERROR,
    "an attribute is given twice",
    """\
XML allows each attribute once in a tag. The first one is used until it is decided which is meant.

Wrong:

    <transform id="arm" tx="100" tx="200"/>

Right:

    <transform id="arm" tx="200"/>
""",
)

XML_NESTING = Code(
    "RC182",
    Severity.ERROR,
    "opening and closing tags do not fit together",
    """\
Each tag that ends in `>` is closed by one of the same name, the last opened first.

Wrong:

    <transform id="arm"> <joint id="elbow"> </transform> </joint>

Right:

    <transform id="arm"> <joint id="elbow"> </joint> </transform>
""",
)

XML_ROOT = Code(
    "RC183",
    Severity.ERROR,
    "the file is not one element",
    """\
Everything stands in one outermost element.

Right:

    <innerModel>
        <transform id="world"/>
    </innerModel>
""",
)

XML_TEXT = Code(
    "RC184",
    Severity.WARNING,
    "text between tags means nothing",
    """\
InnerModel is made of tags and attributes; other words are only allowed in comments.

Wrong:

    <transform id="arm"> the left one </transform>

Right:

    <transform id="arm"> <!-- the left one --> </transform>
""",
)

XML_DOCTYPE = Code(
    "RC185",
    Severity.WARNING,
    "a document type is not read",
    """\
InnerModel has no document type, and no entities but `&amp;`, `&lt;`, `&gt;`, `&quot;` and `&apos;`.
What is declared in a `<!DOCTYPE …>` is read over.
""",
)

XML_REPEATED = Code(
    "RC186",
    Severity.WARNING,
    "an attribute is given twice, with the same value",
    """\
XML allows each attribute once in a tag, and RoboComp does not read a file where one is repeated.
What is meant is clear here: the second one is removed by `rcgen check --fix`.

Wrong:

    <transform id="arm" tx="100" tx="100"/>

Right:

    <transform id="arm" tx="100"/>
""",
)

XML_COMMENT = Code(
    "RC187",
    Severity.WARNING,
    "`--` inside of a comment",
    """\
A comment of XML ends with the first `-->`, and no other `--` may stand in it: RoboComp does not
read such a file. So a comment cannot hold another one, and what stands behind the end of the inner
one is no comment any more.

Wrong:

    <!-- the arm -- not used -->

Right:

    <!-- the arm, not used -->
""",
)
