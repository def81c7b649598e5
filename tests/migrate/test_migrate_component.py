"""`rcgen migrate` of one component: descriptions, code and report."""

from __future__ import annotations

import hashlib
import shutil
from collections.abc import Callable
from pathlib import Path

from tests.migrate.processes import running

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
        "/follow/etc/config:16`",
        "/follow/src/genericworker.py`",
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


def test_migrate_rejects_output_in_old_folder(rcgen, old: Path, tmp_path: Path) -> None:
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
    assert "`../eyes/src/specificworker.cpp` C++ code is not migrated" in report
    assert "`../eyes/src/genericworker.cpp`" in report.partition("For information")[2]
    assert "language Python;" in (out / "eyes.cdsl").read_text()
    assert rcgen("check", out).code == 0
    assert rcgen("component", "--check", out / "eyes.cdsl").code == 0
    with running(out, "--middleware", "inproc") as eyes:
        eyes.wait_for("running")


def test_migrate_rejects_migrated_component(rcgen, old: Path, tmp_path: Path) -> None:
    assert rcgen("migrate", old / "follow", "-o", tmp_path / "new").code == 0
    done = rcgen("migrate", tmp_path / "new", "-o", tmp_path / "newer", "--format", "concise")
    assert done.code == 1
    assert "RC924" in done.err
    assert not (tmp_path / "newer").exists()


def test_migrate_generates_the_rest_if_an_import_is_missing(rcgen, tmp_path: Path) -> None:
    old = tmp_path / "old"
    (old / "src").mkdir(parents=True)
    (old / "Tags.idsl").write_text(
        "module M { interface Tags { void seen(int number); int count(); }; };\n"
    )
    (old / "eye.cdsl").write_text(
        'import "Tags.idsl";\nimport "Gone.idsl";\nComponent eye { Communications'
        " { subscribesTo Tags; requires Gone; }; language Python; };\n"
    )
    (old / "src" / "specificworker.py").write_text(
        "from genericworker import *\n\n\nclass SpecificWorker(GenericWorker):\n"
        "    def compute(self):\n        return True\n\n"
        "    def Tags_seen(self, number):\n        pass\n"
    )
    out = tmp_path / "new"
    done = rcgen("migrate", old, "-o", out)
    assert done.code == 1
    assert "Gone.idsl" in done.err
    assert (out / "Tags.idsl").is_file()
    assert "Tags_seen" in (out / "eye_generated" / "genericworker.py").read_text()
