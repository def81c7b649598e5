"""Units of measurement as data: dimension, factor and offset of a text such as `rad/s`, `N m`.

In: a unit as users write it, without brackets. Out: a `MeasureUnit`; conversions between two.

This module is our own because of the start-up time: with pint 0.25.3 on a 2-core machine `import
pint` takes 160 … 180 ms and its `UnitRegistry()` another 220 … 240 ms (5 runs), this module 15 ms;
the goal for a whole check is 150 ms. Factors and symbols: SI brochure, 9th edition (BIPM 2019),
tables 2, 4, 7 and 8. Factors are fractions and powers of pi, so mm → µm is exactly 1000.

The angle is a dimension of its own, so that rad/s and Hz differ. A word without entry is a base
unit with its own dimension: `ticks` converts to `ticks` only.
"""

from __future__ import annotations

import math
import re
from fractions import Fraction

from robocomp_dsl.record import ValueRecord

Dimension = tuple[tuple[str, int], ...]
"""Base units and their exponents, sorted, without zeros; `()` is a plain number."""


class InvalidUnit(ValueError):
    """A text that is no unit; the message says what is wrong."""


class MeasureUnit(ValueRecord):
    """A unit: value in base units = value · `factor` · pi^`pi` + `offset`."""

    dimension: Dimension
    factor: Fraction = Fraction(1)
    pi: int = 0
    offset: Fraction = Fraction(0)

    @property
    def is_plain(self) -> bool:
        """Whether it has no dimension: `1`, `%`."""
        return not self.dimension

    def product(self, other: MeasureUnit, exponent: int = 1) -> MeasureUnit:
        """The unit times a power of `other`, for differences of temperature: it has no offset."""
        powers = dict(self.dimension)
        for base, count in other.dimension:
            powers[base] = powers.get(base, 0) + count * exponent
        dimension = tuple(sorted((base, count) for base, count in powers.items() if count))
        factor = self.factor * other.factor**exponent
        return MeasureUnit(dimension, factor, self.pi + other.pi * exponent)

    def without_angle(self) -> MeasureUnit:
        """The same with rad as a plain number, as in arc length = angle · radius."""
        rest = tuple((base, count) for base, count in self.dimension if base != "rad")
        return self.replace(dimension=rest)


def conversion(source: MeasureUnit, target: MeasureUnit) -> tuple[float, float] | None:
    """Factor and offset from `source` to `target`; None if their dimensions differ."""
    if source.dimension != target.dimension:
        return None
    pi = math.pi ** (source.pi - target.pi)
    offset = (source.offset - target.offset) / target.factor
    return float(source.factor / target.factor) * pi, float(offset)


def parse_unit(text: str) -> MeasureUnit:
    """The unit of a text. Raises `InvalidUnit`."""
    tokens = _TOKEN.findall(text)
    if not text.strip() or "".join(tokens) != re.sub(r"\s+", "", text):
        raise InvalidUnit(f"`{text}` is no unit; write such as `rad/s`, `m/s^2` or `N m`")
    if len(tokens) == 1 and tokens[0] in _SYMBOLS:
        return _SYMBOLS[tokens[0]]
    unit, rest = _product(tokens, text)
    if rest:
        raise InvalidUnit(f"`{text}` has an unexpected `{rest[0]}`")
    return unit


def unknown_words(text: str) -> list[str]:
    """The words of a unit that have no entry, and so no conversion to another unit."""
    words = (word for word in _TOKEN.findall(text) if _WORD.fullmatch(word))
    return [word for word in words if _find(_split_digits(word)[0]) is None]


def known_units() -> list[str]:
    """Symbols for suggestions, with the prefixes that are usual in robotics."""
    prefixed = (f"{p}{s}" for p in ("m", "k", "u", "c", "M", "G", "n") for s in _PREFIXED)
    return sorted({*_SYMBOLS, *prefixed})


_TOKEN = re.compile(r"\*\*|[*/^()·.]|[+-]?\d+|[²³]|[A-Za-zµΩ°%_][A-Za-z0-9µΩ°_]*")
_WORD = re.compile(r"[A-Za-zµΩ°%_][A-Za-z0-9µΩ°_]*")
_POWERS = {"²": 2, "³": 3}
_NUMBER = re.compile(r"[+-]?\d+")


def _product(tokens: list[str], text: str) -> tuple[MeasureUnit, list[str]]:
    """The product at the start of `tokens`, and the tokens after it."""
    unit, rest = _power(tokens, text)
    while rest and rest[0] != ")":
        sign = -1 if rest[0] == "/" else 1
        factor, rest = _power(rest[1:] if rest[0] in ("/", "*", "·", ".") else rest, text)
        unit = unit.product(factor, sign)
    return unit, rest


