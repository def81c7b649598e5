"""RC18x: syntax errors of InnerModel and SCXML files."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

XML_TAG = Code(
    "RC180",
    Severity.ERROR,
    "a tag or attribute is not valid XML",
    """\
A tag is `<name attribute="value" …>` or ends in `/>`; values are quoted, and spaces separate the
attributes. Inside a value write `&lt;` for `<` and `&amp;` for `&`.

Wrong:

    <transform id="base tx=100 />

Right:

    <transform id="base" tx="100"/>
""",
)

XML_DUPLICATE = Code(
    "RC181",
    Severity.ERROR,
    "an attribute is repeated with another value",
    """\
XML allows each attribute once per tag. The first value is used; delete the wrong one.

Wrong:

    <transform id="arm" tx="100" tx="200"/>

Right:

    <transform id="arm" tx="200"/>
""",
)

XML_NESTING = Code(
    "RC182",
    Severity.ERROR,
    "opening and closing tags do not match",
    """\
Each opening tag has a closing tag of the same name; the tag that was opened last is closed first.

Wrong:

    <transform id="arm"> <joint id="elbow"> </transform> </joint>

Right:

    <transform id="arm"> <joint id="elbow"> </joint> </transform>
""",
)

XML_ROOT = Code(
    "RC183",
    Severity.ERROR,
    "the file does not have exactly one root element",
    """\
An XML file has one root element that contains all others.

Right:

    <innerModel>
        <transform id="world"/>
    </innerModel>
""",
)

XML_TEXT = Code(
    "RC184",
    Severity.WARNING,
    "text between tags is ignored",
    """\
InnerModel consists of tags and attributes; write other text in comments.

Wrong:

    <transform id="arm"> the left one </transform>

Right:

    <transform id="arm"> <!-- the left one --> </transform>
""",
)

XML_DOCTYPE = Code(
    "RC185",
    Severity.WARNING,
    "a document type is ignored",
    """\
InnerModel has no document type; the only entities are `&amp;`, `&lt;`, `&gt;`, `&quot;` and
`&apos;`. Declarations in `<!DOCTYPE …>` are ignored.
""",
)

XML_DUPLICATE_SAME_VALUE = Code(
    "RC186",
    Severity.WARNING,
    "an attribute is repeated with the same value",
    """\
XML allows each attribute once per tag, and RoboComp rejects a file with a repeated attribute. Both
values are equal, so `rcgen check --fix` removes the second attribute.

Wrong:

    <transform id="arm" tx="100" tx="100"/>

Right:

    <transform id="arm" tx="100"/>
""",
)

XML_COMMENT = Code(
    "RC187",
    Severity.WARNING,
    "`--` inside a comment",
    """\
An XML comment ends at the first `-->` and must not contain another `--`; RoboComp rejects such a
file. Comments do not nest: the text after the end of the inner comment is not part of a comment.

Wrong:

    <!-- the arm -- not used -->

Right:

    <!-- the arm, not used -->
""",
)
