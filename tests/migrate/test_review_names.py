"""Names that came with RoboComp's `genericworker`, and are defined nowhere now, are reported."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.regeneration.user_module import parsed
from robocomp_dsl.migrate.review_names import review_names
from robocomp_dsl.source import Source

NAMES = {"RoboCompLaser": frozenset({"TData"})}
STAR = "from genericworker import *\n"


def findings(text: str) -> list[tuple[int, str]]:
    """Line and name of the findings about a module."""
    report = Report()
    module = parsed(Source(Path("specificworker.py"), text))
    review_names([module], NAMES, frozenset({"laserI"}), report)
    assert {f.code.id for f in report} <= {"RC899"}
    return [(f.span.start_position[0], f.message.split("`")[1]) for f in report.sorted()]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (f"{STAR}def f():\n    rDebug('x')\n", [(3, "rDebug")]),
        ("def f():\n    return TData()\n", [(2, "TData")]),
        (f"{STAR}x = nowhere\ny = nowhere\n", [(2, "nowhere")]),
        (f"{STAR}class A:\n    def f(self):\n        return [b for a in self.x]\n", [(4, "b")]),
    ],
)
def test_review_names_reports_line(text: str, expected: list[tuple[int, str]]) -> None:
    assert findings(text) == expected


@pytest.mark.parametrize(
    "text",
    [
        f"{STAR}x = TData(), RoboCompLaser.TData(), Ice.Exception, os, sys, QtCore, ROBOCOMP\n",
        f"{STAR}from math import *\nx = sin(pi)\n",
        "from RoboCompLaser import *\nfrom laserI import *\nx = TData()\n",
        "from somewhere_else import *\nx = nowhere\n",
        "from PySide2.QtWidgets import *\nx = QWidget()\n",
        "def f():\n    global late\n    late = 1\ndef g():\n    return late\n",
        "def f(a, *b, c=1, **d):\n    e = lambda g: g + a\n    return b, c, d, e, __file__\n",
        "try:\n    import x as y\nexcept ImportError as error:\n    print(error)\ny\n",
        "with open('a') as f:\n    pass\nfor i, (j, k) in []: print(i, j, k, f)\nif n := 3: n\n",
        "class A:\n    b = 1\n    c = b\n    def d(self): return __class__\n",
        "match x():\n    case {'a': y}: y\ndef x(): ...\n",
    ],
)
def test_review_names_accepts(text: str) -> None:
    assert findings(text) == []


def test_review_names_loads_no_module_that_does_something() -> None:
    """`antigravity` opens a web browser; `tkinter` may have no display."""
    assert findings("from antigravity import *\nx = nowhere\n") == []
    assert "antigravity" not in sys.modules
