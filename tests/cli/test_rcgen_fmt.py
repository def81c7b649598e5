"""`rcgen fmt`: files in place, standard input, `--check`, `--diff`; files with errors are kept."""

from __future__ import annotations

import io
import sys
from pathlib import Path

import pytest

from tests.cli.rcgen_run import Rcgen, Run

MESSY = "Component a {\n  language   Python; // why\n};\n"
NEAT = "Component a\n{\n    language Python;  // why\n};\n"
BROKEN = "Component b\n{\n    langage Python;\n    period ten\n"
BOM = "\N{ZERO WIDTH NO-BREAK SPACE}"


def piped(rcgen: Rcgen, text: bytes, *arguments: object) -> Run:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(text)))
        return rcgen("fmt", *arguments)


def test_fmt_in_place(rcgen: Rcgen, here: Path) -> None:
    Path("a.cdsl").write_text(MESSY)
    Path("b.cdsl").write_text(NEAT)
    run = rcgen("fmt", "a.cdsl", "b.cdsl")
    assert (run.code, run.out) == (0, "")
    assert run.err == "1 file formatted, 1 file unchanged\n"
    assert Path("a.cdsl").read_text() == NEAT
    assert rcgen("fmt", "a.cdsl").err == "1 file unchanged\n"
    assert rcgen("fmt", "-q", "a.cdsl") == Run(0, "", "")


def test_fmt_writes_only_changed_files(rcgen: Rcgen, here: Path) -> None:
    Path("a.cdsl").write_text(MESSY)
    Path("b.cdsl").write_text(NEAT)
    Path("a.cdsl").chmod(0o640)
    before = {name: Path(name).stat() for name in ("a.cdsl", "b.cdsl")}
    rcgen("fmt", ".")
    after = {name: Path(name).stat() for name in before}
    assert after["b.cdsl"].st_ino == before["b.cdsl"].st_ino
    assert after["b.cdsl"].st_mtime_ns == before["b.cdsl"].st_mtime_ns
    assert after["a.cdsl"].st_ino != before["a.cdsl"].st_ino  # a new file, renamed
    assert after["a.cdsl"].st_mode == before["a.cdsl"].st_mode
    assert sorted(map(str, Path().iterdir())) == ["a.cdsl", "b.cdsl"]


def test_fmt_of_folder(rcgen: Rcgen, here: Path) -> None:
    for name in ("x/a.cdsl", "x/y/b.pdsl", "x/build/c.cdsl", "x/.hidden/d.cdsl", "x/w.xml"):
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).write_text("<a  />" if name.endswith("xml") else MESSY)
    Path("x/y/b.pdsl").write_text("ComponentParams b { p int  1; };")
    run = rcgen("fmt", "x", "x/a.cdsl")
    assert run.err == "2 files formatted\n"
    assert Path("x/y/b.pdsl").read_text() == "ComponentParams b { p int 1; };\n"
    assert Path("x/build/c.cdsl").read_text() == MESSY
    assert Path("x/w.xml").read_text() == "<a  />"
    assert rcgen("fmt", "-q", "x/w.xml").code == 0
    assert Path("x/w.xml").read_text() == "<a/>\n"


def test_fmt_skips_tactile_descriptions(rcgen: Rcgen, here: Path) -> None:
    """A YAML file is skipped in a folder and rejected as an argument."""
    source = Path(__file__).parents[2] / "components" / "nao_simulator" / "tactile.yaml"
    Path("tactile.yaml").write_bytes(source.read_bytes())
    Path("a.cdsl").write_text(NEAT)
    assert rcgen("fmt", "--check", ".") == Run(0, "", "1 file unchanged\n")
    run = rcgen("fmt", "tactile.yaml")
    assert run.code == 1
    assert run.err.startswith("error: `tactile.yaml` is not formatted")


def test_fmt_check(rcgen: Rcgen, here: Path) -> None:
    Path("a.cdsl").write_text(MESSY)
    Path("b.cdsl").write_text(NEAT)
    run = rcgen("fmt", "--check", "a.cdsl", "b.cdsl")
    assert run == Run(1, "a.cdsl\n", "1 file would be formatted, 1 file unchanged\n")
    assert Path("a.cdsl").read_text() == MESSY
    assert rcgen("fmt", "--check", "b.cdsl") == Run(0, "", "1 file unchanged\n")


def test_fmt_diff(rcgen: Rcgen, here: Path) -> None:
    Path("a.cdsl").write_text(MESSY)
    run = rcgen("fmt", "--diff", "a.cdsl")
    assert (run.code, run.err) == (0, "")
    assert run.out.splitlines() == [
        "--- a.cdsl",
        "+++ a.cdsl",
        "@@ -1,3 +1,4 @@",
        "-Component a {",
        "-  language   Python; // why",
        "+Component a",
        "+{",
        "+    language Python;  // why",
        " };",
    ]
    assert Path("a.cdsl").read_text() == MESSY
    assert rcgen("fmt", "--diff", "--check", "a.cdsl").code == 1


