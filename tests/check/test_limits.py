"""Unreadable, huge and deeply nested files give findings."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.languages import CHECKS, check_file, check_syntax
from robocomp_dsl.check.passes import check_ddsl, check_idsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report


def _found(path: Path) -> list[str]:
    report = Report()
    check_file(path, Workspace(environ={}, shipped=Path("nowhere")), report)
    return [diagnostic.code.id for diagnostic in report]


@pytest.mark.parametrize("suffix", CHECKS)
@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\n \n",
        b"\0\1\2\xff",
        b"\xff\xfe" + "module".encode("utf-16-le"),
        b"caf\xe9",
        b"{" * 3000,
    ],
    ids=["empty", "blank", "binary", "utf-16", "latin-1", "braces"],
)
def test_check_file_reports_other_content(tmp_path: Path, suffix: str, content: bytes) -> None:
    path = tmp_path / f"x{suffix}"
    path.write_bytes(content)
    found = _found(path)
    assert found or (suffix == ".msg" and not content.strip())  # a message without fields
    assert all(diagnostic.startswith(("RC0", "RC1")) for diagnostic in found)


@pytest.mark.parametrize("suffix", CHECKS)
def test_check_file_reports_missing_folder_and_huge_files(tmp_path: Path, suffix: str) -> None:
    assert _found(tmp_path / f"x{suffix}") == ["RC001"]
    (tmp_path / f"folder{suffix}").mkdir()
    assert _found(tmp_path / f"folder{suffix}") == ["RC001"]
    (tmp_path / f"huge{suffix}").write_bytes(b" " * (5 * 1024 * 1024))
    assert _found(tmp_path / f"huge{suffix}") == ["RC001"]


def test_check_file_reports_unknown_suffix(tmp_path: Path) -> None:
    path = tmp_path / "x.txt"
    path.write_text("module M { };\n")
    assert _found(path) == ["RC220"]
    report = Report()
    check_syntax(path, Workspace(environ={}), report)
    assert [diagnostic.code.id for diagnostic in report] == ["RC220"]


def test_import_depth_is_limited(tmp_path: Path) -> None:
    for number in range(300):
        text = f'import "F{number + 1}.idsl";\nmodule M{number} {{ struct S {{ int a; }}; }};\n'
        (tmp_path / f"F{number}.idsl").write_text(text)
    assert _found(tmp_path / "F0.idsl") == ["RC210"]


def test_branching_imports_are_checked_once(tmp_path: Path) -> None:
    for number in range(40):
        imports = f'import "F{number + 1}.idsl";\nimport "G{number + 1}.idsl";\n'
        for name in "FG":
            path = tmp_path / f"{name}{number}.idsl"
            path.write_text(f"{imports}module {name}{number} {{ struct S {{ int a; }}; }};\n")
    for name in "FG":
        (tmp_path / f"{name}40.idsl").write_text(f"module {name}40 {{ }};\n")
    assert _found(tmp_path / "F0.idsl") == []


@pytest.mark.parametrize("order", [1, -1])
def test_type_depth_is_limited(tmp_path: Path, order: int) -> None:
    structs = [f"struct S{n} {{ S{n - 1} a; }};" for n in range(1, 1500)]
    path = tmp_path / "x.idsl"
    path.write_text("module M { struct S0 { int a; }; " + " ".join(structs[::order]) + " };\n")
    assert _found(path)
    assert set(_found(path)) == {"RC317"}


def test_type_size_is_limited(tmp_path: Path) -> None:
    structs = [f"struct S{n} {{ S{n - 1} a; S{n - 1} b; }};" for n in range(1, 60)]
    path = tmp_path / "x.idsl"
    path.write_text("module M { struct S0 { int a; }; " + " ".join(structs) + " };\n")
    assert set(_found(path)) == {"RC317"}


def test_type_depth_is_limited_across_files(tmp_path: Path) -> None:
    (tmp_path / "F0.idsl").write_text("module M0 { struct S { int a; }; };\n")
    for number in range(1, 45):
        before = f"M{number - 1}::S"
        text = f"module M{number} {{ struct T {{ {before} a; }}; struct S {{ T a; }}; }};\n"
        path = tmp_path / f"F{number}.idsl"
        path.write_text(f'import "F{number - 1}.idsl";\n{text}')
    assert "RC317" in _found(tmp_path / "F44.idsl")


def test_huge_numbers_are_reported(tmp_path: Path) -> None:
    digits, power = "9" * 6000, "1e999999"
    texts = {
        "a.idsl": f"module M {{ enum E {{ A = {digits}, B = {power} }}; "
        f"struct S {{ int a = {digits}; float b = {digits}; double c = {power}; }}; }};",
        "a.cdsl": f"Component c {{ Communications {{ }}; language Python; period {digits}; "
        f"threads {power}; }};",
        "a.pdsl": f"ComponentParams p {{ a int {digits} 0:{power}; b float {power} {digits}:; "
        f"c[{digits}] {{ d int 1; }}; }};",
        "a.ddsl": f'import "a.cdsl"; Deployment d {{ component c {{ port {digits}; '
        f"ready within {digits} s; restart always max {power} in {power} s; "
        f"set a = {digits}; }}; }};",
    }
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    for name in texts:
        assert _found(tmp_path / name), name


def test_start_order_of_long_chain(tmp_path: Path) -> None:
    (tmp_path / "c.cdsl").write_text("Component c { Communications { }; language Python; };\n")
    lines = [f"component c{n} : c {{ after c{n + 1}; }};" for n in range(3000)]
    path = tmp_path / "x.ddsl"
    path.write_text(
        'import "c.cdsl"; Deployment d { ' + "\n".join(lines) + "component c3000 : c; };"
    )
    report = Report()
    deployment = check_ddsl(path, Workspace(environ={}), report)
    assert deployment is not None
    assert not report.has_errors
    assert [instance.name for instance in deployment.instances] == [
        f"c{n}" for n in range(3000, -1, -1)
    ]


def test_unreadable_imports_are_reported(tmp_path: Path) -> None:
    (tmp_path / "Bad.idsl").write_bytes(b"\0\0\0")
    path = tmp_path / "x.idsl"
    path.write_text('import "Bad.idsl";\nmodule M { };\n')
    report = Report()
    assert check_idsl(path, Workspace(environ={}), report) is not None
    assert [diagnostic.code.id for diagnostic in report] == ["RC209"]


NESTED = {
    "x.smdsl": (
        "deep { initial_state s0; };\n",
        lambda n: "".join(f":s{i} {{ initial_state s{i + 1}; }};\n" for i in range(n)),
        "RC709",
    ),
    "turned.smdsl": (
        "deep { initial_state s0; };\n",
        lambda n: "".join(f":s{i} {{ initial_state s{i + 1}; }};\n" for i in range(n)[::-1]),
        "RC709",
    ),
    "x.scxml": (
        "",
        lambda n: (
            '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0">'
            + "".join(f'<state id="s{i}">' for i in range(n))
            + "</state>" * n
            + "</scxml>"
        ),
        "RC709",
    ),
    "x.xml": (
        "",
        lambda n: (
            "<innerModel>"
            + "".join(f'<transform id="t{i}">' for i in range(n))
            + "</transform>" * n
            + "</innerModel>"
        ),
        "RC807",
    ),
    "x.ddsl": ("Deployment d {", lambda n: "group g { " * n + "};" * n + "};", "RC005"),
    "x.pdsl": ("ComponentParams d {", lambda n: "g { " * n + "};" * n + "};", "RC005"),
    "x.idsl": ("module M {", lambda n: "sequence<" * n + "int" + ">" * n + " a; };", "RC005"),
}


@pytest.mark.parametrize("name", NESTED)
@pytest.mark.parametrize("depth", [600, 6000])
def test_nesting_depth_is_limited(tmp_path: Path, name: str, depth: int) -> None:
    start, nested, code = NESTED[name]
    (tmp_path / name).write_text(start + nested(depth))
    found = _found(tmp_path / name)
    assert code in found
    assert len(found) < 5


@pytest.mark.parametrize(
    "definitions",
    [
        [f"group d{i} {{ group x : d{i + 1}; group y : d{i + 1}; }};" for i in range(30)],
        [f"group d{i} : d{i + 1};" for i in range(200)],
        [f"group d{i} {{ group x : d{i + 1}; }};" for i in range(200)],
    ],
    ids=["doubled", "derived", "nested"],
)
def test_check_ddsl_limits_instances_of_groups(tmp_path: Path, definitions: list[str]) -> None:
    (tmp_path / "c.cdsl").write_text("Component c { language Python; };")
    last = f"group d{len(definitions)} {{ component c; }};"
    (tmp_path / "x.ddsl").write_text(
        'import "c.cdsl";\n' + "\n".join([*definitions, last, "Deployment x { group g : d0; };"])
    )
    assert set(_found(tmp_path / "x.ddsl")) == {"RC569"}


def test_check_ddsl_accepts_imports_in_a_circle(tmp_path: Path) -> None:
    (tmp_path / "c.cdsl").write_text("Component c { language Python; };")
    for name, other in (("x", "y"), ("y", "x")):
        (tmp_path / f"{name}.ddsl").write_text(
            f'import "{other}.ddsl"; import "c.cdsl"; group in_{name} {{ component c; }};\n'
            f"Deployment {name} {{ group one : in_x; group two : in_y; }};"
        )
    assert _found(tmp_path / "x.ddsl") == []
