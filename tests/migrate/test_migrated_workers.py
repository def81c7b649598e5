"""Migrated components as processes: they compute, and receive their configuration."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from tests.migrate.processes import running

Rcgen = Callable[..., object]


def test_migrated_component_computes(rcgen, old: Path, tmp_path: Path) -> None:
    rcgen("migrate", old / "follow", "-o", tmp_path / "new")
    with running(tmp_path / "new", "--middleware", "inproc") as follow:
        follow.wait_for("no robot: NoServer")
        assert follow.stop() == 0


def test_migrated_worker_receives_toml_tables(rcgen, tmp_path: Path) -> None:
    folder = tmp_path / "eyes"
    (folder / "etc").mkdir(parents=True)
    (folder / "src").mkdir()
    (folder / "eyes.cdsl").write_text("Component eyes { Communications { }; language python; };")
    (folder / "etc/config.toml").write_text(
        '[Period]\nCompute = 20\n[Config]\nExtrinsic = [0, 1.5]\nDisplay = true\nName = "a"\n'
    )
    (folder / "src/specificworker.py").write_text(
        "from PySide6.QtCore import QTimer\nfrom genericworker import *\n"
        "class SpecificWorker(GenericWorker):\n"
        "    def __init__(self, proxy_map, configData, startup_check=False):\n"
        "        super(SpecificWorker, self).__init__(proxy_map, configData)\n"
        '        self.Period = configData["Period"]["Compute"]\n'
        "        self.timer.timeout.connect(self.compute)\n"
        "        self.timer.start(self.Period)\n"
        "        self.data = configData\n"
        "    @QtCore.Slot()\n"
        "    def compute(self):\n"
        '        print("DATA", self.Period, self.data["Config"], flush=True)\n'
    )
    assert rcgen("migrate", folder).code == 0
    out = tmp_path / "eyes-migrated"
    assert "period 20;" in (out / "eyes.cdsl").read_text()
    with running(out, "--middleware", "inproc") as eyes:
        line = eyes.wait_for("DATA")
    assert line == "DATA 20 {'Extrinsic': [0.0, 1.5], 'Display': True, 'Name': 'a'}"


def test_migrated_worker_receives_tables_from_text_file(rcgen, tmp_path: Path) -> None:
    folder = tmp_path / "eyes"
    (folder / "etc").mkdir(parents=True)
    (folder / "src").mkdir()
    (folder / "eyes.cdsl").write_text("Component eyes { Communications { }; language python; };")
    (folder / "etc/config").write_text("Config.Gain = 2.50\nPeriod.Compute = 20\n")
    (folder / "etc/config.toml").write_text("[Config]\nGain = 3\n[Period]\nCompute = 20\n")
    (folder / "src/specificworker.py").write_text(
        "from genericworker import *\n"
        "class SpecificWorker(GenericWorker):\n"
        "    def __init__(self, proxy_map, configData):\n"
        "        super().__init__(proxy_map, configData)\n"
        '        print("TABLES", configData["Config"], flush=True)\n'
        "    def compute(self):\n"
        "        self.quit()\n"
    )
    assert rcgen("migrate", folder).code == 0
    out = tmp_path / "eyes-migrated"
    with running(out, "--middleware", "inproc") as eyes:
        assert eyes.wait_for("TABLES") == "TABLES {'Gain': 2.5}"
    second = ("--config", "etc/config_toml.yaml")
    with running(out, "--middleware", "inproc", *second) as eyes:
        assert eyes.wait_for("TABLES") == "TABLES {'Gain': 3.0}"


STATES = """Machine_old{
    states first, second;
    initial_state start;
    end_state over;
    transition{
        start => first;
        first => first, second;
        second => over;
    };
};
"""
STATE_WORKER = """from genericworker import *

class SpecificWorker(GenericWorker):
    def __init__(self, proxy_map):
        super(SpecificWorker, self).__init__(proxy_map)
        self.rounds = 0
        self.Machine_old.start()

    @QtCore.Slot()
    def sm_start(self):
        print("start", flush=True)
        self.t_start_to_first.emit()

    @QtCore.Slot()
    def sm_first(self):
        self.rounds += 1
        print("first", self.rounds, flush=True)
        if self.rounds < 3:
            self.t_first_to_first.emit()
        else:
            self.firsttosecond.emit()

    @QtCore.Slot()
    def sm_second(self):
        print("second", flush=True)
        self.t_second_to_over.emit()

    @QtCore.Slot()
    def sm_over(self):
        print("over", flush=True)
"""


def test_migrated_state_machine_runs(rcgen, tmp_path: Path) -> None:
    folder = tmp_path / "states"
    (folder / "src").mkdir(parents=True)
    (folder / "states.cdsl").write_text(
        'Component states { Communications { }; language python; statemachine "old.smdsl"; };\n'
    )
    (folder / "old.smdsl").write_text(STATES)
    (folder / "etc").mkdir()
    (folder / "etc" / "config").write_text("Period = 10\n")
    (folder / "src" / "specificworker.py").write_text(STATE_WORKER)
    done = rcgen("migrate", folder, "--format", "concise")
    assert done.code == 0, done.err
    with running(tmp_path / "states-migrated", "--middleware", "inproc") as states:
        states.wait_for("over")  # RoboComp's components go on when their machine has ended
        assert states.stop() == 0
    lines = [line for line in states.lines if " | " not in line]
    assert lines == ["start", "first 1", "first 2", "first 3", "second", "over"]


def test_migrated_worker_that_waits_stops_normally(rcgen, tmp_path: Path) -> None:
    folder = tmp_path / "waits"
    (folder / "src").mkdir(parents=True)
    (folder / "waits.cdsl").write_text("Component waits { Communications { }; language python; };")
    (folder / "src" / "specificworker.py").write_text(
        "from genericworker import *\n"
        "import threading\n"
        "class SpecificWorker(GenericWorker):\n"
        "    def compute(self):\n"
        "        print('WAITING', flush=True)\n"
        "        threading.Event().wait(3600)\n"
        "    def __del__(self):\n"
        "        print('CLOSED', flush=True)\n"
    )
    assert rcgen("migrate", folder).code == 0
    with running(tmp_path / "waits-migrated", "--middleware", "inproc") as waits:
        waits.wait_for("WAITING")
        assert waits.stop() == 0
    assert "CLOSED" in waits.lines
