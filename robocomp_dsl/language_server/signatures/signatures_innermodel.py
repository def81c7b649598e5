"""Signatures of InnerModel nodes: the tag as text. In: objects of the model. Out: text."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import fields
from typing import Any

from robocomp_dsl.check.innermodel.tags import TAGS
from robocomp_dsl.language_server.completion.innermodel_reference import format_value
from robocomp_dsl.model.innermodel import Node, children

MAX_CHILDREN = 15


def format_node(node: Node) -> str:
    """The tag without default values, in the units of the model, and its child nodes."""
    head = " ".join([f'<{node.tag} id="{node.id}"', *_attributes(node)])
    nested = children(node)
    if not nested:
        return f"{head}/>"
    lines = [f'    <{child.tag} id="{child.id}"/>' for child in nested[:MAX_CHILDREN]]
    if len(nested) > MAX_CHILDREN:
        lines.append(f"    <!-- {len(nested) - MAX_CHILDREN} more -->")
    return "\n".join([f"{head}>", *lines, f"</{node.tag}>"])


def _attributes(node: Node) -> Iterator[str]:
    kinds = TAGS[node.tag].attributes if node.tag in TAGS else {}
    for field in fields(node):
        value = getattr(node, field.name)
        if field.name in kinds and field.name != "id" and value != field.default:
            yield f'{field.name}="{format_value(value, kinds[field.name])}"'


SIGNATURES: dict[type, Callable[[Any], str]] = {
    tag.node_class: format_node for tag in TAGS.values()
}
