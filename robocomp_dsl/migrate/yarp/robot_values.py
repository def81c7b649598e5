"""Reads parameters of YARP's devices: texts of Bottles as numbers and words.

In: the parameters of a device. Out: lists. Names are compared without case.
"""

from __future__ import annotations

import math
import re

from robocomp_dsl.migrate.yarp.robot_files import Values

_WORD = re.compile(r'"([^"]*)"|([^\s(),"]+)')


def text(values: Values, *path: str) -> str:
    """The text at `path`, such as `LIMITS`, `jntPosMax`; empty if there is none."""
    found: str | Values = values
    for key in path:
        if isinstance(found, str):
            return ""
        matches = [value for name, value in found.items() if name.lower() == key.lower()]
        if not matches:
            return ""
        found = matches[0]
    return found if isinstance(found, str) else ""


def words(written: str) -> list[str]:
    """The words of a text, without brackets and quotes."""
    return [quoted or plain for quoted, plain in _WORD.findall(written)]


def numbers(written: str) -> list[float]:
    """The numbers of a text; empty if a word is no finite number."""
    result = []
    for word in words(written):
        try:
            number = float(word)
        except ValueError:
            return []
        if not math.isfinite(number):
            return []
        result.append(number)
    return result


def integers(written: str) -> list[int]:
    """The whole numbers of a text; empty if a word is none, or large."""
    values = numbers(written)
    return [int(v) for v in values] if all(v == int(v) and abs(v) < 10000 for v in values) else []
