"""`rcgen migrate` with broken, linked and damaged files."""

from __future__ import annotations

import ast
import random
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.write import write
from robocomp_dsl.migrate.finish import check_migrated_files, generate_components
from robocomp_dsl.migrate.migration import plan_migration
from tests.support.generated_package import package_in

Rcgen = Callable[..., object]


@pytest.mark.parametrize(
    ("name", "data", "code", "line"),
    [
        ("etc/config_bad", b"\x00\x01\x02", "RC921", 1),
        ("etc/config.toml", b"a = 1\nb = \n", "RC921", 2),
        ("etc/config_big", b"a = 1\n" * 900_000, "RC921", 1),
        ("src/specificworker.py", b"class A:\n    def f(self):\n        print 'x'\n", "RC953", 1),
        ("src/specificworker.py", b"class A:\n    def f(self):\n        print 'x\n", "RC952", 3),
        ("src/specificworker.py", b"\xff\xfe\x00", "RC952", 1),
        ("src/helper.py", b"def f(:\n", "RC952", 1),
        ("src/window.ui", b"<ui/>", "RC963", 1),
        ("src/eyes.cpp", b"int main() {}", "RC951", 1),
        ("follow.cdsl", b"Component follow { ", "RC923", 1),
        ("follow.cdsl", b"import \"Nowhere.idsl\"; Component follow { Communications { requires"
            b" Nowhere; }; language Python; };", "RC201", 1),
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


@pytest.mark.parametrize("seed", range(8))
def test_migrate_damaged_folder_writes_valid_files(old: Path, tmp_path: Path, seed: int) -> None:
    rng = random.Random(seed)
    folder, out = tmp_path / "old", tmp_path / "new"
    shutil.copytree(old, folder)
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    for path in rng.sample(files, 4):
        data = bytearray(path.read_bytes())
        for _ in range(rng.randint(1, 5)):
            position = rng.randrange(len(data) + 1)
            data[position : position + rng.choice((0, 1, 12))] = rng.choice(DAMAGE)
        path.write_bytes(data)
    report = Report()
    inputs = [folder / name for name in ("robot.xml", "follow", "laser_sim", "base_sim")]
    plan = plan_migration(inputs, out, [], report)
    write(out, plan.files)
    for place, generated in generate_components(plan, out, [], report):
        write(out / place, generated)
        ast.parse((out / place / "specificworker.py").read_bytes())
        ast.parse((package_in(out / place) / "params.py").read_bytes())
    check_migrated_files(plan, out, [], report)
    assert all(finding.span.source.path.name for finding in report)
    for deployment in () if report.has_errors else plan.deployments:
        check_report = Report()
        check_ddsl(out / deployment, Workspace(), check_report)
        assert not check_report.has_errors


DAMAGE = (b"", b'"', b"}", b"{", b";", b"\n", b"/*", b"\xff", b"\0", b"<", b"&", b"'", b"=", b"#x")


def test_migrate_reports_links_without_following(rcgen, old: Path, tmp_path: Path) -> None:
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


@pytest.mark.parametrize("text", ["print (x\n", "class A:\n    def x(:\n", "print 'x\n"])
def test_migrate_reports_worker_that_python_cannot_parse(
    rcgen, old: Path, tmp_path: Path, text: str
) -> None:
    folder = tmp_path / "follow"
    shutil.copytree(old / "follow", folder)
    (folder / "src" / "specificworker.py").write_text(text)
    done = rcgen("migrate", folder)
    assert done.code == 1
    assert "error[RC952]" in done.err
    assert (tmp_path / "follow-migrated/specificworker.py.old").read_text() == text
