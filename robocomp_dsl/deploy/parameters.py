"""The parameters of a PDSL file as the schema that the runtime checks configurations with.

In: the model of a PDSL file. Out: the same constants that the generated `params.py` holds, so that
a configuration is judged before anything runs exactly as the component will judge it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

from robocomp_dsl.model.parameter import Kind, Parameter
from robocomp_dsl.runtime import parameters as runtime
from robocomp_dsl.runtime.parameters import schema as schemas


def schema(parameters: Sequence[Parameter]) -> runtime.Schema:
    """One entry for each of `parameters`."""
    return tuple(_entry(one) for one in parameters)


def _entry(one: Parameter) -> schemas.Entry:
    if one.kind is Kind.GROUP:
        low, high = (None if bound is None else int(bound) for bound in (one.low, one.high))
        members = {"SCHEMA": schema(one.members)}
        kind = type(f"{one.name}_group", (runtime.ParameterGroup,), members)
        return runtime.Group(one.name, kind, low, high, single=one.single, doc=one.doc)
    return runtime.Parameter(
        one.name,
        cast("schemas.Kind", one.kind.value),
        default=one.default,
        low=one.low,
        high=one.high,
        unit=one.unit,
        choices=one.choices,
        live=one.live,
        doc=one.doc,
    )
