"""What `generated/params.py` and `etc/config.yaml` say of the parameters.

In: the parameters of a component. Out: plain data for the two templates: the classes, inner groups
first, and the lines of the configuration.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.generate import layout, literals, names
from robocomp_dsl.generate.layout import INNER, Item
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.parameter import Kind, Parameter
from robocomp_dsl.model.types import Literal
from robocomp_dsl.record import Value

_TYPES = {Kind.STRING: "str", Kind.INT: "int", Kind.FLOAT: "float", Kind.BOOL: "bool"}
_WORDS = {
    Kind.STRING: "a text",
    Kind.INT: "a whole number",
    Kind.FLOAT: "a number",
    Kind.BOOL: "true or false",
}


class AttributeCode(Value):
    """One typed attribute with the comment lines above it."""

    comments: tuple[str, ...]
    declaration: str


class ParametersCode(Value):
    """One class: the component's own, or that of a group."""

    name: str
    base: str
    doc: str
    schema: str
    attributes: tuple[AttributeCode, ...]


class ParamsCode(Value):
    """The whole module; `source` is empty or ` from x.pdsl`."""

    source: str
    imports: tuple[str, ...]
    classes: tuple[ParametersCode, ...]


def params_code(name: str, component: Component) -> ParamsCode:
    """Everything that the template of `generated/params.py` prints; `name` is the main class."""
    given = component.parameters
    doc = (given and given.doc.strip()) or f"The parameters of {component.name}."
    made: list[ParametersCode] = []
    builder = _Classes(names.Scope(names.BUILTINS | names.MODULE | {name}), made)
    builder.add(name, "Parameters", doc, given.parameters if given else ())
    source = f" from {literals.printable(given.path.name)}" if given else ""
    return ParamsCode(source, tuple(_imports(made)), tuple(made))


def _imports(classes: list[ParametersCode]) -> Iterator[str]:
    if any("Literal[" in a.declaration for c in classes for a in c.attributes):
        yield "from typing import Literal"
        yield ""
    groups = len(classes) > 1
    used = ["Group"] if groups else []
    used += ["Parameter"] if any("Parameter(" in c.schema for c in classes) else []
    used += ["ParameterGroup"] if groups else []
    yield f"from robocomp_dsl.runtime.parameters import {', '.join([*used, 'Parameters'])}"


class _Classes(Value):
    """Makes the classes, those of groups before the ones that hold them."""

    scope: names.Scope
    made: list[ParametersCode]

    def add(self, name: str, base: str, doc: str, parameters: tuple[Parameter, ...]) -> None:
        called = names.unique(
            [p.name for p in parameters], names.PARAMETER_MEMBERS | names.ANNOTATION
        )
        entries: list[Item] = []
        attributes = []
        for attribute, one in zip(called, parameters, strict=True):
            group = self.group(one) if one.kind is Kind.GROUP else ""
            entries.append(_entry(one, attribute, group))
            about = tuple(literals.comment(one.doc, INNER))
            attributes.append(AttributeCode(about, _declared(attribute, one, group)))
        schema = layout.statement("SCHEMA = ", layout.tuple_of(*entries), INNER)
        text = literals.docstring(doc, INNER)
        self.made.append(ParametersCode(name, base, text, schema, tuple(attributes)))

    def group(self, one: Parameter) -> str:
        name = self.scope.claim(f"{names.camel(one.name)}Group")
        self.add(name, "ParameterGroup", one.doc.strip() or f"One of `{one.name}`.", one.members)
        return name


def _declared(attribute: str, one: Parameter, group: str) -> str:
    hint: Item = _TYPES.get(one.kind, "")
    if one.kind is Kind.CHOICE:
        hint = layout.subscript("Literal", *map(literals.python_string, one.choices))
    elif one.kind is Kind.GROUP:
        hint = group if one.single else f"list[{group}]"
    return layout.statement(f"{attribute}: ", hint, INNER)


