"""Describes the parameters of a component for the help of its command line.

In: a schema. Out: lines of text: what `--set` accepts, with units, ranges, defaults and the
documentation of the PDSL file.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterator

from robocomp_dsl.runtime.parameters.scalar import format_value
from robocomp_dsl.runtime.parameters.schema import Group, Parameter, Schema
from robocomp_dsl.runtime.parameters.value_list import describe_length

_WIDTH = 80


def describe_parameters(schema: Schema, prefix: str = "") -> Iterator[str]:
    """Two lines or more for each parameter; `N` stands for a position in a list."""
    for entry in schema:
        path = f"{prefix}{entry.name}"
        if isinstance(entry, Parameter):
            yield f"  {path}={_describe_value(entry)}"
            yield from _wrap_doc(entry.doc)
            continue
        if not entry.single:
            yield f"  {path}[N]  {_describe_count(entry)}"
            path += "[N]"
        elif entry.doc:
            yield f"  {path}"
        yield from _wrap_doc(entry.doc)
        yield from describe_parameters(entry.type.SCHEMA, f"{path}.")


def _describe_value(parameter: Parameter) -> str:
    """`<float>  1 to 1000 Hz, 50.0 if not given, may change while running`."""
    kind = "|".join(parameter.choices) if parameter.choices else f"<{parameter.kind}>"
    if parameter.is_list:
        kind += ",…"
    facts = [
        _describe_elements(parameter),
        _describe_range(parameter),
        f"{_describe_default(parameter)} if not given"
        if parameter.default is not None
        else "required",
    ]
    facts += ["may change while running"] if parameter.live else []
    return f"{kind}  {', '.join(filter(None, facts))}"


def _describe_elements(parameter: Parameter) -> str:
    """`1 to 8 values` of a list."""
    return f"{describe_length(parameter)} values" if parameter.is_list else ""


def _describe_default(parameter: Parameter) -> str:
    default = parameter.default
    return format_value(default) if isinstance(default, tuple) else repr(default)


def _describe_range(parameter: Parameter) -> str:
    unit = f" {parameter.unit}" if parameter.unit else ""
    if parameter.low is None and parameter.high is None:
        return f"in{unit}" if unit else ""
    if parameter.high is None:
        return f"at least {parameter.low:g}{unit}"
    if parameter.low is None:
        return f"at most {parameter.high:g}{unit}"
    return f"{parameter.low:g} to {parameter.high:g}{unit}"


def _describe_count(parameter: Group) -> str:
    low = parameter.low or 0
    if parameter.high is None:
        return f"{low} or more groups, N from 0"
    return f"{low} to {parameter.high} groups, N from 0"


def _wrap_doc(doc: str) -> list[str]:
    indent = " " * 6
    text = " ".join(doc.split())
    return textwrap.wrap(text, _WIDTH, initial_indent=indent, subsequent_indent=indent)
