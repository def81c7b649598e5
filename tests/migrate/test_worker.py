"""What of an old worker is adapted, what stays, and what is told."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.upkeep import user_module
from robocomp_dsl.migrate.worker import Names, adapted

NAMES = Names("legacy", frozenset({"RoboCompLaser"}), {"getLaserData": "Laser_getLaserData"})

IMPORTS = [
    ("from genericworker import *", "from legacy import *"),
    ("import interfaces as ifaces", "import legacy as ifaces"),
    ("import interfaces", "import legacy as interfaces"),
    ("import genericworker, os", "import legacy as genericworker; import os"),
    ("import Ice", "from legacy import Ice"),
    ("import Ice, sys as s", "from legacy import Ice; import sys as s"),
    ("import Ice\nIce.loadSlice('x')", "from legacy import Ice\nIce.loadSlice('x')"),
    ("import RoboCompLaser as l", "from legacy import RoboCompLaser as l"),
    ("from RoboCompLaser import *", "from generated.interfaces import *"),
    ("from RoboCompLaser import A as B", "from generated.interfaces import A as B"),
    ("from PySide import QtGui, QtCore", "from legacy import QtGui, QtCore"),
    ("from PySide2.QtCore import QTimer, Qt", "from legacy import QTimer"),
    ("try:\n    from PyQt5.QtGui import QColor\nexcept E:\n    pass",
     "try:\n    pass\nexcept E:\n    pass"),
    ("if 1: import Ice # é\r\nx = 'é'\r\n", "if 1: from legacy import Ice # é\r\nx = 'é'\r\n"),
    ("from genericworker import (  # all\n    A,\n    B)\n", "from legacy import A, B\n"),
]  # fmt: skip

STAYING = [
    "import Ice\nc = Ice.initialize()",
    "from PySide2.QtCore import QTimer\nt = QTimer()",
    "from PySide2 import QtCore\nt = QtCore.QTimer()",
    "from PySide2 import QtCore\nt = QtCore.Qt.Key_A",
    "from PySide2.QtWidgets import *",
    "from PySide2.QtWidgets import QLabel\nl = QLabel()",
    "import PySide2.QtCore",
]


def rewritten(text: str, folder: Path) -> tuple[str, Report]:
    path = folder / "specificworker.py"
    path.write_bytes(text.encode())
    user = user_module.read(path, Report())
    assert user is not None
    report = Report()
    return adapted(user, NAMES, report), report


@pytest.mark.parametrize(("old", "new"), IMPORTS)
def test_imports_of_robocomp_are_adapted(old: str, new: str, tmp_path: Path) -> None:
    made, report = rewritten(old, tmp_path)
    assert made == new
    assert {one.code.id for one in report} == {"RC954"}


@pytest.mark.parametrize("text", STAYING)
def test_what_needs_qt_or_ice_stays_and_is_told(text: str, tmp_path: Path) -> None:
    made, report = rewritten(text, tmp_path)
    assert made == text
    assert [(one.code.id, one.span.begin[0]) for one in report] == [("RC955", 1)]


@pytest.mark.parametrize("text", ["import os", "from . import interfaces", "import numpy as np"])
def test_other_imports_stay(text: str, tmp_path: Path) -> None:
    made, report = rewritten(text, tmp_path)
    assert made == text
    assert not len(report)


def test_names_of_the_star_import_that_are_not_there_are_told(tmp_path: Path) -> None:
    _, report = rewritten("from genericworker import *\nt = QtCore.QTimer()\n", tmp_path)
    assert sorted(one.code.id for one in report) == ["RC954", "RC955"]


def test_old_names_of_methods_get_those_of_today(tmp_path: Path) -> None:
    text = (
        "class SpecificWorker(G):\r\n\tdef getLaserData(self):\r\n\t\treturn 1 # c\r\n\r\nx = 1\r\n"
    )
    made, _ = rewritten(text, tmp_path)
    added = "\r\n\r\n\tLaser_getLaserData = getLaserData"
    assert made == text.replace("# c", f"# c{added}")
    assert made == rewritten(made, tmp_path)[0]


def test_attributes_of_the_component_are_told(tmp_path: Path) -> None:
    text = "class SpecificWorker(G):\n    def f(self):\n        self.params = 1\n        self.x = 2"
    made, report = rewritten(text, tmp_path)
    assert made == text
    assert [(one.code.id, one.span.begin) for one in report] == [("RC956", (3, 9))]


def test_methods_of_states_are_told(tmp_path: Path) -> None:
    path = tmp_path / "specificworker.py"
    path.write_text(
        "class SpecificWorker(G):\n    def sm_search(self): ...\n    def sm_x(self): ...\n"
    )
    user = user_module.read(path, Report())
    assert user is not None
    report = Report()
    adapted(user, replace(NAMES, states=frozenset({"search"})), report)
    said = [(one.code.id, one.span.text) for one in report]
    assert said == [("RC959", "sm_search"), ("RC958", "sm_x")]
    assert "on_enter_search" in next(iter(report)).message
