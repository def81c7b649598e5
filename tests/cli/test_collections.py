"""Commands on a collection of interfaces: files with errors are reported and left out."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.rcgen_run import Rcgen

ARM = "module A { struct P { int x; }; interface Arm { void go(P p); }; };"
CAN = 'import "A.idsl"; module C { interface Can { void f(A::P p); }; };'
BROKEN = "module B { struct P { int x; } interface"


@pytest.fixture
def collection(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    for folder in ("new", "old"):
        (tmp_path / folder).mkdir()
        for name, text in (("A", ARM), ("B", BROKEN), ("C", CAN)):
            (tmp_path / folder / f"{name}.idsl").write_text(text)
    return tmp_path


def test_interface_exports_folder_without_files_with_errors(rcgen: Rcgen, collection: Path) -> None:
    run = rcgen("interface", "new", "--to", "slice", "-o", "out")
    assert run.code == 1
    assert sorted(path.name for path in (collection / "out").iterdir()) == ["A.ice", "C.ice"]
    assert "1 of 3 files has errors and is not exported: `new/B.idsl`" in run.err


def test_interface_exports_several_files(rcgen: Rcgen, collection: Path) -> None:
    run = rcgen("interface", "new/A.idsl", "new/C.idsl", "--to", "slice", "-o", "out")
    assert (run.code, run.err) == (0, "")
    assert sorted(path.name for path in (collection / "out").iterdir()) == ["A.ice", "C.ice"]


def test_interface_rejects_folder_without_interfaces(rcgen: Rcgen, collection: Path) -> None:
    (collection / "empty").mkdir()
    (collection / "empty/x.cdsl").write_text("Component x { Communications { }; };")
    run = rcgen("interface", "empty", "--to", "slice")
    assert run.code == 1
    assert "there are no IDSL files in `empty`" in run.err


def test_doc_leaves_out_files_with_errors(rcgen: Rcgen, collection: Path) -> None:
    run = rcgen("doc", "new", "-o", "doc")
    assert run.code == 1
    assert (collection / "doc/index.html").is_file()
    assert sorted(path.name for path in (collection / "doc/modules").iterdir()) == [
        "A.html",
        "C.html",
    ]
    assert "1 of 3 files has errors and is not documented: `new/B.idsl`" in run.err


def test_breaking_compares_files_without_errors(rcgen: Rcgen, collection: Path) -> None:
    (collection / "old/B.idsl").write_text("module B { struct P { int x; }; };")
    (collection / "new/A.idsl").write_text(ARM.replace("P p", "P p, int speed"))
    run = rcgen("breaking", "new", "--against", "old", "--format", "concise")
    assert run.code == 1
    assert "RC641" in run.out
    assert "`B::P`" not in run.out
    assert "1 of 3 files has errors and is not compared: `new/B.idsl`" in run.err


@pytest.mark.parametrize(
    ("command", "file", "text", "message", "help_"),
    [
        (
            ("component", "app.ddsl"),
            "app.ddsl",
            "Deployment app { };",
            "this is a deployment description",
            "`rcdeploy check app.ddsl` checks a deployment",
        ),
        (
            ("component", "arm.cdsl"),
            "arm.cdsl",
            '<?xml version="1.0"?>\n<application><name>a</name></application>',
            "this is XML",
            "`rcgen migrate FILE.xml` reads files of rcmanager, yarpmanager",
        ),
    ],
)
def test_component_names_the_command_for_another_file(
    rcgen: Rcgen, collection: Path, command: str, file: str, text: str, message: str, help_: str
) -> None:
    (collection / file).write_text(text)
    run = rcgen(*command)
    assert run.code == 1
    assert message in run.err + run.out
    assert help_ in run.err + run.out
    assert "rename the file" not in run.err + run.out
