"""The content of `params.py` and `etc/config.yaml`.

In: the parameters of a component. Out: plain data for the two templates: the classes, inner groups
first, and the lines of the configuration.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from robocomp_dsl.generate import literals, names
from robocomp_dsl.generate.python import layout
from robocomp_dsl.generate.python.layout import INNER, Item
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.parameter import Default, Kind, Parameter
from robocomp_dsl.record import ValueRecord

_TYPES = {Kind.STRING: "str", Kind.INT: "int", Kind.FLOAT: "float", Kind.BOOL: "bool"}
_WORDS = {
    Kind.STRING: "a text",
    Kind.INT: "a whole number",
    Kind.FLOAT: "a number",
    Kind.BOOL: "true or false",
}


_MOST_EQUAL = 8
"""Elements of a default that are written out although they are equal."""


class AttributeCode(ValueRecord):
    """One typed attribute with the comment lines above it."""

    comments: tuple[str, ...]
    declaration: str


class ParametersCode(ValueRecord):
    """One class: the component's parameters, or a group."""

    name: str
    base: str
    doc: str
    schema: str
    attributes: tuple[AttributeCode, ...]


class ParamsCode(ValueRecord):
    """The whole module; `source` is the PDSL file, or the CDSL file if there is none."""

    source: str
    imports: tuple[str, ...]
    classes: tuple[ParametersCode, ...]


def params_code(name: str, component: Component) -> ParamsCode:
    """The data of the template of `params.py`; `name` is the main class."""
    description = component.parameters
    doc = (description and description.doc.strip()) or f"The parameters of {component.name}."
    classes: list[ParametersCode] = []
    builder = _Classes(names.NameScope(names.BUILTINS | names.MODULE | {name}), classes)
    builder.add(name, "Parameters", doc, description.parameters if description else ())
    source = literals.printable((description or component).path.name)
    return ParamsCode(source, tuple(_imports(classes)), tuple(classes))


def _imports(classes: list[ParametersCode]) -> Iterator[str]:
    if any("Literal[" in a.declaration for c in classes for a in c.attributes):
        yield "from typing import Literal"
        yield ""
    groups = len(classes) > 1
    used = ["Group"] if groups else []
    used += ["Parameter"] if any("Parameter(" in c.schema for c in classes) else []
    used += ["ParameterGroup"] if groups else []
    yield f"from robocomp_dsl.runtime.parameters import {', '.join([*used, 'Parameters'])}"


class _Classes(ValueRecord):
    """Builds the classes; a group precedes the class that contains it."""

    scope: names.NameScope
    classes: list[ParametersCode]

    def add(self, name: str, base: str, doc: str, parameters: tuple[Parameter, ...]) -> None:
        attribute_names = names.unique(
            [p.name for p in parameters], names.PARAMETER_MEMBERS | names.ANNOTATION
        )
        entries: list[Item] = []
        attributes = []
        for attribute, parameter in zip(attribute_names, parameters, strict=True):
            group = self.group(parameter) if parameter.kind is Kind.GROUP else ""
            entries.append(_entry(parameter, attribute, group))
            about = tuple(literals.comment(parameter.doc, INNER))
            attributes.append(AttributeCode(about, _declared(attribute, parameter, group)))
        schema = layout.statement("SCHEMA = ", layout.tuple_of(*entries), INNER)
        text = literals.docstring(doc, INNER)
        self.classes.append(ParametersCode(name, base, text, schema, tuple(attributes)))

    def group(self, parameter: Parameter) -> str:
        name = self.scope.claim(f"{names.camel(parameter.name)}Group")
        self.add(
            name,
            "ParameterGroup",
            parameter.doc.strip() or f"One of `{parameter.name}`.",
            parameter.members,
        )
        return name


def _declared(attribute: str, parameter: Parameter, group: str) -> str:
    hint: Item = _TYPES.get(parameter.kind, "")
    if parameter.kind is Kind.CHOICE:
        hint = layout.subscript("Literal", *map(literals.python_string, parameter.choices))
    elif parameter.kind is Kind.GROUP:
        hint = group if parameter.single else f"list[{group}]"
    if parameter.is_list:
        hint = layout.subscript("list", hint)
    return layout.statement(f"{attribute}: ", hint, INNER)


