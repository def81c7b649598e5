"""The table of process states."""

from __future__ import annotations

from dataclasses import replace

import pytest

from robocomp_dsl.deploy import status


def test_format_table_aligns_columns() -> None:
    rows = [
        status.ProcessStatus(
            "arm", status.READY, 4711, 3725.0, 2, 0.256, 52_400_000, "hot", "emergency"
        ),
        status.ProcessStatus("base", status.WAITING, note="for arm"),
    ]
    assert status.format_table(rows, 200, colours=False) == [
        "NAME  STATE    LIFE       PID   UP         RESTARTS  CPU   MEMORY",
        "arm   ready    emergency  4711  1 h 2 min  2         26 %  52 MB   hot",
        "base  waiting  -          -     -          0         -     -       for arm",
    ]
    moving = replace(rows[0], machine=("moving", "left", "right"))
    assert [line[15:51] for line in status.format_table([moving, rows[1]], 200, colours=False)] == [
        "LIFE       MACHINE              PID ",
        "emergency  moving, left, right  4711",
        "-          -                    -   ",
    ]
    assert all(len(line) <= 20 for line in status.format_table(rows, 20, colours=False))
    assert status.format_table(rows, 200, colours=True)[1].startswith("\x1b[32marm")


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(0.04, "0.0 s"), (59.94, "59.9 s"), (60, "1 min 0 s"), (3600, "1 h 0 min")],
)
def test_format_duration_selects_units(seconds: float, text: str) -> None:
    assert status.format_duration(seconds) == text
