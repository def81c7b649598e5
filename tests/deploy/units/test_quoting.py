"""Values in unit files; tests/hosts checks with systemd that it reads them back."""

from __future__ import annotations

import pytest

from robocomp_dsl.deploy.units import names, quoting
from robocomp_dsl.deploy.units.quoting import PathMap, UnitValueError


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("arm", "robocomp-patrol-arm.service"),
        ("left/arm", "robocomp-patrol-left-arm.service"),
        ("arm-motor", r"robocomp-patrol-arm\x2dmotor.service"),
        ("router", "robocomp-patrol-router.service"),
    ],
)
def test_service_name_is_escaped(name: str, unit: str) -> None:
    assert names.service_name("patrol", name) == unit
    assert names.is_unit_of("patrol", unit)
    assert not names.is_unit_of("pat", unit)


def test_service_names_differ_from_units_of_deployment() -> None:
    assert names.router_name("a") == "robocomp-a.router.service"
    assert names.target_name("a-b") == r"robocomp-a\x2db.target"
    assert names.service_name("a", "b") not in (names.target_name("a"), names.router_name("a"))
    assert not names.is_unit_of("a", names.service_name("a-b", "c"))


@pytest.mark.parametrize(
    ("value", "text"),
    [
        ("main.py", "main.py"),
        ("", '""'),
        ("a b", '"a b"'),
        ("50%", "50%%"),
        ("$HOME", '"$$HOME"'),
        ('say "hi"', r'"say \"hi\""'),
        ("a\\b", r'"a\\b"'),
        ("one\ntwo\t", r'"one\ntwo\t"'),
        ("bell\x07", r'"bell\x07"'),
        (";", '";"'),
        ("né", '"né"'),
    ],
)
def test_argument_is_quoted(value: str, text: str) -> None:
    assert quoting.argument(value) == text


@pytest.mark.parametrize("value", ["a\0b", "\udc80"])
def test_argument_rejects_what_systemd_cannot_hold(value: str) -> None:
    with pytest.raises(UnitValueError):
        quoting.argument(value)


def test_assignment_keeps_dollars_and_rejects_control_characters() -> None:
    assert quoting.assignment("A", "b $c") == '"A=b $c"'
    with pytest.raises(UnitValueError, match=r"U\+0007"):
        quoting.assignment("A", "\x07")
    with pytest.raises(UnitValueError, match="not a name"):
        quoting.assignment("A B", "x")


def test_path_map_replaces_whole_paths_only() -> None:
    paths = PathMap((("/@home", "%h"), ("/@home/x", "%h/y")))
    assert quoting.argument("/@home/a", paths) == "%h/a"
    assert quoting.argument("file=/@home/x/b c", paths) == '"file=%h/y/b c"'
    assert quoting.argument("/@homes/a", paths) == "/@homes/a"
    assert quoting.argument("/other/@home/a", paths) == "/other/@home/a"
    assert quoting.path("/@home/50%", paths) == "%h/50%%"


@pytest.mark.parametrize("text", ["/a\n", " /a", "/a\\"])
def test_path_rejects_what_a_line_cannot_hold(text: str) -> None:
    with pytest.raises(UnitValueError):
        quoting.path(text)
