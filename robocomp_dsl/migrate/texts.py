"""Parameters as PDSL, and the values of one configuration as commented YAML.

In: what `infer` found. Out: the two texts.
"""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.generate import literals
from robocomp_dsl.migrate.infer import ITEM, Branch, Leaf, Listed, Tree, Values
from robocomp_dsl.model.parameter import Kind
from robocomp_dsl.model.types import Literal

STEP = "    "
_WORDS = {
    Kind.STRING: "a text",
    Kind.INT: "a whole number",
    Kind.FLOAT: "a number",
    Kind.BOOL: "true or false",
}


def pdsl_text(name: str, tree: Tree, source: str) -> str:
    """The PDSL file; `source` says where the parameters come from."""
    head = f"/** The parameters of {name}; kinds and defaults are those of {_doc(source)}. */"
    rows = [head, f"ComponentParams {name}", "{", *_pdsl(tree, STEP), "};"]
    return "\n".join(rows) + "\n"


def _pdsl(tree: Tree, indent: str) -> Iterator[str]:
    for one in tree:
        if isinstance(one, Branch):
            yield f"{indent}{one.name}"
            yield from _block(list(_pdsl(one.members, indent + STEP)), indent)
            continue
        if one.doc.strip():
            yield from _doc_rows(one.doc, indent)
        if isinstance(one, Listed):
            yield f"{indent}{one.name}[]"
            yield from _block([f"{indent}{STEP}{ITEM} {one.item.kind.value};"], indent)
        else:
            default = "" if one.default is None else f" {_pdsl_value(one.default)}"
            yield f"{indent}{one.name} {one.kind.value}{default};"


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


def yaml_text(name: str, tree: Tree, values: Values, source: str) -> str:
    """The configuration of one file with its own values, where it has them."""
    head = f"# Configuration of {literals.printable(name)}, from {literals.printable(source)}."
    rows = [head, *_yaml(tree, values, (), "")]
    return "\n".join(rows) + "\n"


def _yaml(tree: Tree, values: Values, path: tuple[str, ...], indent: str) -> Iterator[str]:
    for one in tree:
        below = (*path, one.name)
        if not indent:
            yield ""
        key = f"{indent}{literals.yaml_key(one.name)}:"
        if isinstance(one, Branch):
            yield key
            yield from _yaml(one.members, values, below, indent + "  ")
            continue
        yield from literals.comment(one.doc, indent)
        if isinstance(one, Listed):
            yield from _yaml_list(one, values.get(below), key, indent)
            continue
        value = values.get(below)
        yield f"{indent}# {_WORDS[one.kind]}" + ("" if below in values else "; the default")
        chosen = one.default if isinstance(value, list) or value is None else value
        yield f"{key} {literals.yaml_value(chosen if chosen is not None else '')}"


def _yaml_list(
    one: Listed, values: Literal | list[Literal] | None, key: str, indent: str
) -> Iterator[str]:
    yield f"{indent}# a list; each with {_WORDS[one.item.kind]}"
    if not isinstance(values, list) or not values:
        yield f"{key} []"
        return
    yield key
    yield from (f"{indent}  - {ITEM}: {literals.yaml_value(value)}" for value in values)


def leaves(
    tree: Tree, path: tuple[str, ...] = ()
) -> Iterator[tuple[tuple[str, ...], Leaf | Listed]]:
    """Every parameter with the path to it, in new names."""
    for one in tree:
        if isinstance(one, Branch):
            yield from leaves(one.members, (*path, one.name))
        else:
            yield (*path, one.name), one
