"""`rcgen component`: output files, modes that write nothing, and errors."""

from __future__ import annotations

import errno
import os
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.cli.rcgen_run import Rcgen

CDSL = """\
import "Talk.idsl";
Component talker { Communications { implements Talk; }; language Python; };
"""
IDSL = "module M { interface Talk { int say(string text); }; };\n"
ALL = {
    "README.md",
    "etc/config.schema.json",
    "etc/config.yaml",
    "talker_generated/__init__.py",
    "talker_generated/genericworker.py",
    "talker_generated/interfaces.json",
    "talker_generated/interfaces.py",
    "talker_generated/params.py",
    "main.py",
    "specificworker.py",
}
RECORD = {
    ".rcgen/methods.json",
    ".rcgen/pristine/README.md",
    ".rcgen/pristine/etc/config.yaml",
}


@pytest.fixture
def talker(here: Path) -> Path:
    (here / "talker.cdsl").write_text(CDSL)
    (here / "Talk.idsl").write_text(IDSL)
    return here


def tree(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def test_component_is_written_beside_file(rcgen: Rcgen, talker: Path) -> None:
    run = rcgen("component", "talker.cdsl")
    assert (run.code, run.err) == (0, "")
    expected = (
        "10 of 10 files written; yours to edit: specificworker.py, etc/config.yaml, README.md"
    )
    assert run.out == f".: {expected}\n"
    assert set(tree(talker)) == ALL | RECORD | {"talker.cdsl", "Talk.idsl"}


def test_component_is_written_into_output_folder(rcgen: Rcgen, talker: Path) -> None:
    assert rcgen("component", "talker.cdsl", "-o", "out/deep").code == 0
    assert set(tree(talker / "out" / "deep")) == ALL | RECORD


def test_component_is_idempotent(rcgen: Rcgen, talker: Path) -> None:
    rcgen("component", "talker.cdsl", "-o", "out")
    stamps = {p: p.stat().st_mtime_ns for p in (talker / "out").rglob("*")}
    run = rcgen("component", "talker.cdsl", "-o", "out")
    assert run.out == "out: nothing to do, all 10 files are up to date\n"
    assert {p: p.stat().st_mtime_ns for p in (talker / "out").rglob("*")} == stamps


def test_component_check_diff_and_dry_run_write_nothing(rcgen: Rcgen, talker: Path) -> None:
    before = tree(talker)
    run = rcgen("component", "talker.cdsl", "--check")
    assert run.code == 1
    assert "error: `main.py` is missing\n" in run.err
    diff = rcgen("component", "talker.cdsl", "--diff")
    assert diff.code == 0
    assert "--- /dev/null\n+++ main.py\n" in diff.out
    dry = rcgen("component", "talker.cdsl", "--dry-run")
    assert dry.code == 0
    assert dry.out.count("create ") == 10
    assert tree(talker) == before


def test_component_check_after_change(rcgen: Rcgen, talker: Path) -> None:
    rcgen("component", "talker.cdsl")
    assert rcgen("component", "talker.cdsl", "--check").code == 0
    (talker / "Talk.idsl").write_text(IDSL.replace("string text", "string word"))
    run = rcgen("component", "talker.cdsl", "--check")
    assert run.code == 1
    assert "`talker_generated/interfaces.py` is out of date" in run.err
    assert "main.py" not in run.err
    diff = rcgen("component", "talker.cdsl", "--diff").out
    assert '-    rt.Operation("say", inputs={"text": rt.String}, returns=rt.Int),\n' in diff
    assert '+    rt.Operation("say", inputs={"word": rt.String}, returns=rt.Int),\n' in diff
    dry = rcgen("component", "talker.cdsl", "--dry-run").out
    assert "update     talker_generated/interfaces.py\n" in dry
    assert "keep       specificworker.py\n" in dry


def test_component_modes_exclude_each_other(rcgen: Rcgen, talker: Path) -> None:
    run = rcgen("component", "talker.cdsl", "--check", "--diff")
    assert run.code == 2
    assert "--check" in run.err


def test_component_reports_missing_methods_of_user_class(rcgen: Rcgen, talker: Path) -> None:
    rcgen("component", "talker.cdsl")
    more = IDSL.replace("int say", "void shout(); int say")
    (talker / "Talk.idsl").write_text(more)
    mine = (talker / "specificworker.py").read_text()
    assert rcgen("component", "talker.cdsl", "--check").code == 1
    run = rcgen("component", "talker.cdsl")
    assert run.code == 0
    assert (
        "warning[RC611]: `SpecificWorker` has no method for the operation `shout`; this" in run.err
    )
    assert "--> specificworker.py:24:9" in run.err
    assert "--> Talk.idsl:1:34" in run.err
    now = (talker / "specificworker.py").read_text()
    assert now.startswith(mine)
    assert now[len(mine) :].startswith("\n    def Talk_shout(self) -> None:\n")
    assert rcgen("component", "talker.cdsl").err == ""


def test_component_writes_nothing_after_error(rcgen: Rcgen, talker: Path) -> None:
    (talker / "talker.cdsl").write_text(CDSL.replace("implements Talk", "implements Tolk"))
    before = tree(talker)
    run = rcgen("component", "talker.cdsl")
    assert run.code == 1
    assert "did you mean `Talk`?" in run.err
    assert run.out == ""
    assert tree(talker) == before


@pytest.mark.parametrize("language", ["Cpp", "Cpp11"])
def test_component_rejects_unsupported_language(rcgen: Rcgen, talker: Path, language: str) -> None:
    (talker / "talker.cdsl").write_text(CDSL.replace("Python", language))
    run = rcgen("component", "talker.cdsl")
    assert run.code == 1
    assert f"error[RC601]: there is no target for {language} yet\n" in run.err
    assert "  --> talker.cdsl:2:66\n" in run.err
    assert "`--language python`" in run.err
    assert rcgen("component", "talker.cdsl", "--language", "Python").code == 0


def test_component_middleware_option_overrides_file(rcgen: Rcgen, talker: Path) -> None:
    assert rcgen("component", "talker.cdsl", "--middleware", "InProc").code == 0
    assert 'middleware="inproc"' in (talker / "talker_generated" / "genericworker.py").read_text()
    run = rcgen("component", "talker.cdsl", "--middleware", "zeno")
    assert run.code == 2
    assert "there is no middleware 'zeno'; did you mean `zenoh`?" in run.err


def test_component_rejects_file_as_output_folder(rcgen: Rcgen, talker: Path) -> None:
    (talker / "out").write_text("mine")
    run = rcgen("component", "talker.cdsl", "-o", "out")
    assert (run.code, run.out) == (1, "")
    assert run.err == "error: `out` is a file, not a folder\n"
    assert (talker / "out").read_text() == "mine"


def test_component_reports_unwritable_folder(rcgen: Rcgen, talker: Path) -> None:
    run = rcgen("component", "talker.cdsl", "-o", "/proc/nothing/here")
    assert run.code == 1
    assert run.err.startswith("error: cannot write `/proc/nothing")


IMPORTS = ["../../etc/passwd", "/etc/passwd", "..\\..\\secret.idsl", "a\nb.idsl", "{{ 7*7 }}.idsl"]


@pytest.mark.parametrize("written", IMPORTS)
def test_component_rejects_invalid_import_paths(rcgen: Rcgen, talker: Path, written: str) -> None:
    (talker / "talker.cdsl").write_text(f'import "{written}";\n{CDSL}')
    run = rcgen("component", "talker.cdsl")
    assert run.code == 1
    assert "--> talker.cdsl:1:" in run.err
    assert "root:" not in run.err


NAMES = ['a"b', "a'b", "{{ 7*7 }}", "a b", "1a", "é", "a;import os"]


@pytest.mark.parametrize("name", NAMES)
def test_component_rejects_invalid_names(rcgen: Rcgen, talker: Path, name: str) -> None:
    (talker / "talker.cdsl").write_text(CDSL.replace("talker", name))
    before = set(tree(talker))
    run = rcgen("component", "talker.cdsl")
    assert run.code == 1
    assert "error[RC" in run.err
    assert set(tree(talker)) == before


def test_component_keeps_broken_user_code(rcgen: Rcgen, talker: Path) -> None:
    (talker / "specificworker.py").write_text("def x(:\n")
    run = rcgen("component", "talker.cdsl")
    assert run.code == 0
    assert "warning[RC613]: Python cannot read `specificworker.py`" in run.err
    assert "--> specificworker.py:1:7" in run.err
    (talker / "specificworker.py").write_bytes(b"\xff\x00")
    run = rcgen("component", "talker.cdsl")
    assert "warning[RC613]" in run.err
    assert (talker / "specificworker.py").read_bytes() == b"\xff\x00"
    (talker / "specificworker.py").write_text("class SpecificWorkr: pass\n")
    assert "did you mean `SpecificWorkr`?" in rcgen("component", "talker.cdsl").err


WORKERS = {
    "def": ("def Talk_say(self, text): ...", True),
    "async": ("async def Talk_say(self, text): ...", True),
    "assigned": ("Talk_say = None", True),
    "nothing": ("pass", False),
    "a near name": ("def Talk_sya(self, text): ...", False),
}


@pytest.mark.parametrize("case", WORKERS)
def test_component_finds_methods_of_user_class(rcgen: Rcgen, talker: Path, case: str) -> None:
    body, complete = WORKERS[case]
    text = f"class SpecificWorker(GenericWorker):\n    {body}\n"
    (talker / "specificworker.py").write_text(text)
    run = rcgen("component", "talker.cdsl")
    assert ("RC611" not in run.err) is complete
    if "near" in case:
        assert "is `Talk_sya` meant for it?" in run.err


def test_component_finds_methods_of_other_bases(rcgen: Rcgen, talker: Path) -> None:
    file = talker / "specificworker.py"
    file.write_text(
        "class Mixin:\n    def Talk_say(self, text): ...\n"
        "class SpecificWorker(Mixin, GenericWorker):\n    pass\n"
    )
    assert rcgen("component", "talker.cdsl").err == ""
    file.write_text("class SpecificWorker(elsewhere.Mixin, GenericWorker):\n    pass\n")
    assert rcgen("component", "talker.cdsl").err == ""
    file.write_text("from mine import SpecificWorker\n")
    assert rcgen("component", "talker.cdsl").err == ""


def test_component_output_with_limited_terminal_encoding(
    rcgen: Rcgen, talker: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (talker / "talker.cdsl").write_text(CDSL.replace("Talk;", "Tälk;"), "utf-8")
    monkeypatch.setattr(type(sys.stderr), "encoding", "ascii", raising=False)
    assert rcgen("component", "talker.cdsl").code == 1


def test_component_reports_impossible_folder_name(rcgen: Rcgen, talker: Path) -> None:
    run = rcgen("component", "talker.cdsl", "-o", "x" * 300)
    assert run.code == 1
    assert run.err == f"error: cannot write `{'x' * 300}`: the path is too long\n"


def test_component_reports_unreadable_user_file(
    rcgen: Rcgen, talker: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    open_file = os.open

    def refuse_description(path: Any, *flags: Any, **folder: Any) -> int:
        if str(path).endswith(".cdsl"):
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))
        return open_file(path, *flags, **folder)

    monkeypatch.setattr(os, "access", lambda *_, **__: False)  # as the command line asks
    monkeypatch.setattr(os, "open", refuse_description)  # root may read all files
    run = rcgen("component", "talker.cdsl")
    assert run.code == 1
    assert run.err.startswith("error[RC001]: cannot read `talker.cdsl`")


@pytest.mark.parametrize("mode", ["--check", "--diff", "--dry-run"])
def test_component_dry_run_does_not_claim_changes(rcgen: Rcgen, talker: Path, mode: str) -> None:
    assert rcgen("component", "talker.cdsl").code == 0
    worker, readme = talker / "specificworker.py", talker / "README.md"
    worker.write_text("class SpecificWorker(GenericWorker):\n    pass\n")
    readme.write_text(f"{readme.read_text()}\n\n\nMine.\n")
    (talker / "talker.cdsl").write_text(
        f"/** Talks a lot. */\n{(talker / 'talker.cdsl').read_text()}"
    )
    before = tree(talker)
    run = rcgen("component", "talker.cdsl", mode)
    assert run.code == (1 if mode == "--check" else 0)
    assert "no method `Talk_say` for the operation `say`; a stub would be added" in run.err
    assert "--> specificworker.py:1:7" in run.err
    assert "is added" not in run.err
    assert "is merged" not in run.err
    assert tree(talker) == before
    assert "this stub was added" in rcgen("component", "talker.cdsl").err
    assert rcgen("component", "talker.cdsl", "--check").code == 0


def test_component_is_generated_without_what_a_missing_import_declares(
    rcgen: Rcgen, talker: Path
) -> None:
    text = CDSL.replace("implements Talk;", "implements Talk; requires Gone;")
    (talker / "talker.cdsl").write_text('import "Gone.idsl";\n' + text)
    run = rcgen("component", "talker.cdsl")
    assert run.code == 1
    assert "RC201" in run.err
    assert "generated without `Gone`" in run.err
    assert "def Talk_say" in (talker / "specificworker.py").read_text()
    assert "Gone" not in (talker / "talker_generated" / "genericworker.py").read_text()


def test_component_of_topic_with_outputs_has_the_other_operations(
    rcgen: Rcgen, talker: Path
) -> None:
    idsl = "module M { interface Talk { int say(string text); void said(string text); }; };\n"
    (talker / "Talk.idsl").write_text(idsl)
    (talker / "talker.cdsl").write_text(CDSL.replace("implements", "subscribesTo"))
    run = rcgen("component", "talker.cdsl")
    assert run.code == 0
    assert "warning[RC314]: `say` of `Talk` returns something: not part of the topic" in run.err
    text = (talker / "specificworker.py").read_text()
    assert "def Talk_said" in text
    assert "Talk_say(" not in text
