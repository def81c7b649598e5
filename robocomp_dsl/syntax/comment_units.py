"""Units in the comments of ROS and YARP definitions: `[rad]`, `(m/s)`, `in meters`.

In: a comment. Out: its unit, if it states exactly one, and the comment without it.
"""

from __future__ import annotations

import re

_SYMBOLS = """m mm cm km s ms us ns rad deg Hz kHz N Nm V mV A mA Ah W J Pa T kg g lx px degC
    m/s mm/s m/s^2 rad/s rad/s^2 deg/s deg/s^2 m^2 m^3 Nm/rad N/m Hz/s""".split()  # noqa: SIM905
_ALONE = frozenset(symbol for symbol in _SYMBOLS if len(symbol) > 1) | {"m", "s"}
"""Symbols that are a unit also without brackets, if they are the whole comment."""
_WORDS = {
    "meter": "m",
    "metre": "m",
    "millimeter": "mm",
    "millimetre": "mm",
    "centimeter": "cm",
    "centimetre": "cm",
    "second": "s",
    "sec": "s",
    "millisecond": "ms",
    "microsecond": "us",
    "nanosecond": "ns",
    "radian": "rad",
    "degree": "deg",
    "hertz": "Hz",
    "newton": "N",
    "volt": "V",
    "amp": "A",
    "ampere": "A",
    "watt": "W",
    "joule": "J",
    "pascal": "Pa",
    "tesla": "T",
    "lux": "lx",
    "kilogram": "kg",
    "pixel": "px",
    "degrees celsius": "degC",
    "degree celsius": "degC",
    "meters per second": "m/s",
    "metres per second": "m/s",
    "radians per second": "rad/s",
    "degrees per second": "deg/s",
    "newton meter": "Nm",
    "newton metre": "Nm",
}
_UNITS = (
    {symbol: symbol for symbol in _SYMBOLS}
    | _WORDS
    | {f"{word}s": unit for word, unit in _WORDS.items() if not word.endswith("second")}
    | {"seconds": "s", "milliseconds": "ms", "microseconds": "us", "nanoseconds": "ns"}
)
_BRACKETS = re.compile(r"\[([^\[\]]+)\]")
_PARENTHESES = re.compile(r"\((?:in\s+)?([^()]+)\)", re.IGNORECASE)
_LONGEST_FIRST = sorted((unit for unit in _UNITS if len(unit) > 2), key=len, reverse=True)
_PHRASE = re.compile(
    rf"\bin\s+({'|'.join(map(re.escape, _LONGEST_FIRST))})"
    r"(?![\w/^]|\s+(?:per|squared|cubed|times)\b)",
    re.IGNORECASE,
)


def unit_in(comment: str) -> tuple[str, str]:
    """The unit that a comment states, and the comment without it; "" if it states none.

    Brackets count first: `[rad]`. Otherwise the unit is the whole comment, is in parentheses or
    follows "in", and there is no other: `radians`, `(m/s)`, `range in meters`.
    """
    for found in _BRACKETS.finditer(comment):
        if unit := _unit(found[1]):
            before, behind = comment[: found.start()].rstrip(), comment[found.end() :].lstrip()
            return unit, comment if before and behind else before + behind
    whole = comment.strip().rstrip(".")
    if unit := _unit(whole):
        is_clear = whole in _ALONE or whole not in _SYMBOLS
        return (unit, "") if is_clear else ("", comment)
    words = (*_PARENTHESES.findall(comment), *_PHRASE.findall(comment))
    units = {unit for word in words if (unit := _unit(word))}
    return (units.pop(), comment) if len(units) == 1 else ("", comment)


def _unit(word: str) -> str:
    word = " ".join(word.split())
    return _UNITS.get(word) or (_UNITS.get(word.lower(), "") if len(word) > 2 else "")
