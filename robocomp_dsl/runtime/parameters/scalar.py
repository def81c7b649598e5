"""Converts single values from text or Python to the type of a parameter, and checks their range.

In: a `Scalar` or a Python object, and the `Parameter`. Out: the value, or `InvalidValue` with the
reason. Numbers follow YAML 1.2 (`1e-3` is a number, `010` is rejected as ambiguous, `1:30` is a
string).
"""

from __future__ import annotations

import json
import math
import re
from numbers import Integral, Real
from typing import SupportsFloat

from robocomp_dsl.runtime.parameters.errors import did_you_mean
from robocomp_dsl.runtime.parameters.schema import KIND_NAMES, Element, Parameter, Value
from robocomp_dsl.runtime.parameters.tree import Scalar, TextSyntax

_DECIMAL = re.compile(r"[-+]?(0|[1-9][0-9]*(_[0-9]+)*)")
_BASED = re.compile(r"[-+]?0(x[0-9a-fA-F]+|o[0-7]+|b[01]+)")
_OCTAL_LOOK = re.compile(r"[-+]?0[0-9]+")
_FLOAT = re.compile(r"[-+]?([0-9]+(_[0-9]+)*(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?")
_NOT_FINITE = re.compile(r"[-+]?\.?(nan|inf|infinity)", re.IGNORECASE)
_TRUE = {"true", "yes", "on"}
_FALSE = {"false", "no", "off"}
_MAX_DIGITS = 400
"""Maximum number of digits; Python refuses to convert longer numbers anyway."""
_MOST_SHOWN = 8
"""Elements of a list that messages show."""


class InvalidValue(Exception):
    """An invalid value. `label` is shown beside the caret, `help` suggests a fix."""

    def __init__(self, message: str, label: str = "", help: str = "") -> None:
        self.label = label
        self.help = help
        super().__init__(message)


def from_scalar(parameter: Parameter, path: str, scalar: Scalar) -> Element:
    """The checked value of `scalar` for `parameter`; `path` is its name in messages."""
    if scalar.style is TextSyntax.PLAIN and scalar.text in ("", "~", "null", "Null", "NULL"):
        raise InvalidValue(f"`{path}` has no value", help=_value_help(parameter))
    if parameter.kind in ("string", "choice"):
        return check_range(parameter, path, _text(parameter, path, scalar))
    if scalar.style is TextSyntax.QUOTED:
        raise _wrong_type(parameter, path, "a quoted string", "remove the quotes")
    found = _number_or_bool(parameter, path, scalar.text.strip())
    return check_range(parameter, path, found)


def from_python(parameter: Parameter, path: str, value: object) -> Element:
    """The checked value of a Python object for `parameter`; numpy numbers are accepted."""
    match parameter.kind, value:
        case "bool", bool():
            return value
        case "int", bool():
            pass
        case "int", Integral():
            return check_range(parameter, path, int(value))
        case "float", bool():
            pass
        case "float", Real():
            return check_range(parameter, path, _finite(path, value))
        case (("string" | "choice"), str()):
            return check_range(parameter, path, value)
    raise _wrong_type(parameter, path, f"{value!r:.60}")


def check_range(parameter: Parameter, path: str, value: Element) -> Element:
    """`value` itself if it is a choice and within the bounds; else raises `InvalidValue`."""
    if parameter.kind == "choice" and value not in parameter.choices:
        listed = ", ".join(parameter.choices)
        raise InvalidValue(
            f"`{path}` cannot be `{value:.60}`",
            label=did_you_mean(str(value), parameter.choices),
            help=f"it is one of: {listed}",
        )
    if isinstance(value, str) or parameter.kind == "bool":
        return value
    low, high, unit = parameter.low, parameter.high, parameter.unit and f" {parameter.unit}"
    stated = f"`{path}` is {format_value(value)}{unit}"
    if low is not None and value < low:
        lowest = f"its lowest value is {format_value(low)}{unit}"
        raise InvalidValue(f"{stated}, {lowest}", "too low")
    if high is not None and value > high:
        highest = f"its highest value is {format_value(high)}{unit}"
        raise InvalidValue(f"{stated}, {highest}", "too high")
    return value


