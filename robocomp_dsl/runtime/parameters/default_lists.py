"""Writes default lists into a tree before single elements of them are overridden.

In: the tree of a configuration, the schema, overrides such as `weights[2]=0.5`. Out: the tree, in
which a list that is not given, but has an element overridden, has its default.
"""

from __future__ import annotations

from collections.abc import Iterable

from robocomp_dsl.finding import Location, SourceText
from robocomp_dsl.runtime.parameters.overrides import SOURCE_NAME, parse_path, set_node
from robocomp_dsl.runtime.parameters.schema import Element, Group, Parameter, Schema
from robocomp_dsl.runtime.parameters.tree import Items, Mapping, Node, Scalar, TextSyntax


def with_default_lists(root: Mapping, schema: Schema, overrides: Iterable[str]) -> Mapping:
    """`root` with the default of each list of which an element is overridden."""
    for written in overrides:
        path = parse_path(written.partition("=")[0].strip())
        if path is None or not isinstance(path[-1], int):
            continue
        parameter = _list_at(schema, path[:-1])
        if parameter is None or not parameter.default or _find(root, path[:-1]) is not None:
            continue
        key = Location(SourceText(SOURCE_NAME, (written,)), 1, 1)
        default = parameter.default
        values = [] if isinstance(default, Element) else [_scalar(key, value) for value in default]
        root = set_node(root, path[:-1], key, Items(key, [*values]), [])
    return root


def _list_at(schema: Schema, path: list[str | int]) -> Parameter | None:
    """The list of values at a path of names and of positions in lists of groups."""
    entry: Parameter | Group | None = None
    for step in path:
        if isinstance(step, int):
            continue
        entry = next((known for known in schema if known.name == step), None)
        schema = entry.type.SCHEMA if isinstance(entry, Group) else ()
    return entry if isinstance(entry, Parameter) and entry.is_list else None


def _find(root: Node, path: list[str | int]) -> Node | None:
    node: Node | None = root
    for step in path:
        if isinstance(step, int):
            inside = isinstance(node, Items) and step < len(node.items)
            node = node.items[step] if isinstance(node, Items) and inside else None
        else:
            member = node.members.get(step) if isinstance(node, Mapping) else None
            node = member.value if member else None
    return node


def _scalar(place: Location, value: Element) -> Scalar:
    text = str(value).lower() if isinstance(value, bool) else str(value)
    return Scalar(place, text, TextSyntax.RAW)
