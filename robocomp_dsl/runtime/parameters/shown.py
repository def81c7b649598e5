"""The parameters of a component as the help of its program shows them.

In: a schema. Out: lines of text: what `--set` takes, with units, ranges, defaults and what the
PDSL file says of each.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterator

from robocomp_dsl.runtime.parameters.schema import Group, Parameter, Schema

_WIDTH = 80


def lines(schema: Schema, prefix: str = "") -> Iterator[str]:
    """Two lines or more for each parameter; `N` stands for a position in a list."""
    for one in schema:
        path = f"{prefix}{one.name}"
        if isinstance(one, Parameter):
            yield f"  {path}={_takes(one)}"
            yield from _said(one.doc)
            continue
        if not one.single:
            yield f"  {path}[N]  {_count(one)}"
            path += "[N]"
        elif one.doc:
            yield f"  {path}"
        yield from _said(one.doc)
        yield from lines(one.type.SCHEMA, f"{path}.")


def _takes(one: Parameter) -> str:
    """`<float>  1 to 1000 Hz, 50.0 if not given, may change while running`."""
    kind = "|".join(one.choices) if one.choices else f"<{one.kind}>"
    facts = [
        _range(one),
        f"{one.default!r} if not given" if one.default is not None else "required",
    ]
    facts += ["may change while running"] if one.live else []
    return f"{kind}  {', '.join(filter(None, facts))}"


def _range(one: Parameter) -> str:
    unit = f" {one.unit}" if one.unit else ""
    if one.low is None and one.high is None:
        return f"in{unit}" if unit else ""
    if one.high is None:
        return f"at least {one.low:g}{unit}"
    if one.low is None:
        return f"at most {one.high:g}{unit}"
    return f"{one.low:g} to {one.high:g}{unit}"


def _count(one: Group) -> str:
    low = one.low or 0
    if one.high is None:
        return f"{low} or more groups, N from 0"
    return f"{low} to {one.high} groups, N from 0"


def _said(doc: str) -> list[str]:
    indent = " " * 6
    text = " ".join(doc.split())
    return textwrap.wrap(text, _WIDTH, initial_indent=indent, subsequent_indent=indent)
