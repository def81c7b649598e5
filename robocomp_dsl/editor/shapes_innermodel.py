"""Nodes of a body as the tag that says the same. In: objects of the model. Out: text."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import fields
from typing import Any

from robocomp_dsl.check.innermodel_tags import TAGS
from robocomp_dsl.editor.innermodel_words import written
from robocomp_dsl.model.body import Node, children

MOST_CHILDREN = 15


def node(one: Node) -> str:
    """The tag without defaults, in units of the model, and what stands in it."""
    head = " ".join([f'<{one.tag} id="{one.id}"', *_given(one)])
    inside = children(one)
    if not inside:
        return f"{head}/>"
    lines = [f'    <{child.tag} id="{child.id}"/>' for child in inside[:MOST_CHILDREN]]
    if len(inside) > MOST_CHILDREN:
        lines.append(f"    <!-- {len(inside) - MOST_CHILDREN} more -->")
    return "\n".join([f"{head}>", *lines, f"</{one.tag}>"])


def _given(one: Node) -> Iterator[str]:
    kinds = TAGS[one.tag].attributes if one.tag in TAGS else {}
    for field in fields(one):
        value = getattr(one, field.name)
        if field.name in kinds and field.name != "id" and value != field.default:
            yield f'{field.name}="{written(value, kinds[field.name])}"'


SHAPES: dict[type, Callable[[Any], str]] = {tag.made: node for tag in TAGS.values()}
