"""Checks the elements and attributes of SCXML files and their nesting.

In: the tree of a file. Out: diagnostics for everything that is ignored.
"""

from __future__ import annotations

from robocomp_dsl.check.codes import states as codes
from robocomp_dsl.check.states.scxml_tags import TAGS, ScxmlTag
from robocomp_dsl.diagnostics import Report, did_you_mean
from robocomp_dsl.syntax.ast.innermodel import Element

_LAYOUT = ("qt", "viz")
"""Namespace prefixes of editors for the drawing positions of states."""
_OF_XML = ("xmlns", "xml", "xsi")


def local_name(element: Element) -> str:
    """The name of a tag without the prefix of SCXML's own namespace."""
    prefix, colon, name = element.tag.text.rpartition(":")
    return name if colon and prefix in ("sc", "scxml") else element.tag.text


def check_elements(root: Element, report: Report) -> None:
    """Report everything in `root` and its descendants that is not valid SCXML."""
    todo = [root]
    while todo:
        element = todo.pop()
        tag = TAGS[local_name(element)]
        _attributes(element, tag, report)
        if tag.unused:
            message = f"`<{element.tag.text}>` has no effect"
            report.add(codes.SCXML_UNUSED, element.tag.span, message, label=tag.unused)
        if tag.opaque:
            continue
        if not tag.text:
            _texts(element, report)
        todo.extend(child for child in element.children if _is_allowed(child, element, tag, report))


def _is_allowed(child: Element, around: Element, tag: ScxmlTag, report: Report) -> bool:
    name, written = local_name(child), child.tag.text
    if name in tag.holds:
        return True
    if ":" in name:
        if name.partition(":")[0] not in _LAYOUT:
            message = f"`<{written}>` is an unknown extension"
            report.add(codes.SCXML_UNUSED, child.tag.span, message, label="ignored")
        return False
    known = name in TAGS
    message = (
        f"`<{written}>` is not allowed in `<{around.tag.text}>`"
        if known
        else f"SCXML has no tag `<{written:.60}>`"
    )
    listed = ", ".join(f"`{tag_name}`" for tag_name in tag.holds)
    report.add(
        codes.SCXML_TAG,
        child.tag.span,
        message,
        label=("" if known else did_you_mean(name, tag.holds)) or "ignored",
        help=f"`<{around.tag.text}>` contains {listed}" if listed else "it contains no elements",
    )
    return False


def _attributes(element: Element, tag: ScxmlTag, report: Report) -> None:
    for attribute in element.attributes:
        name = attribute.name.text
        if name in tag.attributes or name.partition(":")[0] in (*_OF_XML, *_LAYOUT):
            continue
        report.add(
            codes.SCXML_TAG,
            attribute.name.span,
            f"`{element.tag.text}` has no attribute `{name:.60}`",
            label=did_you_mean(name, tag.attributes) or "ignored",
            help="it has " + (", ".join(f"`{n}`" for n in tag.attributes) or "none"),
        )


def _texts(element: Element, report: Report) -> None:
    for text in element.texts:
        message = f"text in `<{element.tag.text}>` is ignored"
        report.add(codes.SCXML_UNUSED, text.span, message, help="make it a comment: `<!-- … -->`")