def _text(parameter: Parameter, path: str, scalar: Scalar) -> str:
    """A string; text that YAML 1.2 readers parse as a number or bool must be quoted."""
    text = scalar.text
    if scalar.style is not TextSyntax.PLAIN or text in parameter.choices:
        return text
    if text.lower() in ("true", "false"):
        raise _wrong_type(parameter, path, f"the bool {text}", f'write "{text}" with quotes')
    if len(text) <= _MAX_DIGITS and (_FLOAT.fullmatch(text) or _BASED.fullmatch(text)):
        raise _wrong_type(parameter, path, f"the number {text}", f'write "{text}" with quotes')
    return text


def _number_or_bool(parameter: Parameter, path: str, text: str) -> Element:
    if len(text) > _MAX_DIGITS:
        raise _wrong_type(parameter, path, "a very long string")
    if parameter.kind == "bool":
        if text.lower() in _TRUE | _FALSE:
            return text.lower() in _TRUE
        raise _wrong_type(parameter, path, f"`{text}`")
    if _NOT_FINITE.fullmatch(text):
        raise InvalidValue(f"`{path}` is `{text}`, it must be a finite number")
    if _OCTAL_LOOK.fullmatch(text):
        plain = text.lstrip("+-").lstrip("0") or "0"
        raise InvalidValue(
            f"`{path}` is `{text}`: YAML readers disagree on numbers that begin with 0",
            help=f"write {plain}, or 0o{plain} for the octal number",
        )
    if parameter.kind == "int":
        return _int(parameter, path, text)
    if _FLOAT.fullmatch(text) or _BASED.fullmatch(text):
        based = _BASED.fullmatch(text)
        return _finite(path, int(text, 0) if based else float(text))
    raise _wrong_type(parameter, path, f"`{text}`")


def _int(parameter: Parameter, path: str, text: str) -> int:
    if _DECIMAL.fullmatch(text) or _BASED.fullmatch(text):
        return int(text, 0)
    if _FLOAT.fullmatch(text):
        near = float(text)
        whole = math.isfinite(near) and near.is_integer() and abs(near) < 2**53
        raise _wrong_type(parameter, path, f"`{text}`", f"write {int(near)}" if whole else "")
    raise _wrong_type(parameter, path, f"`{text}`")


def _finite(path: str, value: SupportsFloat) -> float:
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if math.isfinite(number):
        return number
    raise InvalidValue(f"`{path}` is {number}, it must be a finite number")


def _wrong_type(parameter: Parameter, path: str, found: str, help: str = "") -> InvalidValue:
    expected = KIND_NAMES[parameter.kind]
    return InvalidValue(
        f"`{path}` must be {expected}, not {found}", f"expected {parameter.kind}", help
    )


def _value_help(parameter: Parameter) -> str:
    if parameter.default is None:
        return f"write {KIND_NAMES[parameter.kind]} after it"
    return f"write one, or remove the line to use the default {format_value(parameter.default)}"


def format_value(value: Value) -> str:
    """`value` as written in YAML; a long value is cut."""
    if not isinstance(value, bool | int | float | str):
        shown = [format_value(element) for element in value[:_MOST_SHOWN]]
        return f"[{', '.join((*shown, '…') if len(value) > _MOST_SHOWN else shown)}]"
    match value:
        case bool():
            return str(value).lower()
        case float():
            return repr(value).removesuffix(".0")
        case int():
            return str(value) if abs(value) < 10**40 else f"{str(value)[:20]}…"
    return json.dumps(value, ensure_ascii=False) if len(value) < 80 else f'"{value[:60]}…"'
