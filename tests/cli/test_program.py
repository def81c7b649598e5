"""Commands end with the right exit code and a message of one line, also after internal errors."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import click
import pytest

from robocomp_dsl.cli import program
from robocomp_dsl.cli.rcgen.main import TABLE
from robocomp_dsl.cli.rcgen.main import program as rcgen_program
from tests.cli.rcgen_run import Rcgen

RCGEN = [sys.executable, "-c", "from robocomp_dsl.cli.rcgen.main import main; main()"]


def test_help_lists_all_commands_and_loads_none(rcgen: Rcgen) -> None:
    code = (
        "import sys\nfrom robocomp_dsl.cli.rcgen.main import main\n"
        "try: main()\nexcept SystemExit: pass\n"
        "heavy = {'lark', 'jinja2', 'yaml', 'numpy', 'zenoh', 'robocomp_dsl.check'}\n"
        "assert not heavy & set(sys.modules), heavy & set(sys.modules)\n"
    )
    command = [sys.executable, "-c", code, "--help"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    for name in TABLE:
        assert f"  {name} " in done.stdout


@pytest.mark.parametrize("name", TABLE)
def test_every_command_has_help(rcgen: Rcgen, name: str) -> None:
    run = rcgen(name, "--help")
    assert run.code == 0
    assert f"Usage: rcgen {name}" in run.out


def test_version(rcgen: Rcgen) -> None:
    assert rcgen("--version").out.startswith("rcgen, version ")


EXIT_USAGE = [
    (("chek",), "did you mean `check`?"),
    (("check", "--frmat", "json", "x"), "No such option"),
    (("check", "--format", "xml", "x"), "'xml' is not one of"),
    (("component",), "Missing argument"),
    ((), "Usage: rcgen"),
]


@pytest.mark.parametrize(("arguments", "message"), EXIT_USAGE)
def test_usage_errors_exit_with_2(rcgen: Rcgen, arguments: tuple[str, ...], message: str) -> None:
    run = rcgen(*arguments)
    assert run.code == program.EXIT_USAGE
    assert message in run.err


@pytest.fixture
def failing(monkeypatch: pytest.MonkeyPatch) -> list[BaseException]:
    """The exception that `rcgen check` raises."""
    raised: list[BaseException] = []

    def check_file(*_: object) -> None:
        raise raised[0]

    monkeypatch.setattr("robocomp_dsl.cli.rcgen.check.check_file", check_file)
    monkeypatch.delenv(program.DEBUG, raising=False)
    return raised


def test_internal_error_is_one_line(
    rcgen: Rcgen, failing: list[BaseException], tmp_path: Path
) -> None:
    failing.append(ValueError("two\nlines"))
    run = rcgen("check", tmp_path / "x.cdsl")
    assert run.code == program.EXIT_SOFTWARE
    assert run.err.count("\n") == 1
    assert run.err.startswith(
        "rcgen: internal error, please report it: ValueError: two lines at "
        "robocomp_dsl/cli/rcgen/check.py:"
    )
    assert "ROBOCOMP_DEBUG=1 shows the whole traceback" in run.err


def test_debug_variable_shows_traceback(
    rcgen: Rcgen, failing: list[BaseException], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    failing.append(ValueError("x"))
    monkeypatch.setenv(program.DEBUG, "1")
    with pytest.raises(ValueError, match="x"):
        rcgen("check", tmp_path / "x.cdsl")


@pytest.mark.parametrize("kind", [RecursionError, MemoryError, AssertionError, KeyError])
def test_every_exception_is_an_internal_error(
    rcgen: Rcgen, failing: list[BaseException], kind: type[BaseException], tmp_path: Path
) -> None:
    failing.append(kind())
    assert rcgen("check", tmp_path / "x.cdsl").code == program.EXIT_SOFTWARE


def test_interrupt_exits_with_130(
    rcgen: Rcgen, failing: list[BaseException], tmp_path: Path
) -> None:
    failing.append(KeyboardInterrupt())
    run = rcgen("check", tmp_path / "x.cdsl")
    assert (run.code, run.err) == (program.EXIT_INTERRUPTED, "\nrcgen: interrupted\n")


def test_broken_pipe_exits_with_141(tmp_path: Path) -> None:
    many = "\n".join(f"x{i};" for i in range(3000))
    (tmp_path / "a.cdsl").write_text(f"Component a {{ {many} }};")
    reading, writing = os.pipe()
    os.close(reading)
    command = [*RCGEN, "check", "a.cdsl"]
    done = subprocess.run(
        command, cwd=tmp_path, stdout=writing, stderr=subprocess.PIPE, text=True, check=False
    )
    os.close(writing)
    assert "Traceback" not in done.stderr
    assert "Exception ignored" not in done.stderr
    assert done.returncode == program.EXIT_BROKEN_PIPE


def test_sigterm_rolls_back_and_exits_with_143() -> None:
    """SIGTERM raises an exception, so that partial output is rolled back."""
    code = (
        "import os, signal\nfrom robocomp_dsl.cli import program\nimport click\n"
        "@click.command()\ndef command():\n"
        "    try: os.kill(os.getpid(), signal.SIGTERM)\n"
        "    finally: print('taken back')\n"
        "program.run(command, 'x')\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (program.EXIT_TERMINATED, "taken back\n")
    assert done.stderr == ""


def test_table_line_starts_like_command_help() -> None:
    context = click.Context(rcgen_program)
    for name, (_, about) in TABLE.items():
        command = rcgen_program.get_command(context, name)
        assert command is not None
        assert about.split()[0] == (command.help or "").split()[0]
    assert signal.SIGTERM
