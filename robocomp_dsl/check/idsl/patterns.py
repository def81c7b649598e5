"""Infers the communication pattern of an operation and its response parameter.

In: an operation with resolved types. Out: its pattern, its inputs, its outputs.

A marked `[query]` without any `out` may be written as request and response (paper "Progress in
RoboComp", listing 2). Its last parameter is then the response, and an output, when it is a struct,
there are at most two parameters, the return type is `int` or `void`, and
  - its type is called `…resp` or `…response` (in any case), or
  - the return type is `int` and both of the two parameters are structs.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.model.interface import Param, Pattern
from robocomp_dsl.model.types import INT, Struct, Type

_RESPONSE = ("resp", "response")


def infer_pattern(mark: str, *, has_output: bool) -> Pattern:
    """The pattern of an operation with the mark `mark` (empty or unknown: unmarked).

    An output is a result, an `out` parameter or a declared exception.
    """
    if mark in (Pattern.COMMAND, Pattern.QUERY, Pattern.PUBLISH):
        return Pattern(mark)
    return Pattern.QUERY if has_output else Pattern.UNMARKED


def response_index(mark: str, inputs: Sequence[Param], result: Type | None) -> int | None:
    """The index of the parameter that is the response without `out`, or None."""
    if mark != Pattern.QUERY or not 1 <= len(inputs) <= 2 or result not in (INT, None):
        return None
    last = inputs[-1].type
    if not isinstance(last, Struct):
        return None
    two_structs = len(inputs) == 2 and isinstance(inputs[0].type, Struct) and result is INT
    return len(inputs) - 1 if two_structs or is_response(last) else None


def is_response(type_: Type) -> bool:
    """Whether the name of a type ends like that of a response."""
    return type_.name.lower().endswith(_RESPONSE)
