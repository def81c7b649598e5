"""Units in brackets: `[mm]`, `[rad/s^2]`.

In: a unit and whether its value is a number. Out: diagnostics. Units are documentation: any unit is
accepted, but not one that differs from a known unit only in case.
"""

from __future__ import annotations

import re

from robocomp_dsl.check.codes import types as codes
from robocomp_dsl.diagnostics import Edit, Fix, Report
from robocomp_dsl.model import types
from robocomp_dsl.syntax.ast.base import Unit

KNOWN = frozenset(
    """m mm cm km um rad mrad deg s ms us ns min h Hz kHz MHz GHz N mN kN Nm kg g A mA V mV W kW Wh
    Ah mAh J Pa kPa MPa bar K degC lx lm dB dBm Bd T mT uT ohm F % px bytes B kB MB bit steps
    ticks counts rpm taxel fps""".split()  # noqa: SIM905 - a table is easier to read
)
_BY_LETTERS = {unit.lower(): unit for unit in sorted(KNOWN)}
_WORD = re.compile(r"[A-Za-z]+")


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
    """Report the unit of a value that is not a number, and a unit with the wrong case."""
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


def _with_known_case(word: re.Match[str]) -> str:
    text = word.group()
    return text if text in KNOWN else _BY_LETTERS.get(text.lower(), text)
