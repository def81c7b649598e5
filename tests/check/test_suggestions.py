"""Suggestions of similar names: their number per module is limited."""

from __future__ import annotations

import difflib
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.check.names.type_names import MAX_SUGGESTIONS
from robocomp_dsl.check.passes import check_idsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report, nearest


def test_suggestions_are_limited_per_module(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    compared: list[str] = []
    real = difflib.get_close_matches

    def counted(word: str, *rest: Any) -> list[str]:
        compared.append(word)
        return real(word, *rest)

    monkeypatch.setattr(difflib, "get_close_matches", counted)
    unknown = "".join(f"Nonsense{n} f{n}; Flaot g{n};" for n in range(400))
    path = tmp_path / "a.idsl"
    path.write_text(f"module M {{ struct S {{ {unknown} }}; }};")
    report = Report()
    check_idsl(path, Workspace(environ={}), report)
    assert len(report) == 800
    assert 0 < len(compared) <= MAX_SUGGESTIONS
    labels = [diagnostic.label for diagnostic in report if "Flaot" in diagnostic.message]
    assert labels == ["did you mean `float`?"] * 400


@pytest.mark.parametrize(
    ("word", "known", "meant"),
    [
        ("LASER", ["Laser"], "Laser"),
        ("Lasr", ["Laser", "Lidar"], "Laser"),
        ("Lasr", ["Velocity"], None),
        ("Lasr", [f"Lamp{n}" for n in range(2000)] + ["Laser"], "Laser"),
        ("Lasr", [f"Xyz{n}" for n in range(2000)] + ["Laser"], "Laser"),
        ("x", [], None),
    ],
    ids=["case", "near", "far", "very many of one kind", "very many", "none"],
)
def test_nearest_name(word: str, known: list[str], meant: str | None) -> None:
    assert nearest(word, known) == meant
