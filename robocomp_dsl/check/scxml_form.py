"""Whether elements and attributes are SCXML's, and where they may stand.

In: the tree of a file. Out: findings; nothing is left out without one.
"""

from __future__ import annotations

from robocomp_dsl.check import codes
from robocomp_dsl.check.scxml_tags import TAGS, Tag
from robocomp_dsl.diagnostics import Report, did_you_mean
from robocomp_dsl.syntax.ast_innermodel import Element

_LAYOUT = ("qt", "viz")
"""Prefixes under which editors keep where they draw a state."""
_OF_XML = ("xmlns", "xml", "xsi")


def local(element: Element) -> str:
    """The name of a tag without the prefix of SCXML's own namespace."""
    prefix, colon, name = element.tag.text.rpartition(":")
    return name if colon and prefix in ("sc", "scxml") else element.tag.text


def judge_form(root: Element, report: Report) -> None:
    """Report what is not SCXML in `root` and all that it holds."""
    todo = [root]
    while todo:
        element = todo.pop()
        tag = TAGS[local(element)]
        _attributes(element, tag, report)
        if tag.unused:
            said = f"`<{element.tag.text}>` is read but does nothing"
            report.add(codes.SCXML_UNUSED, element.tag.span, said, label=tag.unused)
        if tag.opaque:
            continue
        if not tag.text:
            _texts(element, report)
        todo.extend(child for child in element.children if _stands(child, element, tag, report))


def _stands(child: Element, around: Element, tag: Tag, report: Report) -> bool:
    name, written = local(child), child.tag.text
    if name in tag.holds:
        return True
    if ":" in name:
        if name.partition(":")[0] not in _LAYOUT:
            said = f"`<{written}>` is an extension that is not known here"
            report.add(codes.SCXML_UNUSED, child.tag.span, said, label="it does nothing")
        return False
    known = name in TAGS
    said = (
        f"`<{written}>` does not stand in `<{around.tag.text}>`"
        if known
        else f"SCXML has no tag `<{written:.60}>`"
    )
    listed = ", ".join(f"`{one}`" for one in tag.holds)
    report.add(
        codes.SCXML_TAG,
        child.tag.span,
        said,
        label=("" if known else did_you_mean(name, tag.holds)) or "it is left out",
        help=f"`<{around.tag.text}>` holds {listed}" if listed else "nothing may stand there",
    )
    return False


def _attributes(element: Element, tag: Tag, report: Report) -> None:
    for one in element.attributes:
        name = one.name.text
        if name in tag.attributes or name.partition(":")[0] in (*_OF_XML, *_LAYOUT):
            continue
        report.add(
            codes.SCXML_TAG,
            one.name.span,
            f"`{element.tag.text}` has no attribute `{name:.60}`",
            label=did_you_mean(name, tag.attributes) or "it is not used",
            help="it has " + (", ".join(f"`{n}`" for n in tag.attributes) or "none"),
        )


def _texts(element: Element, report: Report) -> None:
    for text in element.texts:
        said = f"text in `<{element.tag.text}>` means nothing"
        report.add(codes.SCXML_UNUSED, text.span, said, help="make it a comment: `<!-- … -->`")
