"""Tests of the adaptation of old workers."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.regeneration import user_module
from robocomp_dsl.migrate.worker import LegacyNames, adapt_module

NAMES = LegacyNames(
    "legacy",
    "old_generated",
    frozenset({"RoboCompLaser"}),
    {"getLaserData": "Laser_getLaserData"},
    servants=frozenset({"laserI"}),
)

IMPORTS = [
    ("from genericworker import *", "from legacy import *"),
    ("import interfaces as ifaces", "import legacy as ifaces"),
    ("import interfaces", "import legacy as interfaces"),
    ("import genericworker, os", "import legacy as genericworker; import os"),
    ("import Ice", "from legacy import Ice"),
    ("import Ice, sys as s", "from legacy import Ice; import sys as s"),
    ("import Ice\nIce.loadSlice('x')", "from legacy import Ice\nIce.loadSlice('x')"),
    ("import RoboCompLaser as l", "from legacy import RoboCompLaser as l"),
    ("from RoboCompLaser import *", "from old_generated.interfaces import *"),
    ("from RoboCompLaser import A as B", "from old_generated.interfaces import A as B"),
    ("from PySide import QtGui, QtCore", "from legacy import QtGui, QtCore"),
    ("from PySide import *\nm = QtCore.QMutex()", "from legacy import QtCore\nm = QtCore.QMutex()"),
    ("from PySide2.QtWidgets import *", "pass"),
    ("import librobocomp_innermodel as m", "from robocomp_dsl import innermodel as m"),
    ("from innermodel import InnerModel", "from robocomp_dsl.innermodel import InnerModel"),
    ("from innermodel_python3.innermodel import InnerModel as M",
     "from robocomp_dsl.innermodel import InnerModel as M"),
    ("from laserI import *\nimport laserI, os", "pass\nimport os"),
    ("from PySide2.QtCore import QTimer, Qt", "from legacy import QTimer"),
    ("from PySide2.QtCore import QTimer\nt = QTimer()", "from legacy import QTimer\nt = QTimer()"),
    ("try:\n    from PyQt5.QtGui import QColor\nexcept E:\n    pass",
     "try:\n    pass\nexcept E:\n    pass"),
    ("if 1: import Ice # é\r\nx = 'é'\r\n", "if 1: from legacy import Ice # é\r\nx = 'é'\r\n"),
    ("from genericworker import (  # all\n    A,\n    B)\n", "from legacy import A, B\n"),
]  # fmt: skip

STAYING = [
    "import Ice\nc = Ice.initialize()",
    "from PySide2 import QtCore\nt = QtCore.Qt.Key_A",
    "from PySide2.QtWidgets import *\nw = QWidget()",
    "from PySide import *\nw = QtGui.QWidget()",
    "from PySide2.QtWidgets import QLabel\nl = QLabel()",
    "import PySide2.QtCore",
]


def rewritten(text: str, folder: Path) -> tuple[str, Report]:
    path = folder / "specificworker.py"
    path.write_bytes(text.encode())
    user = user_module.read(path, Report())
    assert user is not None
    report = Report()
    return adapt_module(user, NAMES, report), report


@pytest.mark.parametrize(("old", "new"), IMPORTS)
def test_adapt_module_replaces_robocomp_imports(old: str, new: str, tmp_path: Path) -> None:
    adapted, report = rewritten(old, tmp_path)
    assert adapted == new
    assert {finding.code.id for finding in report} == {"RC954"}


@pytest.mark.parametrize("text", STAYING)
def test_adapt_module_reports_imports_that_need_qt_or_ice(text: str, tmp_path: Path) -> None:
    adapted, report = rewritten(text, tmp_path)
    assert adapted == text
    assert [(finding.code.id, finding.span.start_position[0]) for finding in report] == [
        ("RC955", 1)
    ]


@pytest.mark.parametrize("text", ["import os", "from . import interfaces", "import numpy as np"])
def test_adapt_module_keeps_other_imports(text: str, tmp_path: Path) -> None:
    adapted, report = rewritten(text, tmp_path)
    assert adapted == text
    assert not len(report)


def test_adapt_module_reports_unsupported_star_import(tmp_path: Path) -> None:
    _, report = rewritten("from genericworker import *\nt = QtCore.QThread()\n", tmp_path)
    assert sorted(finding.code.id for finding in report) == ["RC954", "RC955"]


def test_adapt_module_adds_handler_aliases(tmp_path: Path) -> None:
    text = (
        "class SpecificWorker(G):\r\n\tdef getLaserData(self):\r\n\t\treturn 1 # c\r\n\r\nx = 1\r\n"
    )
    adapted, _ = rewritten(text, tmp_path)
    added = "\r\n\r\n\tLaser_getLaserData = getLaserData"
    assert adapted == text.replace("# c", f"# c{added}")
    assert adapted == rewritten(adapted, tmp_path)[0]


def test_adapt_module_reports_component_attributes(tmp_path: Path) -> None:
    text = "class SpecificWorker(G):\n    def f(self):\n        self.params = 1\n        self.x = 2"
    adapted, report = rewritten(text, tmp_path)
    assert adapted == text
    assert [(finding.code.id, finding.span.start_position) for finding in report] == [
        ("RC956", (3, 9))
    ]


def test_adapt_module_reports_state_methods(tmp_path: Path) -> None:
    path = tmp_path / "specificworker.py"
    path.write_text(
        "class SpecificWorker(G):\n    def sm_search(self): ...\n    def sm_x(self): ...\n"
    )
    user = user_module.read(path, Report())
    assert user is not None
    report = Report()
    adapt_module(user, replace(NAMES, states=frozenset({"search"})), report)
    findings = [(finding.code.id, finding.span.text) for finding in report]
    assert findings == [("RC959", "sm_search"), ("RC958", "sm_x")]
    assert "on_enter_search" in next(iter(report)).message
