"""End-to-end tests of `rcgen migrate`: RoboComp's folders become running components."""

from __future__ import annotations

import ast
import hashlib
import random
import shutil
import subprocess
import sys
import uuid
from collections.abc import Callable
from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.write import write
from robocomp_dsl.migrate.finish import check_migrated_deployment, generate_components
from robocomp_dsl.migrate.migration import plan_migration
from tests.migrate.processes import running
from tests.support.generated_package import package_in

Rcgen = Callable[..., object]


def digest(folder: Path) -> dict[str, str]:
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def test_migrate_python_component_checks_clean(rcgen, old: Path, tmp_path: Path) -> None:
    before = digest(old)
    out = tmp_path / "new"
    done = rcgen("migrate", old / "follow", "-o", out)
    assert done.code == 0, done.err
    assert digest(old) == before
    assert rcgen("check", out).code == 0
    assert rcgen("component", "--check", out / "follow.cdsl").code == 0
    text = (out / "follow.cdsl").read_text()
    assert 'parameters "follow.pdsl";' in text
    assert "period 50;" in text
    assert (out / "steering.py").read_bytes() == (old / "follow/src/steering.py").read_bytes()
    assert (out / "etc/room.xml").is_file()
    report = (out / "MIGRATION.md").read_text()
    for words in (
        "`follow/etc/config:16`",
        "`follow/src/genericworker.py`",
        "`laser` is a stand-in",
    ):
        assert words in report
    assert str(tmp_path) not in report


def test_migrate_keeps_methods_byte_by_byte(rcgen, old: Path, tmp_path: Path) -> None:
    rcgen("migrate", old / "follow", "-o", tmp_path / "new")
    was = (old / "follow/src/specificworker.py").read_bytes()
    now = (tmp_path / "new/specificworker.py").read_bytes()
    body = was[was.index(b"sys.path.append") :]
    assert body in now
    added = now[now.index(body) + len(body) - 1 :].decode()
    assert added.strip() == "Mood_setSpeed = setSpeed"


def test_migrated_component_computes(rcgen, old: Path, tmp_path: Path) -> None:
    rcgen("migrate", old / "follow", "-o", tmp_path / "new")
    with running(tmp_path / "new", "--middleware", "inproc") as follow:
        follow.wait_for("no robot: NoServer")
        assert follow.stop() == 0


def test_migrated_deployment_components_communicate(rcgen, old: Path, tmp_path: Path) -> None:
    folders = [old / name for name in ("follow", "laser_sim", "base_sim")]
    out = tmp_path / "robot"
    done = rcgen("migrate", old / "robot.xml", *folders, "-o", out)
    assert done.code == 0, done.err
    report = Report()
    deployment = check_ddsl(out / "robot.ddsl", Workspace(), report)
    assert not report.has_errors
    assert deployment is not None
    domain = f"migrated-{uuid.uuid4().hex[:12]}"
    wires = ("--connect", "Laser=laser", "--connect", "DifferentialRobot=base")
    slow = ("--config", "etc/config_slow.yaml")
    with (
        running(out / "laser_sim", "--domain", domain, "--name", "laser"),
        running(out / "base_sim", "--domain", domain, "--name", "base") as base,
        running(out / "follow", "--domain", domain, *slow, *wires),
    ):
        # 300 mm ahead, nearer than 900: the advance of config_slow, and a turn.
        base.wait_for("SPEED 50.0 0.6")


def test_migrate_manager_writes_deployment(rcgen, old: Path, tmp_path: Path) -> None:
    folders = [old / name for name in ("follow", "laser_sim", "base_sim")]
    out = tmp_path / "robot"
    assert rcgen("migrate", old / "robot.xml", *folders, "-o", out).code == 0
    deployment = check_ddsl(out / "robot.ddsl", Workspace(), Report())
    assert deployment is not None
    rows = [
        (
            instance.name,
            instance.component.name,
            instance.host.address,
            instance.port,
            instance.after,
        )
        for instance in deployment.instances
    ]
    assert rows == [
        ("laser", "laser_sim", "127.0.0.1", 10003, ()),
        ("base", "base_sim", "127.0.0.1", 10004, ("laser",)),
        ("follow_me", "follow", "127.0.0.1", 11010, ("laser", "base")),
        ("rgbd", "rgbd", "10.0.30.33", 10096, ()),
    ]
    assert deployment.instances[2].config == out / "follow/etc/config_slow.yaml"
    assert deployment.instances[3].host.user == "robolab"
    wires = {
        (w.source.name, w.source_port.name, w.target.name, w.implied)
        for w in deployment.connections
    }
    assert wires == {
        ("follow_me", "Laser", "laser", False),
        ("follow_me", "DifferentialRobot", "base", False),
    }


