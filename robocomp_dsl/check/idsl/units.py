"""Units in brackets: `[mm]`, `[rad/s^2]`.

In: a unit and whether its value is a number. Out: diagnostics.
"""

from __future__ import annotations

import re
from typing import Protocol

from robocomp_dsl.check.codes import types as codes
from robocomp_dsl.diagnostics import Edit, Fix, Report, nearest
from robocomp_dsl.model import types
from robocomp_dsl.syntax.ast.base import Unit

KNOWN = frozenset(
    """m mm cm km um rad mrad deg s ms us ns min h Hz kHz MHz GHz N mN kN Nm kg g A mA V mV W kW Wh
    Ah mAh J Pa kPa MPa bar K degC lx lm dB dBm Bd T mT uT ohm F % px bytes B kB MB bit steps
    ticks counts rpm taxel fps""".split()  # noqa: SIM905 - a table is easier to read
)
WRITTEN_OUT = {
    **dict.fromkeys(("degree", "degrees", "grad"), "deg"),
    **dict.fromkeys(("radian", "radians"), "rad"),
    **dict.fromkeys(("meter", "meters", "metre", "metres"), "m"),
    **dict.fromkeys(("second", "seconds", "sec", "secs"), "s"),
    **dict.fromkeys(("millimeter", "millimeters", "millimetre", "millimetres"), "mm"),
    **dict.fromkeys(("millisecond", "milliseconds", "msec"), "ms"),
    **dict.fromkeys(("newton", "newtons"), "N"),
    **dict.fromkeys(("volt", "volts"), "V"),
    **dict.fromkeys(("pixel", "pixels"), "px"),
    "percent": "%",
    "celsius": "degC",
    "step": "steps",
    "tick": "ticks",
    "count": "counts",
    "taxels": "taxel",
}
"""Symbols of units whose names people write out."""
_BY_LETTERS = {unit.lower(): unit for unit in sorted(KNOWN)} | WRITTEN_OUT
_WORD = re.compile(r"[A-Za-z]+")
_PRODUCT = re.compile(r"[A-Za-z]+(?:\^?\d)?(?:[/* ][A-Za-z]+(?:\^?\d)?)*")


class UnitCheck(Protocol):
    """`check_unit` or `check_suffix`."""

    def __call__(self, unit: Unit, what: str, report: Report, *, is_number: bool) -> None:
        """Report what is wrong with `unit`."""


def holds_number(type_: types.Type) -> bool:
    """Whether a value of this type can have a unit; that of a struct applies to its numbers."""
    match type_:
        case types.Primitive():
            return type_ in types.NUMBERS
        case types.Enum():
            return False
        case types.Sequence():
            return holds_number(type_.element)
    return True


def check_unit(unit: Unit, what: str, report: Report, *, is_number: bool) -> None:
    """Report the unit of a value that is not a number, and a unit that is not written as usual."""
    if not is_number:
        report.add(
            codes.UNIT_WITHOUT_NUMBER,
            unit.span,
            f"{what} is not a number and has no unit",
            fix=Fix("remove the unit", (Edit(unit.span, ""),)),
        )
        return
    right = _WORD.sub(_with_known_case, unit.text)
    if right != unit.text:
        report.add(
            codes.UNIT_CASE,
            unit.span,
            f"the unit `{unit.text}` is usually written `{right}`",
            label=f"did you mean `[{right}]`?",
            fix=Fix(f"change to `[{right}]`", (Edit(unit.span, f"[{right}]"),)),
        )


def check_suffix(unit: Unit, what: str, report: Report, *, is_number: bool) -> None:
    """As `check_unit`; text in brackets that is no unit is an error."""
    text = _WORD.sub(_with_known_case, unit.text)
    if len(unit.text) == 1:  # `n` is more probably a number than newtons
        text = unit.text
    unknown = None if _is_product_of_known(text) else _unknown_word(text)
    if unknown is None:
        check_unit(unit, what, report, is_number=is_number)
        return
    guess = _BY_LETTERS.get(unknown.lower()) or nearest(unknown, (*KNOWN, *WRITTEN_OUT))
    guess = WRITTEN_OUT.get(guess, guess) if guess else None
    right = f"[{text.replace(unknown, guess)}]" if guess else ""
    report.add(
        codes.UNKNOWN_UNIT,
        unit.span,
        f"`{unit.text}` is not a unit" if unit.text else "the unit is missing",
        label=f"did you mean `{right}`?" if right else "",
        help="brackets have a unit, such as `[mm/s]`, or the length of an array, such as `[36]`; "
        "what is counted belongs into a comment",
        fix=Fix(f"change to `{right}`", (Edit(unit.span, right),)) if right else None,
    )


def _is_product_of_known(text: str) -> bool:
    """Whether a unit such as `mm/s^2` has known words only; it saves the parser of units."""
    return text in KNOWN or (
        _PRODUCT.fullmatch(text) is not None and KNOWN.issuperset(_WORD.findall(text))
    )


def _unknown_word(text: str) -> str | None:
    """The first word of a unit that has no meaning, or the text if it is no unit."""
    from robocomp_dsl.model import units  # noqa: PLC0415 - it takes 15 ms, and few files need it

    try:
        units.parse_unit(text)
    except units.InvalidUnit:
        return text
    return next(iter(units.unknown_words(text)), None)


def _with_known_case(word: re.Match[str]) -> str:
    text = word.group()
    return text if text in KNOWN else _BY_LETTERS.get(text.lower(), text)
