"""Units in brackets: `[mm]`, `[rad/s^2]`.

In: a unit as written and whether its place holds a number. Out: findings. A unit is documentation:
any is accepted, but not one that only its letters' case keeps from being a known one.
"""

from __future__ import annotations

import re

from robocomp_dsl.check import codes
from robocomp_dsl.diagnostics import Edit, Fix, Report
from robocomp_dsl.syntax.ast_base import Unit

KNOWN = frozenset(
    """m mm cm km um rad mrad deg s ms us ns min h Hz kHz MHz GHz N mN kN Nm kg g A mA V mV W kW Wh
    Ah mAh J Pa kPa MPa bar K degC lx lm dB dBm Bd T mT uT ohm F % px bytes B kB MB bit steps
    ticks counts rpm taxel fps""".split()  # noqa: SIM905 - a table is easier to read
)
_BY_LETTERS = {unit.lower(): unit for unit in sorted(KNOWN)}
_WORD = re.compile(r"[A-Za-z]+")


def judge_unit(unit: Unit, what: str, report: Report, *, is_number: bool) -> None:
    """Report a unit of something that is no number, and one with the wrong case."""
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