def _entry(parameter: Parameter, attribute: str, group: str) -> Item:
    """The line of `SCHEMA`; default settings are omitted."""
    quoted = literals.python_string
    arguments: list[Item] = [quoted(parameter.name)]
    arguments.append(group or quoted(parameter.kind.value))
    if parameter.default is not None:
        arguments.append(_default(_of_kind(parameter, parameter.default)))
    bounds = {"low": parameter.low, "high": parameter.high}
    for key, bound in bounds.items():
        if bound is not None:
            whole = parameter.kind in (Kind.INT, Kind.GROUP)
            arguments.append(
                f"{key}={literals.python_value(int(bound) if whole else float(bound))}"
            )
    lengths = {"shortest": parameter.shortest, "longest": parameter.longest}
    arguments += [f"{key}={length}" for key, length in lengths.items() if length is not None]
    if parameter.unit:
        arguments.append(f"unit={quoted(parameter.unit)}")
    if parameter.choices:
        arguments.append(layout.tuple_of(*map(quoted, parameter.choices), head="choices="))
    arguments += [f"{key}=True" for key in ("live", "single") if getattr(parameter, key)]
    if parameter.doc:
        arguments.append(f"doc={quoted(' '.join(literals.lines(parameter.doc)))}")
    if attribute != parameter.name:
        arguments.append(f"attribute={quoted(attribute)}")
    return layout.call("Group" if group else "Parameter", *arguments)


def _default(default: Default) -> Item:
    """The argument `default=…`; many equal elements of a list are a product."""
    if not isinstance(default, tuple):
        return f"default={literals.python_value(default)}"
    elements = [literals.python_value(element) for element in default]
    if len(elements) > _MOST_EQUAL and len(set(elements)) == 1:
        return f"default=({elements[0]},) * {len(elements)}"
    return layout.tuple_of(*elements, head="default=")


def _of_kind(parameter: Parameter, default: Default) -> Default:
    """The default; integer defaults of a float are converted."""
    if parameter.kind is not Kind.FLOAT:
        return default
    return tuple(map(float, default)) if isinstance(default, tuple) else float(default)


def config_lines(parameters: Iterable[Parameter], indent: str = "") -> Iterator[str]:
    """`etc/config.yaml` without its head: each parameter with default and permitted values."""
    for parameter in parameters:
        yield ""
        yield from literals.comment(parameter.doc, indent)
        yield f"{indent}# {takes(parameter)}"
        key = f"{indent}{literals.yaml_key(parameter.name)}:"
        if parameter.kind is not Kind.GROUP:
            value = (
                ""
                if parameter.default is None
                else f" {literals.yaml_value(_of_kind(parameter, parameter.default))}"
            )
            yield key + value
        elif parameter.single:
            yield key
            yield from list(config_lines(parameter.members, indent + "  "))[1:]
        else:
            yield from _list_lines(parameter, key, indent)


def _list_lines(parameter: Parameter, key: str, indent: str) -> Iterator[str]:
    """The minimum number of entries, the first with all comments."""
    least = int(parameter.low or 0)
    if not least:
        yield f"{key} []"
        return
    yield key
    first = list(config_lines(parameter.members, indent + INNER))[1:]
    others = [line for line in first if line and not line.lstrip().startswith("#")]
    for members in (first, *[others] * (least - 1)):
        yield f"{indent}  -"
        yield from members


def takes(parameter: Parameter) -> str:
    """The permitted values: `a number from 1 to 1000 [Hz], may change while running`."""
    unit = f" [{literals.printable(parameter.unit)}]" if parameter.unit else ""
    live = ", may change while running" if parameter.live else ""
    must = (
        ", must be given" if parameter.default is None and parameter.kind is not Kind.GROUP else ""
    )
    each = f"{_WORDS.get(parameter.kind) or _listed(parameter)}{_range(parameter)}{unit}"
    if parameter.is_list:
        each = f"a list of {parameter.describe_length()}, each {each}"
    return f"{each}{live}{must}"


def _listed(parameter: Parameter) -> str:
    if parameter.kind is Kind.CHOICE:
        return "one of: " + ", ".join(parameter.choices)
    if parameter.single:
        return "a group"
    low, high = int(parameter.low or 0), parameter.high
    if high is None:
        return f"a list of {low or 'any number of'}{' or more' if low else ''} groups"
    return f"a list of {low} to {int(high)} groups" if low != high else f"a list of {low} groups"


def _range(parameter: Parameter) -> str:
    if parameter.kind not in (Kind.INT, Kind.FLOAT):
        return ""
    low, high = (_number(bound) for bound in (parameter.low, parameter.high))
    if low and high:
        return f" from {low} to {high}"
    if low:
        return f", at least {low}"
    return f", at most {high}" if high else ""


def _number(bound: float | None) -> str:
    if bound is None:
        return ""
    return str(int(bound)) if float(bound).is_integer() else literals.yaml_value(float(bound))
