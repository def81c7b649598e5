"""Code that does not run as before is reported with its line."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.regeneration.user_module import UserModule, parsed
from robocomp_dsl.migrate.review import bare_names, review_modules
from robocomp_dsl.source import Source

NAMES = {"RoboCompLaser": frozenset({"TData", "TLaserData"})}


def module(text: str, name: str = "specificworker.py") -> UserModule:
    return parsed(Source(Path(name), text))


def findings(text: str, helper: str = "", local: str = "helper") -> list[tuple[str, str, int]]:
    report = Report()
    modules = {"helper": module(helper, "helper.py"), "unused": module("import nowhere_at_all")}
    review_modules(module(text), modules, NAMES, frozenset({local}), report)
    return [(f.code.id, f.span.source.path.name, f.span.start_position[0]) for f in report.sorted()]


@pytest.mark.parametrize(
    ("text", "code", "line"),
    [
        ("import os\nimport nowhere_at_all\n", "RC895", 2),
        ("from nowhere_at_all.x import y\n", "RC895", 1),
        ("import librobocomp_qmat\n", "RC895", 1),
        ("from genericworker import *\nx = RoboCompLaser.TOther()\n", "RC896", 2),
        ("import interfaces as ifaces\nx = ifaces.RoboCompLaser.TOther()\n", "RC896", 2),
        ("from RoboCompLaser import TOther\n", "RC896", 1),
        ("import RoboCompBase\n", "RC896", 1),
        ("import interfaces as i\nx = i.RoboCompBase.TState()\n", "RC896", 2),
        ("class SpecificWorker(G):\n    def restore(self): ...\n", "RC897", 2),
        ("import signal\nsignal.signal(2, f)\n", "RC899", 2),
        ("import signal\nsignal.signal(signal.SIGTERM, signal.SIG_DFL)\n", "RC899", 2),
        ("import signal\nif x: signal.signal(signal.SIGINT, f)\n", "RC899", 2),
        ("import sys\nx = sys.argv[1]\n", "RC899", 2),
    ],
)
def test_review_modules_reports_line(text: str, code: str, line: int) -> None:
    assert findings(text) == [(code, "specificworker.py", line)]


@pytest.mark.parametrize(
    "text",
    [
        "import os, json, numpy, helper\nfrom . import x\n",
        "try:\n    import nowhere_at_all\nexcept ImportError:\n    pass\n",
        "try:\n    import nowhere_at_all\nexcept:\n    pass\n",
        "import Ice, RoboCompLaser\nfrom PySide2 import QtCore\nfrom genericworker import *\n",
        "import RoboCompLaser\nx = RoboCompLaser.TData()\nfrom RoboCompLaser import *\n",
        "class SpecificWorker(G):\n    def compute(self): ...\n",
        "from src.helper import x\n",
        "import signal\nsignal.signal(signal.SIGINT, signal.SIG_DFL)\n",
        "import librobocomp_innermodel\nfrom innermodel import InnerModel\n",
    ],
)
def test_review_modules_accepts_code(text: str) -> None:
    assert findings(text) == []


def test_review_modules_follows_imports_of_worker() -> None:
    helper = "import nowhere_at_all\n"
    assert findings("from src.helper import f\n", helper) == [("RC895", "helper.py", 1)]
    assert findings("import os\n", helper) == []


def test_bare_names_come_through_star_import() -> None:
    text = "from genericworker import *\nx = TData()\ny = Other()\n"
    assert bare_names([module(text)], NAMES) == {"TData"}
    assert bare_names([module("x = TData()\n")], NAMES) == set()
