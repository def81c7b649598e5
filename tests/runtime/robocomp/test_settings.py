"""Old workers get their parameters as the old file spelled them."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from robocomp_dsl.runtime.robocomp.settings import Setting, old_settings

SETTINGS: tuple[Setting, ...] = (
    (("Laser", "Rate"), "Laser.Rate", False, {0.5: "0.50"}),
    (("show",), "show", False, {True: "TRUE", False: "FALSE"}),
    (("plain",), "plain", False, {}),
)


def params(**values: Any) -> Any:
    return SimpleNamespace(values=lambda: {"Laser.Rate": 0.5, "show": True, "plain": 2.0} | values)


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ({}, {"Laser.Rate": "0.50", "show": "TRUE", "plain": "2"}),
        (
            {"show": False, "plain": False},
            {"Laser.Rate": "0.50", "show": "FALSE", "plain": "false"},
        ),
        ({"Laser.Rate": 0.75}, {"Laser.Rate": "0.75", "show": "TRUE", "plain": "2"}),
    ],
)
def test_old_settings_keep_spelling_of_unchanged_values(
    values: dict[str, Any], expected: dict[str, str]
) -> None:
    assert old_settings(params(**values), SETTINGS, tables=False) == expected


def test_old_settings_have_lists_of_values() -> None:
    settings: tuple[Setting, ...] = (
        (("Joints", "Gains"), "Joints.Gains", True, {}),
        (("former",), "former", True, {}),
    )
    values = {"Joints.Gains": [1.0, 2.5], "former[0].value": 1, "former[1].value": 2}
    tables = old_settings(params(**values), settings, tables=True)
    assert tables == {"Joints": {"Gains": [1.0, 2.5]}, "former": [1, 2]}


def test_old_settings_of_tables_have_values() -> None:
    tables = old_settings(params(), SETTINGS, tables=True)
    assert tables == {"Laser": {"Rate": 0.5}, "show": True, "plain": 2.0}
