"""Programs with a window: exit codes, signals, displays, and an installation without PySide6."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import uuid
from pathlib import Path

import pytest

from robocomp_dsl.extras import MissingExtra

PROGRAM = """
import sys
from PySide6 import QtCore
from robocomp_dsl.runtime import ComponentSpec, main
from robocomp_dsl.runtime.gui.window import QtWidgets, WindowComponent

class Worker(WindowComponent, QtWidgets.QWidget):
    SPEC = ComponentSpec("w", period=5, middleware="inproc", has_window=True, watchdog=WATCHDOG)
    def initialize(self):
        self.ui.pushButton.clicked.connect(self.on_click)
        QtCore.QTimer.singleShot(0, self.ui.pushButton.click)
    def on_click(self):
        ON_CLICK
    def finalize(self):
        self.log.info("finalized")

raise SystemExit(main(Worker))
"""
DEADLINE_S = 120.0
FORM = Path(__file__).with_name("mainUI.ui")


def run_program(
    folder: Path, on_click: str, watchdog: float = 0.0, form: str = "", **environment: str
) -> tuple[int, str]:
    (folder / "mainUI.ui").write_text(form or FORM.read_text())
    code = PROGRAM.replace("ON_CLICK", on_click).replace("WATCHDOG", str(watchdog))
    (folder / "program.py").write_text(code)
    domain = f"test-{uuid.uuid4().hex[:8]}"
    done = subprocess.run(
        [sys.executable, "program.py", "--domain", domain],
        cwd=folder,
        env={**os.environ, "QT_QPA_PLATFORM": "offscreen", **environment},
        capture_output=True,
        text=True,
        timeout=DEADLINE_S,
        check=False,
    )
    return done.returncode, done.stderr


def test_window_program_with_exit_in_slot_finalizes(tmp_path: Path) -> None:
    code, err = run_program(tmp_path, "sys.exit(4)")
    assert (code, "finalized" in err) == (4, True), err


def test_window_program_finalizes_on_signal(tmp_path: Path) -> None:
    code, err = run_program(tmp_path, f"import os; os.kill(os.getpid(), {signal.SIGTERM:d})")
    assert (code, "finalized" in err) == (0, True), err


def test_window_program_ends_if_a_slot_hangs(tmp_path: Path) -> None:
    code, err = run_program(tmp_path, "\n        while True: pass", watchdog=0.3)
    assert (code, "finalized" in err) == (1, True), err
    assert "watchdog: a slot of the window" in err


def test_window_program_reports_unusable_display(tmp_path: Path) -> None:
    code, err = run_program(tmp_path, "pass", QT_QPA_PLATFORM="xcb", DISPLAY=":987")
    assert code == 1
    assert "Qt cannot open the window" in err
    assert "DISPLAY is `:987`" in err
    assert "QT_QPA_PLATFORM=offscreen" in err
    assert "Traceback" not in err


def test_window_program_without_display_runs_offscreen(tmp_path: Path) -> None:
    displays = {"QT_QPA_PLATFORM": "", "DISPLAY": "", "WAYLAND_DISPLAY": ""}
    code, err = run_program(tmp_path, "self.close()", **displays)
    assert (code, "finalized" in err) == (0, True), err
    assert "the window is not shown: there is no display" in err


def test_window_program_reports_invalid_form(tmp_path: Path) -> None:
    code, err = run_program(tmp_path, "pass", form='<ui version="4.0"><widget')
    assert code == 1
    assert "mainUI.ui: not a valid file of Qt Designer: uic: Error in line 1" in err
    assert "Traceback" not in err


@pytest.mark.parametrize("reason", ["missing", "library"])
def test_window_names_how_to_install_pyside(
    reason: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in [name for name in sys.modules if name.startswith("PySide6")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.delitem(sys.modules, "robocomp_dsl.runtime.gui.qt", raising=False)
    if reason == "missing":
        monkeypatch.setitem(sys.modules, "PySide6", None)
        expected = r"-m pip install 'robocomp_dsl\[gui\]'"
    else:
        (tmp_path / "PySide6").mkdir()
        code = "raise ImportError('libEGL.so.1: cannot open shared object file')"
        (tmp_path / "PySide6" / "__init__.py").write_text(code)
        monkeypatch.syspath_prepend(tmp_path)
        expected = r"libEGL\.so\.1.*sudo apt-get install libegl1"
    with pytest.raises(MissingExtra, match=expected):
        __import__("robocomp_dsl.runtime.gui.qt")
