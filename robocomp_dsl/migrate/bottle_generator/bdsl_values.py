"""Formats values and types in the syntax of BDSL."""

from __future__ import annotations

from collections.abc import Sequence as Values

from robocomp_dsl.migrate.bottle_generator.configuration import IniConstant
from robocomp_dsl.model import types

_NAMES = {
    types.INT8: "short",
    types.OCTET: "byte",
    types.UINT16: "int",
    types.UINT32: "long",
    types.UINT64: "long",
}
RADIANS = 0.017453292519943295
"""Radians in a degree; the original uses pi = 3.1415926."""


def format_constant(constant: IniConstant) -> str:
    """A constant as an expression."""
    value = constant.value
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        escaped = value.replace("\\", "\\\\").replace('"', '\\"')
        return '"' + escaped.replace("\n", "\\n").replace("\t", "\\t").replace("\r", "\\r") + '"'
    return repr(value)


def format_list(constants: Values[IniConstant]) -> str:
    """Constants as a list."""
    values = ", ".join(format_constant(constant) for constant in constants)
    return f"{{ {values} }}" if values else "{}"


def format_primitive(type_: types.Primitive) -> str:
    """The name of a built-in type in IDSL; for those of ROS alone, the next larger one."""
    return _NAMES.get(type_, type_.name)


def format_rate(rate: float) -> str:
    """A rate in Hz."""
    return f"{rate:g} Hz"
