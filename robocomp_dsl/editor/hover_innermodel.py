"""Hover in InnerModel: what a tag or an attribute means.

In: a place. Out: words and their range.
"""

from __future__ import annotations

from robocomp_dsl.editor import innermodel_words as known
from robocomp_dsl.editor.names_innermodel import elements
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast_innermodel import Element, File


def words_at(tree: File, offset: int) -> tuple[Span, str] | None:
    """What is said of the tag or attribute at `offset`; None where there is neither."""
    for one in elements(tree.root):
        if one.span.start <= offset <= one.span.end:
            found = _in_tag(one, offset)
            if found and found[1]:
                return found
    return None


def _in_tag(one: Element, offset: int) -> tuple[Span, str] | None:
    tag = one.tag
    if _touches(tag.span, offset):
        return tag.span, f"```xml\n<{tag.text}>\n```\n\n{known.about_tag(tag.text)}"
    for attribute in one.attributes:
        if _touches(attribute.span, offset):
            return attribute.span, known.about_attribute(tag.text, attribute.name.text)
    return None


def _touches(span: Span, offset: int) -> bool:
    return span.start <= offset <= span.end
