"""Migrated components with a window: `self.ui`, timers, signals and slots work as with RoboComp."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from tests.migrate.processes import running

Rcgen = Callable[..., object]
pytest.importorskip("PySide6.QtWidgets")

EYE_UI = """<?xml version="1.0" encoding="UTF-8"?>
<ui version="4.0">
 <class>guiDlg</class>
 <widget class="QWidget" name="guiDlg">
  <layout class="QGridLayout" name="gridLayout">
   <item row="0" column="0"><widget class="QSlider" name="horizontalSlider_pos">
    <property name="minimum"><number>-150</number></property>
    <property name="maximum"><number>150</number></property>
    <property name="orientation"><enum>Qt::Horizontal</enum></property>
   </widget></item>
   <item row="1" column="0"><widget class="QLCDNumber" name="lcdNumber_pos"/></item>
   <item row="2" column="0"><widget class="QPushButton" name="pushButton_center"/></item>
   <item row="3" column="0"><widget class="QLabel" name="label_image"/></item>
   <item row="4" column="0"><widget class="QRadioButton" name="radioButton_moving"/></item>
  </layout>
 </widget>
 <resources/>
 <connections/>
</ui>
"""
EYE = """from PySide2.QtCore import QTimer
from PySide2.QtWidgets import QApplication, qApp
from PySide2.QtGui import QImage, QPixmap
from genericworker import *
import interfaces as ifaces

class SpecificWorker(GenericWorker):
    def __init__(self, proxy_map, startup_check=False):
        super(SpecificWorker, self).__init__(proxy_map)
        qApp.setApplicationVersion('1')
        QObject.connect(self.ui.horizontalSlider_pos, SIGNAL('valueChanged(int)'), self.slot_pos)
        self.ui.pushButton_center.clicked.connect(self.slot_center)
        self.battery_timer = QTimer()
        self.battery_timer.timeout.connect(self.updateBatteryStatus)
        self.battery_timer.start(10)
        self.batteries = self.count = 0
        self.Period = 10
        if startup_check:
            self.startup_check()
        else:
            self.timer.timeout.connect(self.compute)
            self.timer.start(self.Period)
        QTimer.singleShot(50, lambda: self.ui.horizontalSlider_pos.setSliderPosition(90))

    def __del__(self):
        \"\"\"Destructor\"\"\"

    def setParams(self, params):
        print("PARAMS", params, flush=True)
        return True

    @QtCore.Slot()
    def compute(self):
        self.count += 1
        image = QImage(bytes(12), 2, 2, 6, QImage.Format_RGB888)
        self.ui.label_image.setPixmap(QPixmap.fromImage(image).scaled(20, 20))
        self.ui.radioButton_moving.setChecked(True)
        if self.count == 20:
            self.timer.stop()
            print("STOPPED", self.batteries > 0, flush=True)
            QTimer.singleShot(100, self.report)

    def report(self):
        print("REPORT", self.count, self.ui.label_image.pixmap().width(), flush=True)
        self.ui.pushButton_center.click()

    def updateBatteryStatus(self):
        self.batteries += 1

    @QtCore.Slot()
    def slot_pos(self, pos):
        self.ui.lcdNumber_pos.display(pos)
        goal = ifaces.RoboCompJointMotorSimple.MotorGoalPosition()
        goal.position = pos
        print("POSITION", goal.position, self.ui.lcdNumber_pos.value(), flush=True)
        try:
            self.jointmotorsimple_proxy.setPosition("", goal)
        except Ice.Exception as e:
            print("NO MOTOR", type(e).__name__, flush=True)

    @QtCore.Slot()
    def slot_center(self):
        print("CENTER", flush=True)
        QApplication.instance().quit()

    def startup_check(self):
        QTimer.singleShot(200, QApplication.instance().quit)
"""
MACHINE_UI = """<ui version="4.0"><class>guiDlg</class>
<widget class="QMainWindow" name="guiDlg">
<widget class="QWidget" name="centralwidget"/></widget></ui>
"""
LOGIN_UI = """<ui version="4.0"><class>Login</class>
<widget class="QDialog" name="Login"><widget class="QLineEdit" name="user"/></widget></ui>
"""
MACHINE = """from PyQt5.QtCore import pyqtSignal, pyqtSlot
from PyQt5 import QtGui, QtWidgets
from genericworker import *
from ui_login import Ui_Login