def test_migrate_manager_without_folders_writes_stand_ins(rcgen, old: Path, tmp_path: Path) -> None:
    out = tmp_path / "robot"
    done = rcgen("migrate", old / "robot.xml", "-o", out)
    assert done.code == 0, done.err
    assert rcgen("check", out).code == 0
    assert "implements Laser;" in (out / "peers/laser/laser.cdsl").read_text()
    assert "implements RGBD;" in (out / "peers/rgbd/rgbd.cdsl").read_text()
    assert rcgen("component", out / "peers/laser/laser.cdsl").code == 0
    assert (out / "peers/laser/main.py").is_file()


def test_migrate_refuses_output_in_old_folder(rcgen, old: Path, tmp_path: Path) -> None:
    mine = tmp_path / "follow"
    shutil.copytree(old / "follow", mine)
    before = digest(mine)
    for out in (mine, mine / "new", tmp_path):
        done = rcgen("migrate", mine, "-o", out)
        assert done.code == 2, out
    assert digest(mine) == before
    assert rcgen("migrate", mine).code == 0
    assert (tmp_path / "follow-migrated/MIGRATION.md").is_file()
    assert rcgen("migrate", mine).code == 2
    assert digest(mine) == before


@pytest.mark.parametrize(
    ("name", "data", "code", "line"),
    [
        ("etc/config_bad", b"\x00\x01\x02", "RC921", 1),
        ("etc/config.toml", b"a = 1\nb = \n", "RC921", 2),
        ("etc/config_big", b"a = 1\n" * 900_000, "RC921", 1),
        ("src/specificworker.py", b"class A:\n    def f(self):\n        print 'x'\n", "RC952", 3),
        ("src/specificworker.py", b"\xff\xfe\x00", "RC952", 1),
        ("src/helper.py", b"def f(:\n", "RC952", 1),
        ("src/window.ui", b"<ui/>", "RC963", 1),
        ("src/eyes.cpp", b"int main() {}", "RC951", 1),
        ("follow.cdsl", b"Component follow { ", "RC923", 1),
        ("follow.cdsl", b"import \"Nowhere.idsl\"; Component follow { Communications { requires"
            b" Nowhere; }; language Python; };", "RC923", 1),
        ("follow.cdsl", b"\x00", "RC921", 1),
        ("Mood.idsl", b"module M { struct", "RC923", 1),
        ("second.cdsl", b"Component second { };", "RC961", 1),
    ],
)  # fmt: skip
def test_migrate_reports_broken_file_and_continues(
    rcgen, old: Path, tmp_path: Path, name: str, data: bytes, code: str, line: int
) -> None:
    folder = tmp_path / "follow"
    shutil.copytree(old / "follow", folder)
    (folder / name).write_bytes(data)
    done = rcgen("migrate", folder, "--format", "concise")
    assert done.code == 1, done.err
    reported = [row for row in done.err.splitlines() if code in row]
    assert any(f"{name.rpartition('/')[2]}:{line}" in row for row in reported) or code == "RC923", (
        reported
    )
    assert reported
    assert "Traceback" not in done.err
    if name != "follow.cdsl" or code != "RC921":
        out = tmp_path / "follow-migrated"
        assert code in (out / "MIGRATION.md").read_text()
        assert (out / "etc/config.yaml").is_file()
        assert (out / "follow.cdsl").is_file()


def test_migrate_cpp_component_keeps_descriptions(rcgen, tmp_path: Path) -> None:
    folder = tmp_path / "eyes"
    (folder / "etc").mkdir(parents=True)
    (folder / "src").mkdir()
    (folder / "eyes.cdsl").write_text(
        'import "Laser.idsl";\nComponent eyes\n{\n\tCommunications\n\t{\n\t\timplements Laser;\n'
        "\t};\n\tlanguage Cpp11;\n\tgui Qt(QWidget);\n};\n"
    )
    (folder / "etc/config").write_text("Laser.Endpoints=tcp -p 10003\nRate = 30\n")
    for name in ("specificworker.cpp", "specificworker.h", "genericworker.cpp", "CMakeLists.txt"):
        (folder / "src" / name).write_text("// code\n")
    done = rcgen("migrate", folder)
    assert done.code == 1
    out = tmp_path / "eyes-migrated"
    report = (out / "MIGRATION.md").read_text()
    assert "`eyes/src/specificworker.cpp` C++ code is not migrated" in report
    assert "`eyes/src/genericworker.cpp`" in report.partition("For information")[2]
    assert "language Python;" in (out / "eyes.cdsl").read_text()
    assert rcgen("check", out).code == 0
    assert rcgen("component", "--check", out / "eyes.cdsl").code == 0
    with running(out, "--middleware", "inproc") as eyes:
        eyes.wait_for("running")


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


