"""Converts the values of a list parameter, and checks each of them and their number.

In: nodes of a configuration, a text of a command line, or Python values. Out: the list, or
`InvalidValue` for each problem. A text has the form `1, 2`, `[1, 2]` or `{1, 2}`; texts with a
comma are in quotes.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import replace
from typing import TypeAlias

from robocomp_dsl.finding import Location
from robocomp_dsl.runtime.parameters import scalar as scalars
from robocomp_dsl.runtime.parameters.scalar import InvalidValue
from robocomp_dsl.runtime.parameters.schema import KIND_NAMES, Element, Parameter
from robocomp_dsl.runtime.parameters.tree import NODE_NAMES, Items, Node, Scalar, TextSyntax

Problem: TypeAlias = tuple[Location, InvalidValue]
_LISTS = {
    "string": "a list of strings",
    "int": "a list of whole numbers",
    "float": "a list of numbers",
    "bool": "a list of true and false",
    "choice": "a list of names",
}
_ELEMENT = re.compile(
    r"""\s*(?:(?P<quoted>"(?:[^"\\]|\\.)*"|'[^']*')\s*(?=,|\Z)|(?P<plain>[^,]*))(?P<comma>,|\Z)"""
)
_BRACKETS = {"[": "]", "{": "}"}


def element_of(parameter: Parameter) -> Parameter:
    """One element of a list as a parameter: it has no default."""
    return replace(parameter, default=None, shortest=None, longest=None)


def from_node(parameter: Parameter, path: str, node: Node) -> tuple[list[Element], list[Problem]]:
    """The values of a node of a configuration, and all problems with their places."""
    if isinstance(node, Items):
        nodes = node.items
    elif isinstance(node, Scalar) and node.style is TextSyntax.RAW:
        nodes = list(split(node))
    else:
        return [], [(node.place, _no_list(parameter, path, node))]
    element = element_of(parameter)
    values: list[Element] = []
    problems: list[Problem] = []
    for index, item in enumerate(nodes):
        try:
            values.append(_element(element, f"{path}[{index}]", item))
        except InvalidValue as invalid:
            problems.append((item.place, invalid))
    try:
        check_length(parameter, path, len(nodes))
    except InvalidValue as invalid:
        problems.append((node.place, invalid))
    return values, problems


def from_text(parameter: Parameter, path: str, text: Scalar) -> list[Element]:
    """The list in a text of a command line. Raises `InvalidValue` with all problems."""
    values, problems = from_node(parameter, path, text)
    _raise(problem for _, problem in problems)
    return values


def from_python(parameter: Parameter, path: str, value: object) -> list[Element]:
    """The list of Python values, also of a numpy array. Raises `InvalidValue`."""
    if not isinstance(value, Iterable) or isinstance(value, str | bytes | Mapping | AbstractSet):
        raise InvalidValue(
            f"`{path}` must be {_LISTS[parameter.kind]}, not {value!r:.60}",
            f"expected {describe_type(parameter)}",
        )
    element = element_of(parameter)
    values: list[Element] = []
    problems = []
    for index, item in enumerate(value):
        try:
            values.append(scalars.from_python(element, f"{path}[{index}]", item))
        except InvalidValue as invalid:
            problems.append(invalid)
    _raise(problems)
    check_length(parameter, path, len(values))
    return values


def check_length(parameter: Parameter, path: str, count: int) -> None:
    """Raise `InvalidValue` unless the list may have `count` elements."""
    low, high = parameter.shortest or 0, parameter.longest
    if count < low or (high is not None and count > high):
        counted = "1 element" if count == 1 else f"{count} elements"
        raise InvalidValue(f"`{path}` has {counted}, it must have {describe_length(parameter)}")


def describe_length(parameter: Parameter) -> str:
    """`1 to 8`, `3` or `2 or more`."""
    low, high = parameter.shortest or 0, parameter.longest
    if high is None:
        return f"{low} or more" if low else "any number of"
    return f"{low}" if low == high else f"{low} to {high}"


def describe_type(parameter: Parameter) -> str:
    """The type as PDSL writes it, with the length: `float`, `float[1:8]`, `int[3]`, `string[]`."""
    low, high = parameter.shortest, parameter.longest
    if low is None:
        return parameter.kind
    if low == high:
        return f"{parameter.kind}[{low}]"
    bounds = f"{low}:{high or ''}" if low or high else ""
    return f"{parameter.kind}[{bounds}]"


def split(text: Scalar) -> Iterator[Scalar]:
    """The elements of a text with their places; a comma behind the last one is ignored."""
    written = text.text
    inner = written.strip()
    if len(inner) > 1 and _BRACKETS.get(inner[0]) == inner[-1]:
        inner = inner[1:-1]
    start = written.find(inner)
    position = 0
    while inner[position:].strip():
        match = _ELEMENT.match(inner, position)
        if match is None:  # every text matches
            return
        kind = "plain" if match["quoted"] is None else "quoted"
        word = match[kind]
        place = text.place
        shifted = place.column + start + match.start(kind)
        here = Location(place.text, place.line, shifted, max(1, len(word.rstrip())))
        if kind == "plain":
            yield Scalar(here, word.strip(), TextSyntax.RAW)
        else:
            yield Scalar(here, _unquoted(word), TextSyntax.QUOTED)
        position = match.end()


def format_list(values: Iterable[Element]) -> str:
    """The values in a text that `split` reads: `[1.5, 2.0]`, `["a", "b"]`."""
    return f"[{', '.join(map(_format_element, values))}]"


def _format_element(value: Element) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else repr(value)


def _element(element: Parameter, path: str, node: Node) -> Element:
    if isinstance(node, Scalar):
        return scalars.from_scalar(element, path, node)
    raise InvalidValue(
        f"`{path}` must be {KIND_NAMES[element.kind]}, not {NODE_NAMES[type(node)]}",
        f"expected {element.kind}",
    )


def _no_list(parameter: Parameter, path: str, node: Node) -> InvalidValue:
    name = path.rpartition(".")[2]
    text = node.text.strip() if isinstance(node, Scalar) else ""
    shown = f"[{text}]" if text and text not in ("~", "null") else f"[<{parameter.kind}>, …]"
    found = NODE_NAMES[type(node)] if text or not isinstance(node, Scalar) else "empty"
    return InvalidValue(
        f"`{path}` must be {_LISTS[parameter.kind]}, not {found}",
        f"expected {describe_type(parameter)}",
        f"write `{name}: {shown:.60}`",
    )


def _unquoted(word: str) -> str:
    if word[0] == "'":
        return word[1:-1]
    try:
        return str(json.loads(word))
    except ValueError:
        return re.sub(r"\\(.)", r"\1", word[1:-1])


def _raise(problems: Iterable[InvalidValue]) -> None:
    """Raise all problems as one."""
    texts = ["; ".join(filter(None, (str(p), p.label, p.help))) for p in problems]
    if texts:
        raise InvalidValue("\n".join(texts))
