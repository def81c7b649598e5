"""Write parameters as PDSL, and the values of a configuration as commented YAML.

In: the parameters of `infer`. Out: the two texts.
"""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.generate import literals
from robocomp_dsl.migrate.infer import (
    InferredGroup,
    ListParameter,
    ParameterTree,
    ParameterValues,
    ScalarParameter,
)
from robocomp_dsl.model.parameter import Kind
from robocomp_dsl.model.types import Literal

STEP = "    "
WIDTH = 100
"""Longer lists have a line for each value."""
_KIND_DESCRIPTIONS = {
    Kind.STRING: "a string",
    Kind.INT: "a whole number",
    Kind.FLOAT: "a number",
    Kind.BOOL: "true or false",
}


def pdsl_text(name: str, tree: ParameterTree, source: str) -> str:
    """The PDSL file; `source` names the origin of the parameters."""
    head = f"/** The parameters of {name}; types and defaults are those of {_doc(source)}. */"
    rows = [head, f"ComponentParams {name}", "{", *_pdsl(tree, STEP), "};"]
    return "\n".join(rows) + "\n"


def _pdsl(tree: ParameterTree, indent: str) -> Iterator[str]:
    for node in tree:
        if isinstance(node, InferredGroup):
            yield f"{indent}{node.name}"
            yield from _block(list(_pdsl(node.members, indent + STEP)), indent)
            continue
        if node.doc.strip():
            yield from _doc_rows(node.doc, indent)
        if isinstance(node, ListParameter):
            yield f"{indent}{node.name}[] {node.kind.value};"
        else:
            default = "" if node.default is None else f" {_pdsl_value(node.default)}"
            yield f"{indent}{node.name} {node.kind.value}{default};"


def _block(rows: list[str], indent: str) -> Iterator[str]:
    yield f"{indent}{{"
    yield from rows
    yield f"{indent}}};"


def _doc_rows(text: str, indent: str) -> Iterator[str]:
    rows = [_doc(row) for row in literals.lines(text)]
    if len(rows) == 1:
        yield f"{indent}/** {rows[0]} */"
        return
    yield f"{indent}/**"
    yield from (f"{indent} * {row}".rstrip() for row in rows)
    yield f"{indent} */"


def _doc(text: str) -> str:
    return text.replace("*/", "* /").replace("/*", "/ *")


def _pdsl_value(value: Literal) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        inner = value.replace("\\", "\\\\").replace('"', '\\"')
        return '"' + inner.replace("\n", "\\n").replace("\t", "\\t").replace("\r", "\\r") + '"'
    return repr(value)


def yaml_text(name: str, tree: ParameterTree, values: ParameterValues, source: str) -> str:
    """The configuration with the values of one file, and defaults for missing ones."""
    head = f"# Configuration of {literals.printable(name)}, from {literals.printable(source)}."
    rows = [head, *_yaml(tree, values, (), "")]
    return "\n".join(rows) + "\n"


def _yaml(
    tree: ParameterTree, values: ParameterValues, path: tuple[str, ...], indent: str
) -> Iterator[str]:
    for node in tree:
        below = (*path, node.name)
        if not indent:
            yield ""
        key = f"{indent}{literals.yaml_key(node.name)}:"
        if isinstance(node, InferredGroup):
            yield key
            yield from _yaml(node.members, values, below, indent + "  ")
            continue
        yield from literals.comment(node.doc, indent)
        if isinstance(node, ListParameter):
            yield from _yaml_list(node, values.get(below), key, indent)
            continue
        value = values.get(below)
        yield f"{indent}# {_KIND_DESCRIPTIONS[node.kind]}" + (
            "" if below in values else "; the default"
        )
        chosen = node.default if isinstance(value, list) or value is None else value
        yield f"{key} {literals.yaml_value(chosen if chosen is not None else '')}"


def _yaml_list(
    parameter: ListParameter, values: Literal | list[Literal] | None, key: str, indent: str
) -> Iterator[str]:
    yield f"{indent}# a list; each is {_KIND_DESCRIPTIONS[parameter.kind]}"
    elements = values if isinstance(values, list) else []
    line = f"{key} {literals.yaml_value(tuple(elements))}"
    if len(line) <= WIDTH:
        yield line
        return
    yield key
    yield from (f"{indent}  - {literals.yaml_value(value)}" for value in elements)


def walk_parameters(
    tree: ParameterTree, path: tuple[str, ...] = ()
) -> Iterator[tuple[tuple[str, ...], ScalarParameter | ListParameter]]:
    """Every parameter with the path to it, in new names."""
    for node in tree:
        if isinstance(node, InferredGroup):
            yield from walk_parameters(node.members, (*path, node.name))
        else:
            yield (*path, node.name), node
