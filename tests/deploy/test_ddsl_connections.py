"""Changes of connections in a DDSL file: the edit, its verification, and what cannot be written."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from robocomp_dsl.deploy.ddsl_connections import (
    ConnectionNames,
    remove_connection,
    write_connection,
    write_connection_qos,
)
from robocomp_dsl.deploy.ddsl_settings import CannotEdit
from tests.check.case_models import CASES

PARTS = CASES / "ddsl" / "sem_parts"
IMPORTS = "".join(f'import "{PARTS / name}.cdsl";\n' for name in ("body", "reflex", "filter"))
LASER = ConnectionNames("reflex", "Laser", "body", "Laser")
SCAN = ConnectionNames("body", "LaserPub", "reflex", "LaserPub")


@pytest.fixture(autouse=True)
def interfaces(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROBOCOMP_INTERFACES", str(CASES / "interfaces"))


def written(tmp_path: Path, body: str) -> Path:
    path = tmp_path / "app.ddsl"
    path.write_text(f"{IMPORTS}Deployment demo\n{{\n{body}}};\n")
    return path


def body_of(path: Path) -> str:
    return path.read_text().partition("{\n")[2].removesuffix("};\n")


def test_write_connection_follows_last_connection(tmp_path: Path) -> None:
    path = written(
        tmp_path,
        "    component body; component other : body;\n    component reflex;\n"
        "    connect body.LaserPub -> reflex.LaserPub;  // the scan\n"
        "    connect reflex.Laser -> other.Laser;\n",
    )
    names = ConnectionNames("other", "LaserPub", "reflex", "LaserPub")
    write_connection(path, names, "zenoh")
    assert body_of(path).endswith(
        "    connect body.LaserPub -> reflex.LaserPub;  // the scan\n"
        "    connect reflex.Laser -> other.Laser;\n"
        "    connect other.LaserPub -> reflex.LaserPub over zenoh;\n"
    )
    write_connection(path, names)
    assert path.read_text().count("connect ") == 3
    write_connection(path, names, "local")
    assert "connect other.LaserPub -> reflex.LaserPub over local;" in path.read_text()
    write_connection(path, ConnectionNames("reflex", "Laser", "other", "Laser"), "local")
    assert "connect reflex.Laser -> other.Laser over local;" in path.read_text()


def test_write_connection_into_first_line_of_short_deployment(tmp_path: Path) -> None:
    path = written(tmp_path, "component body; component reflex;")
    write_connection(path, LASER, "local")
    assert body_of(path) == (
        "component body; component reflex; connect reflex.Laser -> body.Laser over local;"
    )


def test_write_connection_uses_scopes_and_exports_of_groups(tmp_path: Path) -> None:
    groups = (
        "    group a\n    {\n        component body;\n"
        "        group deep { component reflex; component filter; export Laser from reflex; };\n"
        "        EXPORT\n    };\n    component reflex;\n"
    )
    path = written(tmp_path, groups.replace("EXPORT", "export Laser from body as Scan;"))
    write_connection(path, ConnectionNames("a-deep-reflex", "Laser", "a-body", "Laser"), "zenoh")
    assert "connect deep.Laser -> body.Laser over zenoh;" in path.read_text()
    path = written(tmp_path, groups.replace("EXPORT", "export Laser from body as Scan;"))
    write_connection(path, ConnectionNames("reflex", "Laser", "a-body", "Laser"), "zenoh")
    assert "\n    connect reflex.Laser -> a.Scan over zenoh;\n" in path.read_text()
    names = ConnectionNames("a-body", "LaserPub", "reflex", "LaserPub")
    with pytest.raises(CannotEdit, match="`a` does not export `LaserPub` of `a-body`"):
        write_connection(path, names)


def test_remove_connection_takes_its_line(tmp_path: Path) -> None:
    head = "    component body;\n    component other : body;\n    component reflex;\n"
    unchanged = "    connect other.LaserPub -> reflex.LaserPub;\n"
    served = "    connect reflex.Laser -> body.Laser;\n"
    gone = "    connect body.LaserPub -> reflex.LaserPub { keep last 1; };\n"
    path = written(tmp_path, head + gone + unchanged + served)
    remove_connection(path, SCAN)
    assert body_of(path) == head + unchanged + served
    path = written(tmp_path, head + unchanged.rstrip() + gone + served)
    remove_connection(path, SCAN)
    assert body_of(path).splitlines()[3] == f"{unchanged.rstrip()}    "


def test_remove_connection_that_would_be_implied_is_explained(tmp_path: Path) -> None:
    path = written(
        tmp_path,
        "component body; component reflex; connect body.LaserPub -> reflex.LaserPub;",
    )
    with pytest.raises(CannotEdit, match="follows from the requirement"):
        remove_connection(path, SCAN)


@pytest.mark.parametrize(
    ("statement", "items", "expected"),
    [
        ("{ keep last 1; priority low; };", ["depth=5", "priority=off"], " { keep last 5; };"),
        (";", ["best_effort", "deadline=40"], " { best_effort; deadline 40 ms; };"),
        ("over local { reliable; };", ["reliable=off"], " over local;"),
        ("{ reliable; keep all; latched; };", ["best_effort", "keep_all=off"],
         " { best_effort; latched; };"),
        ("{ liveliness 2 s; };", ["thread_priority=20"],
         " { liveliness 2000 ms; thread priority 20; };"),
    ],
)  # fmt: skip
def test_write_connection_qos_replaces_items(
    tmp_path: Path, statement: str, items: list[str], expected: str
) -> None:
    head = "    component body;\n    component reflex;\n"
    connect = "connect body.LaserPub -> reflex.LaserPub"
    separator = "" if statement == ";" else " "
    path = written(tmp_path, f"{head}    {connect}{separator}{statement}\n")
    write_connection_qos(path, SCAN, items)
    assert body_of(path) == f"{head}    {connect}{expected}\n"


def test_write_connection_qos_makes_implied_connection_explicit(tmp_path: Path) -> None:
    path = written(tmp_path, "    component body;\n    component reflex;\n")
    write_connection_qos(path, LASER, ["priority=high"])
    assert body_of(path).endswith("    connect reflex.Laser -> body.Laser { priority high; };\n")


def add_laser(path: Path) -> None:
    write_connection(path, LASER, "zenoh")


COMMENTED = (
    "component body; component reflex;"
    " connect body.LaserPub -> reflex.LaserPub { keep last 1; /* x */ };"
)


@pytest.mark.parametrize(
    ("body", "change", "message"),
    [
        ("component body;", add_laser, "no component `reflex`"),
        ("component body; component reflex; component reflex;", add_laser, "has errors"),
        (COMMENTED, lambda path: write_connection_qos(path, SCAN, ["depth=2"]), "has comments"),
    ],
)
def test_edit_that_is_not_possible_leaves_file(
    tmp_path: Path, body: str, change: Callable[[Path], None], message: str
) -> None:
    path = written(tmp_path, body)
    before = path.read_text()
    with pytest.raises(CannotEdit, match=message):
        change(path)
    assert path.read_text() == before


def test_remove_connection_that_is_implied_is_explained(tmp_path: Path) -> None:
    path = written(tmp_path, "    component body;\n    component reflex;\n")
    with pytest.raises(CannotEdit, match="has no `connect` of its own"):
        remove_connection(path, LASER)
    with pytest.raises(CannotEdit, match="has no connection"):
        remove_connection(path, ConnectionNames("body", "X", "reflex", "X"))


def test_edit_of_missing_file_is_reported(tmp_path: Path) -> None:
    with pytest.raises(CannotEdit, match=r"gone\.ddsl"):
        write_connection(tmp_path / "gone.ddsl", LASER)


def test_connection_in_definition_of_group_is_not_written(tmp_path: Path) -> None:
    path = written(
        tmp_path,
        "    group pair { component body; component reflex; };\n"
        "    group left : pair { prefix left; };\n    group right : pair { prefix right; };\n",
    )
    names = ConnectionNames("left/left-reflex", "Laser", "left/left-body", "Laser")
    with pytest.raises(CannotEdit, match="definition of a group"):
        write_connection(path, names, "zenoh")
