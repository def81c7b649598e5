"""Converts the parameters of a PDSL file to the schema that the runtime checks configurations with.

In: the model of a PDSL file. Out: the constants that the generated `params.py` holds, so a
configuration is checked before the start exactly as the component checks it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

from robocomp_dsl.model.parameter import Kind, Parameter
from robocomp_dsl.runtime import parameters as runtime
from robocomp_dsl.runtime.parameters import schema as schemas


def runtime_schema(parameters: Sequence[Parameter]) -> runtime.Schema:
    """One entry for each of `parameters`."""
    return tuple(_runtime_entry(parameter) for parameter in parameters)


def _runtime_entry(parameter: Parameter) -> schemas.Entry:
    if parameter.kind is Kind.GROUP:
        low, high = (
            None if bound is None else int(bound) for bound in (parameter.low, parameter.high)
        )
        members = {"SCHEMA": runtime_schema(parameter.members)}
        kind = type(f"{parameter.name}_group", (runtime.ParameterGroup,), members)
        return runtime.Group(
            parameter.name, kind, low, high, single=parameter.single, doc=parameter.doc
        )
    return runtime.Parameter(
        parameter.name,
        cast("schemas.Kind", parameter.kind.value),
        default=parameter.default,
        low=parameter.low,
        high=parameter.high,
        unit=parameter.unit,
        choices=parameter.choices,
        live=parameter.live,
        shortest=parameter.shortest,
        longest=parameter.longest,
        doc=parameter.doc,
    )