def test_migrate_refuses_migrated_component(rcgen, old: Path, tmp_path: Path) -> None:
    assert rcgen("migrate", old / "follow", "-o", tmp_path / "new").code == 0
    done = rcgen("migrate", tmp_path / "new", "-o", tmp_path / "newer", "--format", "concise")
    assert done.code == 1
    assert "RC924" in done.err
    assert not (tmp_path / "newer").exists()


@pytest.mark.parametrize("seed", range(8))
def test_migrate_damaged_folder_writes_valid_files(old: Path, tmp_path: Path, seed: int) -> None:
    chance = random.Random(seed)
    folder, out = tmp_path / "old", tmp_path / "new"
    shutil.copytree(old, folder)
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    for path in chance.sample(files, 4):
        data = bytearray(path.read_bytes())
        for _ in range(chance.randint(1, 5)):
            position = chance.randrange(len(data) + 1)
            data[position : position + chance.choice((0, 1, 12))] = chance.choice(DAMAGE)
        path.write_bytes(data)
    report = Report()
    inputs = [folder / name for name in ("robot.xml", "follow", "laser_sim", "base_sim")]
    plan = plan_migration(inputs, out, [], report)
    write(out, plan.files)
    for place, generated in generate_components(plan, out, [], report):
        write(out / place, generated)
        ast.parse((out / place / "specificworker.py").read_bytes())
        ast.parse((package_in(out / place) / "params.py").read_bytes())
    check_migrated_deployment(plan, out, [], report)
    assert all(finding.span.source.path.name for finding in report)
    if plan.deployment and not report.has_errors:
        check_report = Report()
        check_ddsl(out / plan.deployment, Workspace(), check_report)
        assert not check_report.has_errors


DAMAGE = (b"", b'"', b"}", b"{", b";", b"\n", b"/*", b"\xff", b"\0", b"<", b"&", b"'", b"=", b"#x")


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


def test_migrate_reports_links_and_does_not_follow_them(rcgen, old: Path, tmp_path: Path) -> None:
    folder = tmp_path / "follow"
    shutil.copytree(old / "follow", folder)
    secret = tmp_path / "secret"
    secret.write_text("a = 1")
    (folder / "etc/config_linked").symlink_to(secret)
    (folder / "loop").symlink_to(folder, target_is_directory=True)
    done = rcgen("migrate", folder, "--format", "concise")
    assert done.code == 1
    assert "config_linked:1:1: error[RC961]" in done.err
    assert not list((tmp_path / "follow-migrated").rglob("config_linked*"))


def test_migrate_finds_configurations_next_to_manager_file(
    rcgen, old: Path, tmp_path: Path
) -> None:
    etc = tmp_path / "robot/etc"
    etc.mkdir(parents=True)
    shutil.copy(old / "robot.xml", etc)
    text = (etc / "robot.xml").read_text().replace("etc/config_slow", "robot/etc/follow.conf")
    (etc / "robot.xml").write_text(text)
    fast = (old / "follow/etc/config_slow").read_text().replace("Advance = 50", "Advance = 70")
    (etc / "follow.conf").write_text(fast)
    out = tmp_path / "new"
    folders = [old / name for name in ("follow", "laser_sim", "base_sim")]
    assert rcgen("migrate", etc / "robot.xml", *folders, "-o", out).code == 0
    deployment = check_ddsl(out / "robot.ddsl", Workspace(), Report())
    assert deployment is not None
    assert deployment.instances[2].config == out / "follow/etc/follow.yaml"
    assert "Advance: 70" in (out / "follow/etc/follow.yaml").read_text()


@pytest.mark.parametrize(
    ("text", "is_old"),
    [
        ("class A:\n    print 'x'\n", True),
        ("try:\n\tx()\nexcept Ice.Exception, e:\n\tpass\n", True),
        ("raise Error, 'x'\n", True),
        ("print (x\n", False),
        ("class A:\n    def x(:\n", False),
    ],
)
def test_migrate_reports_python_2(
    rcgen, old: Path, tmp_path: Path, text: str, is_old: bool
) -> None:
    folder = tmp_path / "follow"
    shutil.copytree(old / "follow", folder)
    (folder / "src" / "specificworker.py").write_text(text)
    done = rcgen("migrate", folder)
    assert done.code == 1
    assert (
        "help: this is Python 2: convert a copy with `2to3 -w -n specificworker.py`" in done.err
    ) == is_old
    assert "error[RC952]" in done.err


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
    run = subprocess.run(
        [sys.executable, "main.py", "--middleware", "inproc"],
        cwd=tmp_path / "states-migrated", capture_output=True, text=True, check=False, timeout=60,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    expected = ["start", "first 1", "first 2", "first 3", "second", "over"]
    assert run.stdout.splitlines() == expected, run.stderr
