"""End to end: the code of old components is carried over faithfully, or reported."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.migrate.processes import running
from tests.migrate.worlds import HEAD, write_component

Rcgen = Callable[..., object]


def test_migrated_paths_from_file_find_data(rcgen, tmp_path: Path) -> None:
    worker = HEAD.replace("from PySide2", '"""Eyes."""\nimport os, src.names\nfrom PySide2') + (
        "    def compute(self):\n"
        "        here = os.path.dirname(os.path.abspath(__file__))\n"
        "        with open(os.path.join(here, 'model.txt')) as stream:\n"
        "            print('MODEL', stream.read(), src.names.NAME, flush=True)\n"
    )
    files = {
        "src/specificworker.py": worker,
        "src/names.py": "import tables\nNAME = tables.NAME\n",
        "src/tables.py": "import pathlib\nNAME = pathlib.Path(__file__).parent.name\n",
        "src/model.txt": "forty-two",
    }
    folder = write_component(tmp_path / "eyes", files)
    done = rcgen("migrate", folder, "--format", "concise")
    assert done.code == 0, done.err
    with running(tmp_path / "eyes-migrated", "--middleware", "inproc") as eyes:
        assert eyes.wait_for("MODEL") == "MODEL forty-two src"


def test_migrated_module_finds_robocomp_variable(
    rcgen, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("ROBOCOMP", raising=False)
    helper = "import os, sys\nif 'ROBOCOMP' not in os.environ:\n    sys.exit('no ROBOCOMP')\n"
    worker = f"import helper\n{HEAD}    def compute(self):\n        print('RUNS', flush=True)\n"
    files = {"src/specificworker.py": worker, "src/helper.py": helper}
    folder = write_component(tmp_path / "eyes", files)
    assert rcgen("migrate", folder).code == 0
    with running(tmp_path / "eyes-migrated", "--middleware", "inproc") as eyes:
        eyes.wait_for("RUNS")


def test_migrated_python_2_worker_runs(rcgen, tmp_path: Path) -> None:
    worker = HEAD.replace("PySide2.QtCore import QTimer", "PySide import QtGui, QtCore") + (
        "\tdef setParams(self, params):\n"
        "\t\tself.width = int(params['Width'])\n"
        "\t\treturn True\n\n"
        "\tdef compute(self):\n"
        "\t\tprint 'HALF', self.width / 2, half(self.width)\n"
        "\t\tsys.stdout.flush()\n"
    )
    worker = "from helper import half\n" + worker.replace("    ", "\t")
    files = {
        "src/specificworker.py": worker,
        "src/helper.py": "def half(n):\n    return n / 2\n",
        "etc/config": "Width = 7\n",
    }
    folder = write_component(tmp_path / "eyes", files)
    done = rcgen("migrate", folder, "--format", "concise")
    assert done.code == 0, done.err
    assert done.err.count("warning[RC898]") == 2
    with running(tmp_path / "eyes-migrated", "--middleware", "inproc") as eyes:
        assert eyes.wait_for("HALF") == "HALF 3 3"


def test_migrated_worker_uses_types_without_module(rcgen, tmp_path: Path) -> None:
    worker = HEAD + (
        "    def compute(self):\n"
        "        print('RAY', TData(dist=2).dist, RoboCompLaser.TData().dist, flush=True)\n"
    )
    folder = write_component(
        tmp_path / "eyes", {"src/specificworker.py": worker}, "requires Laser;"
    )
    done = rcgen("migrate", folder, "--format", "concise")
    assert done.code == 0, done.err
    with running(tmp_path / "eyes-migrated", "--middleware", "inproc") as eyes:
        assert eyes.wait_for("RAY").startswith("RAY 2")
    check = [sys.executable, "-m", "mypy", "--strict", "legacy.py"]
    found = subprocess.run(
        check, cwd=tmp_path / "eyes-migrated", capture_output=True, text=True, check=False
    )
    assert found.returncode == 0, found.stdout


def test_migrate_reports_line_that_stops_worker(rcgen, tmp_path: Path) -> None:
    worker = f"import nowhere_at_all\n{HEAD}    def compute(self):\n        ifaces.RoboCompBase\n"
    folder = write_component(tmp_path / "eyes", {"src/specificworker.py": worker})
    done = rcgen("migrate", folder, "--format", "concise")
    assert done.code == 1
    assert "src/specificworker.py:1:1: error[RC895]" in done.err
    assert "src/specificworker.py:13:9: error[RC896]" in done.err


def test_migrate_keeps_trailing_comments_in_their_method(rcgen, tmp_path: Path) -> None:
    worker = HEAD + (
        "    def getLaserData(self):\n"
        "        return []\n"
        "        # or the simulated scan\n"
        "\n"
        "    # the end of the class\n"
        "\n"
        "# the end of the module\n"
    )
    files = {"src/specificworker.py": worker}
    folder = write_component(tmp_path / "eyes", files, "implements Laser;")
    assert rcgen("migrate", folder).code == 0
    text = (tmp_path / "eyes-migrated/specificworker.py").read_text()
    parts = [
        "# or the simulated scan",
        "# the end of the class",
        "Laser_getLaserData = getLaserData",
        "def Laser_getLaserConfData",
        "# the end of the module",
    ]
    places = [text.index(part) for part in parts]
    assert places == sorted(places)


def test_migrate_adds_no_state_stubs_for_old_methods(rcgen, tmp_path: Path) -> None:
    states = "M { states a; initial_state b; end_state c; transition { b => a; a => c; }; };\n"
    worker = HEAD + "".join(f"    def sm_{name}(self):\n        pass\n" for name in "ab")
    files = {"src/specificworker.py": worker, "m.smdsl": states}
    folder = write_component(tmp_path / "eyes", files)
    cdsl, machine = folder / "eyes.cdsl", 'language python; statemachine "m.smdsl";'
    cdsl.write_text(cdsl.read_text().replace("language python;", machine))
    rcgen("migrate", folder)
    out = tmp_path / "eyes-migrated"
    assert rcgen("component", out / "eyes.cdsl").code == 0
    text = (out / "specificworker.py").read_text()
    assert "def state_a" not in text
    assert "def state_b" not in text
    assert "def state_c" in text


def test_migrate_reports_calls_that_interfaces_lack(rcgen, tmp_path: Path) -> None:
    worker = HEAD + (
        "    def compute(self):\n"
        "        self.laser_proxy.getRays()\n"
        "        self.camera_proxy.getImage()\n"
        "        self.own_proxy = self.JoystickAdapter_helper()\n\n"
        "    def JoystickAdapter_sendData(self, data, more):\n"
        "        pass\n\n"
        "    def JoystickAdapter_reset(self):\n"
        "        pass\n\n"
        "    def JoystickAdapter_helper(self):\n"
        "        return self.own_proxy\n"
    )
    ports = "requires Laser; subscribesTo JoystickAdapter;"
    folder = write_component(tmp_path / "eyes", {"src/specificworker.py": worker}, ports)
    cdsl = folder / "eyes.cdsl"
    cdsl.write_text(cdsl.read_text().replace('import "subscribesTo.idsl";\n', ""))
    done = rcgen("migrate", folder, "--format", "concise")
    assert done.code == 1
    rows = [row for row in done.err.splitlines() if "error[RC896]" in row]
    lines = sorted(int(row.partition("specificworker.py:")[2].split(":")[0]) for row in rows)
    assert lines == [12, 13, 16, 19], done.err