def test_fmt_skips_files_with_errors(rcgen: Rcgen, here: Path) -> None:
    Path("a.cdsl").write_text(BROKEN)
    Path("b.cdsl").write_text(MESSY)
    run = rcgen("fmt", "a.cdsl", "gone.cdsl", "b.cdsl", "c.txt")
    assert run.code == 1
    assert "--> a.cdsl:3:5" in run.err
    assert "gone.cdsl" in run.err
    assert "unknown file suffix: `c.txt`" in run.err
    assert run.err.startswith("1 file formatted\n")
    assert Path("a.cdsl").read_text() == BROKEN
    assert Path("b.cdsl").read_text() == NEAT
    assert rcgen("fmt", "--check", "a.cdsl").code == 1


def test_fmt_does_not_report_warnings(rcgen: Rcgen, here: Path) -> None:
    Path("a.cdsl").write_text("Component a { language Python;; }")
    assert rcgen("fmt", "a.cdsl") == Run(0, "", "1 file formatted\n")
    assert Path("a.cdsl").read_text() == "Component a { language Python;; }\n"


def test_fmt_keeps_unformattable_files(rcgen: Rcgen, here: Path) -> None:
    fields = "".join(f"    int p{n}\n" for n in range(150))
    text = f"module M\n{{\n  struct S\n  {{\n{fields}  }};\n}};\n"
    Path("a.idsl").write_text(text)
    run = rcgen("fmt", "a.idsl")
    assert run.code == 1
    assert run.err.startswith("error: `a.idsl` is not formatted: too much legacy syntax;")
    assert Path("a.idsl").read_text() == text
    rcgen("check", "--fix", "a.idsl")  # the way out
    assert rcgen("fmt", "a.idsl") == Run(0, "", "1 file formatted\n")


@pytest.mark.parametrize("mark", ["", BOM], ids=["plain", "bom"])
@pytest.mark.parametrize("end", ["\n", "\r\n"], ids=["lf", "crlf"])
def test_fmt_keeps_byte_order_mark_and_line_ends(
    rcgen: Rcgen, here: Path, mark: str, end: str
) -> None:
    Path("a.cdsl").write_bytes((mark + MESSY.replace("\n", end)).encode())
    rcgen("fmt", "a.cdsl")
    expected = (mark + NEAT.replace("\n", end)).encode()
    assert Path("a.cdsl").read_bytes() == expected
    run = piped(rcgen, expected, "-", "--stdin-filename", "a.cdsl")
    assert run.out.encode() == expected


def test_fmt_keeps_symbolic_link(rcgen: Rcgen, here: Path) -> None:
    Path("real.cdsl").write_text(MESSY)
    Path("a.cdsl").symlink_to("real.cdsl")
    rcgen("fmt", "a.cdsl")
    assert Path("a.cdsl").is_symlink()
    assert Path("real.cdsl").read_text() == NEAT


def test_fmt_reports_unwritable_folder(
    rcgen: Rcgen, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(self: Path, other: Path) -> Path:
        raise PermissionError(13, "Permission denied", str(self))

    Path("a.cdsl").write_text(MESSY)
    monkeypatch.setattr(Path, "replace", refused)
    run = rcgen("fmt", "a.cdsl")
    assert run.code == 1
    assert f"error: cannot write `{here / 'a.cdsl'}`: you may not write there\n" in run.err
    assert Path("a.cdsl").read_text() == MESSY
    assert list(Path().iterdir()) == [Path("a.cdsl")]


def test_fmt_of_standard_input(rcgen: Rcgen, here: Path) -> None:
    run = piped(rcgen, MESSY.encode(), "-", "--stdin-filename", "some/where.cdsl")
    assert run == Run(0, NEAT, "")
    assert list(Path().iterdir()) == []
    run = piped(rcgen, MESSY.encode(), "-", "--stdin-filename", "a.cdsl", "--check")
    assert (run.code, run.out) == (1, "a.cdsl\n")
    run = piped(rcgen, MESSY.encode(), "-", "--stdin-filename", "a.cdsl", "--diff")
    assert run.out.startswith("--- a.cdsl\n")


def test_fmt_of_standard_input_with_errors(rcgen: Rcgen, here: Path) -> None:
    run = piped(rcgen, BROKEN.encode(), "-", "--stdin-filename", "a.cdsl")
    assert (run.code, run.out) == (1, "")
    assert "--> a.cdsl:3:5" in run.err
    run = piped(rcgen, b"\xff\xfe", "-", "--stdin-filename", "a.cdsl")
    assert (run.code, run.out) == (1, "")
    assert run.err.startswith("error: standard input cannot be read: ")


@pytest.mark.parametrize(
    "arguments", [["-"], ["a.cdsl", "--stdin-filename", "a.cdsl"], ["-", "a.cdsl"], []]
)
def test_fmt_usage_errors(rcgen: Rcgen, here: Path, arguments: list[str]) -> None:
    assert piped(rcgen, b"", *arguments).code == 2