class SpecificWorker(GenericWorker):
    arrived = pyqtSignal(str)

    def __init__(self, proxy_map, startup_check=False):
        super(SpecificWorker, self).__init__(proxy_map)
        self.Period = 20
        self.timer.start(self.Period)
        self.computes = 0
        self.dialog = QDialog(self)
        self.form = Ui_Login()
        self.form.setupUi(self.dialog)
        self.action = QtWidgets.QAction("Save", self)
        self.action.triggered.connect(self.save)
        self.arrived.connect(self.show_text)
        self.defaultMachine.start()
        self.destroyed.connect(self.t_compute_to_finalize)

    @QtCore.Slot()
    def sm_initialize(self):
        print("INITIALIZE", flush=True)
        self.t_initialize_to_compute.emit()

    @QtCore.Slot()
    def sm_compute(self):
        self.computes += 1
        if self.computes == 5:
            self.action.trigger()

    @QtCore.Slot()
    def sm_finalize(self):
        print("FINALIZE", flush=True)

    @pyqtSlot()
    def save(self):
        self.form.user.setText("ada")
        self.arrived.emit(self.form.user.text())

    def show_text(self, text):
        print("SAVED", text, flush=True)
        self.close()
"""


def old_component(folder: Path, name: str, ports: str, window: str, **files: str) -> Path:
    (folder / name / "src").mkdir(parents=True)
    imports = 'import "/robocomp/interfaces/IDSLs/JointMotorSimple.idsl";\n' if ports else ""
    text = f"{imports}Component {name}\n{{\n    Communications\n    {{\n        {ports}\n    }};\n"
    text += f"    language Python;\n    gui Qt({window});\n}};\n"
    (folder / name / f"{name}.cdsl").write_text(text)
    for file, content in files.items():
        suffix = ".py" if file == "specificworker" else ".ui"
        (folder / name / "src" / f"{file}{suffix}").write_text(content)
    return folder / name


@pytest.fixture(autouse=True)
def offscreen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("QT_QPA_PLATFORM", "offscreen")


def test_migrated_window_keeps_timers_signals_and_slots(rcgen, tmp_path: Path) -> None:
    files = {"specificworker": EYE, "mainUI": EYE_UI}
    old = old_component(tmp_path, "eye_control", "requires JointMotorSimple;", "QWidget", **files)
    assert rcgen("migrate", old, "-o", tmp_path / "new").code == 0
    assert not (tmp_path / "new" / "mainUI.ui").exists()
    with running(tmp_path / "new", "--middleware", "inproc") as eye:
        eye.wait_for("PARAMS")
        assert eye.wait_for("POSITION") == "POSITION 90 90.0"
        assert eye.wait_for("NO MOTOR") == "NO MOTOR NoServer"
        assert eye.wait_for("STOPPED") == "STOPPED True"
        assert eye.wait_for("REPORT") == "REPORT 20 20"
        eye.wait_for("CENTER")
        assert eye.wait_for_end() == 0


def test_migrated_window_keeps_state_machine_and_second_form(rcgen, tmp_path: Path) -> None:
    files = {"specificworker": MACHINE, "mainUI": MACHINE_UI, "login": LOGIN_UI}
    old = old_component(tmp_path, "gamer", "", "QMainWindow", **files)
    assert rcgen("migrate", old, "-o", tmp_path / "new").code == 0
    with running(tmp_path / "new", "--middleware", "inproc") as gamer:
        gamer.wait_for("INITIALIZE")
        assert gamer.wait_for("SAVED") == "SAVED ada"
        assert gamer.wait_for_end() == 0


@pytest.mark.parametrize(
    ("statement", "missing"),
    [
        ("from PySide2.QtCharts import QtCharts", "`QtCharts`, which may be in PySide6-Addons"),
        ("from PyQt5.QtCore import QRegExp", "`QRegExp`, which Qt 6 does not have"),
        ("from PySide.QtGui import QGLFormat", "`QGLFormat`, which Qt 6 does not have"),
        ("from PyQt5 import uic", "`uic`, which may be in PySide6-Addons"),
    ],
)
def test_migrate_names_what_qt6_lacks(rcgen, tmp_path: Path, statement: str, missing: str) -> None:
    files = {"specificworker": f"{statement}\n{MACHINE}", "mainUI": MACHINE_UI}
    old = old_component(tmp_path, "gamer", "", "QMainWindow", **files)
    done = rcgen("migrate", old, "-o", tmp_path / "new")
    assert done.code == 1
    assert f"`{statement}` needs {missing}" in done.err + done.out