def _entry(one: Parameter, attribute: str, group: str) -> Item:
    """The line of `SCHEMA`; what has its usual value is not said."""
    quoted = literals.python_string
    given: list[Item] = [quoted(one.name)]
    given.append(group or quoted(one.kind.value))
    if one.default is not None:
        given.append(f"default={literals.python_value(_of_kind(one, one.default))}")
    bounds = {"low": one.low, "high": one.high}
    for key, bound in bounds.items():
        if bound is not None:
            whole = one.kind in (Kind.INT, Kind.GROUP)
            given.append(f"{key}={literals.python_value(int(bound) if whole else float(bound))}")
    if one.unit:
        given.append(f"unit={quoted(one.unit)}")
    if one.choices:
        given.append(layout.tuple_of(*map(quoted, one.choices), head="choices="))
    given += [f"{key}=True" for key in ("live", "single") if getattr(one, key)]
    if one.doc:
        given.append(f"doc={quoted(' '.join(literals.lines(one.doc)))}")
    if attribute != one.name:
        given.append(f"attribute={quoted(attribute)}")
    return layout.call("Group" if group else "Parameter", *given)


def _of_kind(one: Parameter, default: Literal) -> Literal:
    """The default; a whole number for a float becomes one."""
    return float(default) if one.kind is Kind.FLOAT else default


def config_lines(parameters: Iterable[Parameter], indent: str = "") -> Iterator[str]:
    """`etc/config.yaml` without its head: every parameter with its default and what it takes."""
    for one in parameters:
        yield ""
        yield from literals.comment(one.doc, indent)
        yield f"{indent}# {takes(one)}"
        key = f"{indent}{literals.yaml_key(one.name)}:"
        if one.kind is not Kind.GROUP:
            given = (
                "" if one.default is None else f" {literals.yaml_value(_of_kind(one, one.default))}"
            )
            yield key + given
        elif one.single:
            yield key
            yield from list(config_lines(one.members, indent + "  "))[1:]
        else:
            yield from _list_lines(one, key, indent)


def _list_lines(one: Parameter, key: str, indent: str) -> Iterator[str]:
    """The least number of entries, the first with all comments."""
    least = int(one.low or 0)
    if not least:
        yield f"{key} []"
        return
    yield key
    first = list(config_lines(one.members, indent + INNER))[1:]
    others = [line for line in first if line and not line.lstrip().startswith("#")]
    for members in (first, *[others] * (least - 1)):
        yield f"{indent}  -"
        yield from members


def takes(one: Parameter) -> str:
    """What values it takes, in a line: `a number from 1 to 1000 [Hz], may change while running`."""
    unit = f" [{literals.printable(one.unit)}]" if one.unit else ""
    live = ", may change while running" if one.live else ""
    must = ", must be given" if one.default is None and one.kind is not Kind.GROUP else ""
    return f"{_WORDS.get(one.kind) or _listed(one)}{_range(one)}{unit}{live}{must}"


def _listed(one: Parameter) -> str:
    if one.kind is Kind.CHOICE:
        return "one of: " + ", ".join(one.choices)
    if one.single:
        return "a group"
    low, high = int(one.low or 0), one.high
    if high is None:
        return f"a list of {low or 'any number of'}{' or more' if low else ''} groups"
    return f"a list of {low} to {int(high)} groups" if low != high else f"a list of {low} groups"


def _range(one: Parameter) -> str:
    if one.kind not in (Kind.INT, Kind.FLOAT):
        return ""
    low, high = (_number(bound) for bound in (one.low, one.high))
    if low and high:
        return f" from {low} to {high}"
    if low:
        return f", at least {low}"
    return f", at most {high}" if high else ""


def _number(bound: float | None) -> str:
    if bound is None:
        return ""
    return str(int(bound)) if float(bound).is_integer() else literals.yaml_value(float(bound))
