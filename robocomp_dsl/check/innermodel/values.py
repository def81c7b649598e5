"""Converts the attributes of an InnerModel element to values.

In: the element and its tag. Out: the values of the valid attributes by name; invalid ones are
reported and have the default of the model.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

from robocomp_dsl.check.codes import innermodel as codes
from robocomp_dsl.check.innermodel.tags import (
    ANGLE_LIMIT,
    EXTENT,
    FLAG,
    LENGTH_LIMIT,
    LENGTHS,
    LIMIT,
    SCALE,
    TEXT,
    UNITS,
    WHOLE,
    InnerModelTag,
    Kind,
)
from robocomp_dsl.check.workspace.imports import replace_fix
from robocomp_dsl.diagnostics import Report, did_you_mean, nearest
from robocomp_dsl.syntax.ast.innermodel import Attribute, Element

_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?|[+-]?inf", re.IGNORECASE)
_OF_XML = re.compile(r"xmlns$|xmlns:|xml:|xsi:")
_PREFIXES = ("t", "r", "n", "p")
"""Prefixes of axis attributes that older files omit."""

_UNIT = re.compile(r"(.*?[\d.])\s*([A-Za-z]+)")
_LARGEST_WHOLE = 2**31 - 1
_ENDLESS = (LIMIT, ANGLE_LIMIT, LENGTH_LIMIT)


class _InvalidValue(Exception):
    """The text is not a valid value of its kind."""


def read_values(element: Element, tag: InnerModelTag, report: Report) -> dict[str, object]:
    """The values of the attributes of `element`."""
    values: dict[str, object] = {}
    for attribute in element.attributes:
        name = attribute.name.text
        if name not in tag.attributes and _OF_XML.match(name):
            continue
        if name not in tag.attributes:
            name = _intended_name(attribute, element, tag.attributes)
            _report_unknown(attribute, element, tag.attributes, name, report)
        if not name:
            continue
        kind = tag.attributes[name]
        try:
            values[name] = _value(attribute.value.value.strip(), kind)
        except _InvalidValue:
            _report_invalid(attribute, kind, report)
    return values


def _intended_name(attribute: Attribute, element: Element, known: Mapping[str, Kind]) -> str:
    """The attribute that an unknown one obviously means (`x` for `tx`), or an empty string."""
    written = attribute.name.text
    fits = [name for name in known if name.lower() == written.lower()]
    fits = fits or [name for p in _PREFIXES if (name := p + written) in known]
    return fits[0] if len(fits) == 1 and not element.get(fits[0]) else ""


def _value(text: str, kind: Kind) -> object:
    if isinstance(kind, tuple):
        if text.lower() not in kind:
            raise _InvalidValue
        return text.lower()
    if kind == TEXT:
        return text
    if kind in (EXTENT, SCALE):
        return _triple([_number(part.strip()) for part in text.split(",")], kind)
    if kind == LENGTHS:
        return tuple(_one_number(part.strip(), kind) for part in text.split(","))
    return _one_number(text, kind)


def _one_number(text: str, kind: Kind) -> float:
    units = UNITS.get(kind, {})
    found = _UNIT.fullmatch(text)
    if found and found[2] in units:
        return _one_number(found[1], kind) * units[found[2]]
    number = _number(text)
    if math.isinf(number) and kind not in _ENDLESS:
        raise _InvalidValue
    if kind not in (WHOLE, FLAG):
        return number
    if not number.is_integer() or abs(number) > _LARGEST_WHOLE:
        raise _InvalidValue
    return number > 0 if kind == FLAG else int(number)


def _number(text: str) -> float:
    if not _NUMBER.fullmatch(text):
        raise _InvalidValue
    return float(text)


def _triple(numbers: list[float], kind: Kind) -> tuple[float, float, float]:
    """Three numbers; sizes and scales may omit the last ones (RoboComp, InnerModelReader)."""
    match numbers, kind:
        case [first], _:
            return (first, first, first if kind == SCALE else first / 100)
        case [first, second], _:
            return (first, second, first if kind == SCALE else min(first, second) / 100)
        case [first, second, third], _:
            return (first, second, third)
    raise _InvalidValue


def _report_unknown(
    attribute: Attribute, element: Element, known: Mapping[str, Kind], taken: str, report: Report
) -> None:
    name, tag = attribute.name.text, element.tag.text
    meant = next((p + name for p in _PREFIXES if p + name in known), "")
    label = f"did you mean `{meant}`?" if meant else did_you_mean(name, known)
    case = nearest(name, known)
    spelt = (
        f"attributes are case-sensitive: `{case}`" if case and case.lower() == name.lower() else ""
    )
    done = f"interpreted as `{taken}`" if taken else ""
    report.add(
        codes.INNERMODEL_ATTRIBUTE,
        attribute.name.span,
        f"`{tag}` has no attribute `{name:.60}`",
        label=label or "ignored",
        help=spelt or done or ("" if label else f"it has {', '.join(f'`{n}`' for n in known)}"),
        fix=replace_fix(attribute.name.span, meant) if meant and not element.get(meant) else None,
    )


def _report_invalid(attribute: Attribute, kind: Kind, report: Report) -> None:
    text = attribute.value.value
    if isinstance(kind, tuple):
        expected = "one of " + ", ".join(f"`{word}`" for word in kind)
        label = did_you_mean(text, kind)
    else:
        expected, label = kind, ""
    report.add(
        codes.INNERMODEL_VALUE,
        attribute.value.span,
        f'`{attribute.name.text}` must be {expected}, not "{text:.40}"',
        label=label,
        help="use a decimal point, as in `0.5`" if re.fullmatch(r"[+-]?\d+,\d+", text) else "",
    )
