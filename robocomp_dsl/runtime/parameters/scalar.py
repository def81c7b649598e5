"""Single values: from text or from Python to the type that a parameter has, within its range.

In: a `Scalar` or a Python object, and the `Parameter`. Out: the value, or `Unfit` with the reason.
Numbers follow YAML 1.2 (`1e-3` is a number, `010` is refused as ambiguous, `1:30` is text).
"""

from __future__ import annotations

import json
import math
import re
from numbers import Integral, Real
from typing import SupportsFloat

from robocomp_dsl.runtime.parameters.findings import did_you_mean
from robocomp_dsl.runtime.parameters.schema import ARTICLE, Parameter, Value
from robocomp_dsl.runtime.parameters.tree import Scalar, Style

_DECIMAL = re.compile(r"[-+]?(0|[1-9][0-9]*(_[0-9]+)*)")
_BASED = re.compile(r"[-+]?0(x[0-9a-fA-F]+|o[0-7]+|b[01]+)")
_OCTAL_LOOK = re.compile(r"[-+]?0[0-9]+")
_FLOAT = re.compile(r"[-+]?([0-9]+(_[0-9]+)*(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?")
_NOT_FINITE = re.compile(r"[-+]?\.?(nan|inf|infinity)", re.IGNORECASE)
_TRUE = {"true", "yes", "on"}
_FALSE = {"false", "no", "off"}
_LONGEST = 400
"""Digits of a number, at most: Python refuses to convert very long ones anyway."""


class Unfit(Exception):
    """A value that a parameter cannot take. `label` goes beside the caret, `help` is a way out."""

    def __init__(self, message: str, label: str = "", help: str = "") -> None:
        self.label = label
        self.help = help
        super().__init__(message)


def of_scalar(parameter: Parameter, path: str, scalar: Scalar) -> Value:
    """What `scalar` means for `parameter`, in range. `path` is what messages call it."""
    if scalar.style is Style.PLAIN and scalar.text in ("", "~", "null", "Null", "NULL"):
        raise Unfit(f"`{path}` has no value", help=_how_to_give(parameter))
    if parameter.kind in ("string", "choice"):
        return in_range(parameter, path, _text(parameter, path, scalar))
    if scalar.style is Style.QUOTED:
        raise _wrong_type(parameter, path, "a quoted text", "remove the quotes")
    found = _number_or_bool(parameter, path, scalar.text.strip())
    return in_range(parameter, path, found)


def of_python(parameter: Parameter, path: str, value: object) -> Value:
    """What the Python object `value` means for `parameter`, in range; numpy's numbers count."""
    match parameter.kind, value:
        case "bool", bool():
            return value
        case "int", bool():
            pass
        case "int", Integral():
            return in_range(parameter, path, int(value))
        case "float", bool():
            pass
        case "float", Real():
            return in_range(parameter, path, _finite(path, value))
        case (("string" | "choice"), str()):
            return in_range(parameter, path, value)
    raise _wrong_type(parameter, path, f"{value!r:.60}")


def in_range(parameter: Parameter, path: str, value: Value) -> Value:
    """`value` itself when it is one of the choices and within the bounds; else raises `Unfit`."""
    if parameter.kind == "choice" and value not in parameter.choices:
        listed = ", ".join(parameter.choices)
        raise Unfit(
            f"`{path}` cannot be `{value:.60}`",
            label=did_you_mean(str(value), parameter.choices),
            help=f"it is one of: {listed}",
        )
    if isinstance(value, str) or parameter.kind == "bool":
        return value
    low, high, unit = parameter.low, parameter.high, parameter.unit and f" {parameter.unit}"
    if low is not None and value < low:
        said = f"`{path}` is {shown(value)}{unit}, its lowest value is {shown(low)}{unit}"
        raise Unfit(said, "too low")
    if high is not None and value > high:
        said = f"`{path}` is {shown(value)}{unit}, its highest value is {shown(high)}{unit}"
        raise Unfit(said, "too high")
    return value


def _text(parameter: Parameter, path: str, scalar: Scalar) -> str:
    """A string; what every YAML 1.2 reader takes for a number or a bool must be quoted."""
    text = scalar.text
    if scalar.style is not Style.PLAIN or text in parameter.choices:
        return text
    if text.lower() in ("true", "false"):
        raise _wrong_type(parameter, path, f"the bool {text}", f'write "{text}" with quotes')
    if len(text) <= _LONGEST and (_FLOAT.fullmatch(text) or _BASED.fullmatch(text)):
        raise _wrong_type(parameter, path, f"the number {text}", f'write "{text}" with quotes')
    return text


def _number_or_bool(parameter: Parameter, path: str, text: str) -> Value:
    if len(text) > _LONGEST:
        raise _wrong_type(parameter, path, "a very long text")
    if parameter.kind == "bool":
        if text.lower() in _TRUE | _FALSE:
            return text.lower() in _TRUE
        raise _wrong_type(parameter, path, f"`{text}`")
    if _NOT_FINITE.fullmatch(text):
        raise Unfit(f"`{path}` is `{text}`, it must be a finite number")
    if _OCTAL_LOOK.fullmatch(text):
        plain = text.lstrip("+-").lstrip("0") or "0"
        raise Unfit(
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
    raise Unfit(f"`{path}` is {number}, it must be a finite number")


def _wrong_type(parameter: Parameter, path: str, found: str, help: str = "") -> Unfit:
    wanted = ARTICLE[parameter.kind]
    return Unfit(f"`{path}` must be {wanted}, not {found}", f"expected {parameter.kind}", help)


def _how_to_give(parameter: Parameter) -> str:
    if parameter.default is None:
        return f"write {ARTICLE[parameter.kind]} behind it"
    return f"write one, or remove the line to have the default {shown(parameter.default)}"


def shown(value: Value) -> str:
    """`value` as one writes it in YAML; a long one is cut."""
    match value:
        case bool():
            return str(value).lower()
        case float():
            return repr(value).removesuffix(".0")
        case int():
            return str(value) if abs(value) < 10**40 else f"{str(value)[:20]}…"
    return json.dumps(value, ensure_ascii=False) if len(value) < 80 else f'"{value[:60]}…"'