def _power(tokens: list[str], text: str) -> tuple[MeasureUnit, list[str]]:
    if not tokens:
        raise InvalidUnit(f"`{text}` ends too early")
    head, *rest = tokens
    exponent = 1
    if head == "(":
        unit, rest = _product(rest, text)
        if not rest:
            raise InvalidUnit(f"`{text}` lacks a `)`")
        rest = rest[1:]
    elif head == "1":
        unit = MeasureUnit(())
    elif _WORD.fullmatch(head):
        word, exponent = _split_digits(head)
        unit = _find(word) or MeasureUnit(((word, 1),))
    else:
        raise InvalidUnit(f"`{text}` has an unexpected `{head}`")
    if rest and rest[0] in ("^", "**"):
        if len(rest) < 2 or not _NUMBER.fullmatch(rest[1]) or abs(int(rest[1])) > 9:
            raise InvalidUnit(f"`{text}`: a whole number up to 9 follows `{rest[0]}`")
        exponent, rest = int(rest[1]), rest[2:]
    elif rest and rest[0] in _POWERS:
        exponent, rest = _POWERS[rest[0]], rest[1:]
    return MeasureUnit(()).product(unit, exponent), rest


def _split_digits(word: str) -> tuple[str, int]:
    """`s2` is `s` squared, unless there is a symbol of this name."""
    stem = word.rstrip("0123456789")
    digits = word[len(stem) :]
    return (stem, int(digits)) if len(digits) == 1 and _find(stem) else (word, 1)


def _find(word: str) -> MeasureUnit | None:
    """The unit of a symbol, with or without a prefix."""
    if word in _SYMBOLS:
        return _SYMBOLS[word]
    for prefix, power in _PREFIXES.items():
        stem = word.removeprefix(prefix)
        if stem != word and stem in _PREFIXED:
            unit = _SYMBOLS[stem]
            return unit.replace(factor=unit.factor * Fraction(10) ** power)
    return None


_PREFIXES = {
    prefix: int(power)
    for prefix, power in re.findall(
        r"(\S+?)(-?\d+)", "T12 G9 M6 k3 h2 da1 d-1 c-2 m-3 u-6 µ-6 n-9 p-12"
    )
}
_SYMBOLS: dict[str, MeasureUnit] = {"1": MeasureUnit(()), "%": MeasureUnit((), Fraction(1, 100))}
_BASES = "kg m s A K mol cd rad bit px dB dBm Bd ticks steps counts taxel fps"
_DERIVED = """
g 1/1000 kg; Hz 1 1/s; N 1 kg m/s^2; Pa 1 N/m^2; J 1 N m; W 1 J/s; C 1 A s; V 1 W/A; F 1 C/V
ohm 1 V/A; Ω 1 V/A; S 1 A/V; Wb 1 V s; T 1 Wb/m^2; H 1 Wb/A; sr 1 rad^2; lm 1 cd sr; lx 1 lm/m^2
min 60 s; h 3600 s; d 86400 s; l 1/1000 m^3; L 1/1000 m^3; bar 100000 Pa; t 1000 kg; in 127/5000 m
ft 381/1250 m; gauss 1/10000 T; Wh 3600 J; Ah 3600 C; Nm 1 N m; B 8 bit; byte 8 bit; bytes 8 bit
"""
"""Symbol, factor and unit, each defined by earlier ones."""
_ANGLES = {"deg": (1, 180), "°": (1, 180), "grad": (1, 200), "rev": (2, 1), "turn": (2, 1)}
_PREFIXED = frozenset(
    "m g s A K mol cd rad bit Hz N Pa J W C V F ohm Ω S Wb T H lm lx l L bar Wh Ah Nm B".split()  # noqa: SIM905 - a table is easier to read
)


def _fill_symbols() -> None:
    """Compute the table of symbols from the definitions."""
    for base in _BASES.split():
        _SYMBOLS[base] = MeasureUnit(((base, 1),))
    for definition in _DERIVED.replace("\n", ";").split(";"):
        if definition:
            symbol, factor, unit = definition.strip().split(" ", 2)
            base_unit = parse_unit(unit)
            _SYMBOLS[symbol] = base_unit.replace(factor=base_unit.factor * Fraction(factor))
    for symbol, (parts, whole) in _ANGLES.items():
        _SYMBOLS[symbol] = MeasureUnit((("rad", 1),), Fraction(parts, whole), 1)
    _SYMBOLS["rpm"] = MeasureUnit((("rad", 1), ("s", -1)), Fraction(2, 60), 1)
    kelvin = (("K", 1),)
    celsius = MeasureUnit(kelvin, Fraction(1), 0, Fraction(27315, 100))
    _SYMBOLS["degC"] = _SYMBOLS["°C"] = celsius
    _SYMBOLS["degF"] = MeasureUnit(kelvin, Fraction(5, 9), 0, Fraction(45967, 180))


_fill_symbols()
