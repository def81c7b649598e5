"""The attributes of one InnerModel element, from texts to values.

In: the element and what its tag allows. Out: the values of the attributes that are right, by name;
the model's defaults stand in for the others, which are reported.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

from robocomp_dsl.check import codes_body as codes
from robocomp_dsl.check.imports import replace
from robocomp_dsl.check.innermodel_tags import (
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
    Kind,
    Tag,
)
from robocomp_dsl.diagnostics import Report, did_you_mean, nearest
from robocomp_dsl.syntax.ast_innermodel import Attribute, Element

_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?|[+-]?inf", re.IGNORECASE)
_OF_XML = re.compile(r"xmlns$|xmlns:|xml:|xsi:")
_PREFIXES = ("t", "r", "n", "p")
"""What older files leave out before the name of an axis."""

_UNIT = re.compile(r"(.*?[\d.])\s*([A-Za-z]+)")
_LARGEST_WHOLE = 2**31 - 1
_ENDLESS = (LIMIT, ANGLE_LIMIT, LENGTH_LIMIT)


class _Unfit(Exception):
    """The text is no value of its kind."""


def read_values(element: Element, tag: Tag, report: Report) -> dict[str, object]:
    """The values that `element` gives."""
    values: dict[str, object] = {}
    for one in element.attributes:
        name = one.name.text
        if name not in tag.attributes and _OF_XML.match(name):
            continue
        if name not in tag.attributes:
            name = _meant(one, element, tag.attributes)
            _unknown(one, element, tag.attributes, name, report)
        if not name:
            continue
        kind = tag.attributes[name]
        try:
            values[name] = _value(one.value.value.strip(), kind)
        except _Unfit:
            _misfit(one, kind, report)
    return values


def _meant(one: Attribute, element: Element, known: Mapping[str, Kind]) -> str:
    """The attribute that an unknown one stands for, if that is beyond doubt: `x` for `tx`."""
    written = one.name.text
    fits = [name for name in known if name.lower() == written.lower()]
    fits = fits or [name for p in _PREFIXES if (name := p + written) in known]
    return fits[0] if len(fits) == 1 and not element.get(fits[0]) else ""


def _value(text: str, kind: Kind) -> object:
    if isinstance(kind, tuple):
        if text.lower() not in kind:
            raise _Unfit
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
        raise _Unfit
    if kind not in (WHOLE, FLAG):
        return number
    if not number.is_integer() or abs(number) > _LARGEST_WHOLE:
        raise _Unfit
    return number > 0 if kind == FLAG else int(number)


def _number(text: str) -> float:
    if not _NUMBER.fullmatch(text):
        raise _Unfit
    return float(text)


def _triple(given: list[float], kind: Kind) -> tuple[float, float, float]:
    """Sizes and scales may leave out the last numbers (RoboComp, InnerModelReader)."""
    match given, kind:
        case [one], _:
            return (one, one, one if kind == SCALE else one / 100)
        case [one, two], _:
            return (one, two, one if kind == SCALE else min(one, two) / 100)
        case [one, two, three], _:
            return (one, two, three)
    raise _Unfit


def _unknown(
    one: Attribute, element: Element, known: Mapping[str, Kind], taken: str, report: Report
) -> None:
    name, tag = one.name.text, element.tag.text
    meant = next((p + name for p in _PREFIXES if p + name in known), "")
    label = f"did you mean `{meant}`?" if meant else did_you_mean(name, known)
    case = nearest(name, known)
    spelt = (
        f"attributes are case-sensitive: `{case}`" if case and case.lower() == name.lower() else ""
    )
    done = f"until then it is taken as `{taken}`" if taken else ""
    report.add(
        codes.BODY_ATTRIBUTE,
        one.name.span,
        f"`{tag}` has no attribute `{name:.60}`",
        label=label or "it is not used",
        help=spelt or done or ("" if label else f"it has {', '.join(f'`{n}`' for n in known)}"),
        fix=replace(one.name.span, meant) if meant and not element.get(meant) else None,
    )


def _misfit(one: Attribute, kind: Kind, report: Report) -> None:
    text = one.value.value
    if isinstance(kind, tuple):
        expected = "one of " + ", ".join(f"`{word}`" for word in kind)
        label = did_you_mean(text, kind)
    else:
        expected, label = kind, ""
    report.add(
        codes.BODY_VALUE,
        one.value.span,
        f'`{one.name.text}` must be {expected}, not "{text:.40}"',
        label=label,
        help="with a decimal point, as in `0.5`" if re.fullmatch(r"[+-]?\d+,\d+", text) else "",
    )
