"""Read taxel position files of the iCub.

In: the text of a file. Out: positions and normals by taxel index. Two forms: header words and a
[calibration] section, or (older) plain rows. A row has six numbers, `x y z nx ny nz` in metres in
the frame of its link; six zeros mean that the index has no taxel.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from robocomp_dsl.finding import Finding, SourceText
from robocomp_dsl.tactile.arrays import Bools, Floats
from robocomp_dsl.tactile.errors import DescriptionError, Fault

_SECTION = re.compile(r"\[\s*(\w+)\s*\]")
_HEADER = ("name", "spatial_sampling", "taxel2Repr")


@dataclass(frozen=True, eq=False)
class TaxelPositions:
    """Positions of taxels; row i belongs to taxel i of the published vector.

    `positions` and `normals` are (n, 3); normals have unit length, or are zero where the file has
    none. `used` (n,) is false for indices without a taxel.
    """

    name: str
    positions: Floats
    normals: Floats
    used: Bools


def read_positions(text: str, file: Path) -> TaxelPositions:
    """The content of a position file. Raises `DescriptionError` with all invalid rows."""
    source = SourceText.of_text(file, text)
    lines = source.lines
    sections = [m.group(1) for line in lines if (m := _SECTION.fullmatch(line.strip()))]
    findings: list[Finding] = []
    rows: list[tuple[float, ...]] = []
    name, section = file.stem, "" if sections else "calibration"
    for number, line in enumerate(lines, 1):
        stripped = line.strip()
        if match := _SECTION.fullmatch(stripped):
            section = match.group(1)
        elif stripped.startswith("name") and len(stripped.split()) == 2:
            name = stripped.split()[1]
        elif section == "calibration" and stripped and not stripped.startswith(("#", *_HEADER)):
            rows.append(_row(line, number, source, findings))
    if sections and "calibration" not in sections:
        findings.append(_finding(source, 1, 1, "the file has no [calibration] section"))
    elif not rows:
        findings.append(_finding(source, max(len(lines), 1), 1, "the file has no taxel"))
    if findings:
        raise DescriptionError(findings)
    return _positions(name, np.array(rows))


def _finding(source: SourceText, line: int, column: int, message: str) -> Finding:
    return Finding(source.word_at(line, column), message, kind=Fault.FORM)


def _row(line: str, number: int, source: SourceText, findings: list[Finding]) -> tuple[float, ...]:
    """The six numbers of a line; zeros, with a finding, if it is invalid."""
    words = list(re.finditer(r"\S+", line))
    if len(words) != 6:
        message = f"a row must have six numbers, x y z nx ny nz; it has {len(words)}"
        findings.append(_finding(source, number, words[0].start() + 1, message))
        return (0.0,) * 6
    return tuple(_number(word, number, source, findings) for word in words)


def _number(word: re.Match[str], line: int, source: SourceText, findings: list[Finding]) -> float:
    try:
        value = float(word.group())
    except ValueError:
        value = math.nan
    if math.isfinite(value):
        return value
    message = f"`{word.group()}` is not a number"
    findings.append(_finding(source, line, word.start() + 1, message))
    return 0.0


def _positions(name: str, rows: Floats) -> TaxelPositions:
    positions, normals = rows[:, :3].copy(), rows[:, 3:].copy()
    used = np.linalg.norm(positions, axis=1) > 0.0
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    np.divide(normals, length, out=normals, where=length > 0.0)
    return TaxelPositions(name, positions, normals, used)
