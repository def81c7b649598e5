"""Unusual descriptions: every name has one page, and every link resolves to it."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.doc.doc_site import check_links, pages, read

COMPONENT = (
    'import "{file}"; Component {name} {{ Communications {{ {ports} }}; language Python; }};'
)


def _write(folder: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def _text(files: dict[str, str], page: str) -> str:
    return read(files[f"{page}.html"]).text


def test_documentation_of_two_modules_in_one_file(tmp_path: Path) -> None:
    _write(
        tmp_path,
        {
            "Two.idsl": "module A { struct S { int a; }; }; "
            "module B { interface I { void f(A::S s); }; };",
            "c.cdsl": COMPONENT.format(file="Two.idsl", name="c", ports="implements I;"),
        },
    )
    site = pages(tmp_path / "c.cdsl")
    assert check_links(site)
    assert "interfaces/B.I.html" in site
    assert 'id="type.S"' in site["modules/A.html"]


@pytest.mark.parametrize(("other", "count"), [("int a;", 1), ("float b;", 2)])
def test_documentation_merges_equal_copies_of_file(tmp_path: Path, other: str, count: int) -> None:
    """Copies that differ have a page each."""
    idsl = "module M {{ struct S {{ {} }}; interface I {{ S f(); }}; }};"
    _write(
        tmp_path,
        {
            "x/I.idsl": idsl.format("int a;"),
            "y/I.idsl": idsl.format(other),
            "x/x.cdsl": COMPONENT.format(file="I.idsl", name="x", ports="implements I;"),
            "y/y.cdsl": COMPONENT.format(file="I.idsl", name="y", ports="requires I;"),
        },
    )
    site = pages(tmp_path / "x" / "x.cdsl", tmp_path / "y" / "y.cdsl")
    assert check_links(site)
    documented = [
        path for path in site if path.startswith("interfaces/") and path.endswith(".html")
    ]
    assert len(documented) == count
    assert ("y requires it" in _text(site, "interfaces/M.I")) == (count == 1)


def test_documentation_of_names_that_differ_in_case(tmp_path: Path) -> None:
    _write(
        tmp_path,
        {
            f"{name}.cdsl": COMPONENT.format(file="Laser.idsl", name=name, ports="requires Laser;")
            for name in ("base", "Base")
        },
    )
    site = pages(tmp_path / "base.cdsl", tmp_path / "Base.cdsl")
    assert check_links(site)
    assert {"components/Base.html", "components/base-2.html"} <= set(site)


def test_component_page_marks_optional_port(tmp_path: Path) -> None:
    ports = "requires Laser, Laser as spare optional;"
    text = COMPONENT.format(file="Laser.idsl", name="base", ports=ports)
    _write(tmp_path, {"base.cdsl": text})
    text = _text(pages(tmp_path / "base.cdsl"), "components/base")
    assert "Laser requires Laser" in text
    assert "spare requires, optional Laser" in text


def test_interface_page_shows_all_kinds_of_types(tmp_path: Path) -> None:
    _write(
        tmp_path,
        {
            "T.idsl": """
            module T {
                enum Colour { red, blue = 7 };
                sequence<Colour> Colours;
                dictionary<string, Colours> Named;
                struct Car { Colour colour = blue; string plate = "a\\"b"; bool fast = true;
                    double weight [kg]; Named all; };
                exception Broken { string what; };
                interface Garage {
                    idempotent Car get(string plate) throws Broken;
                    [command] void paint(Car car);
                    void call();
                    int longest(string firstParameter, string secondParameter, out Car third,
                        out Colours fourth) throws Broken;
                };
            };"""
        },
    )
    site = pages(tmp_path / "T.idsl")
    assert check_links(site)
    text = _text(site, "interfaces/T.Garage")
    for item in (
        "get query idempotent",
        "paint command",
        "call query publish",
        "colour Colour blue",
        'plate string "a\\"b"',
        "fast bool true",
        "weight double kg",
        "sequence<Colour> Colours;",
        "dictionary<string, Colours> Named;",
        "blue 7",
        "int longest( string firstParameter, string secondParameter, out Car third,",
    ):
        assert item in text
    assert 'href="#type.Car"' in site["interfaces/T.Garage.html"]
    assert 'href="#type.Broken"' in site["interfaces/T.Garage.html"]


def test_parameter_page_shows_all_kinds_of_parameters(tmp_path: Path) -> None:
    _write(
        tmp_path,
        {
            "p.pdsl": """
            ComponentParams p {
                must string;
                half float 0.5 0:;
                low int :10;
                on bool true live;
                mode {fast, slow} slow;
                motors[1:4] { name string; limits { top float 1.5 [rad]; }; };
            };"""
        },
    )
    site = pages(tmp_path / "p.pdsl")
    assert check_links(site)
    text = _text(site, "parameters/p").replace("\u00a0", " ")
    for item in (
        "must string must be given",
        "half float 0.5 ≥ 0",
        "low int must be given ≤ 10",
        "on live bool true",
        "mode one of fast, slow slow",
        "motors[] list of 1 to 4 groups",
        "motors[].limits.top float 1.5 rad",
    ):
        assert item in text


def test_component_page_of_empty_component(tmp_path: Path) -> None:
    _write(tmp_path, {"e.cdsl": "Component e { language Python; period 0; };"})
    site = pages(tmp_path / "e.cdsl")
    assert check_links(site)
    assert "Computes only on events" in _text(site, "components/e")


def test_index_page_draws_matching_ports(tmp_path: Path) -> None:
    ports = {"a": "requires Laser;", "b": "implements Laser; requires Laser as other;", "c": ""}
    _write(
        tmp_path,
        {
            f"{name}.cdsl": COMPONENT.format(file="Laser.idsl", name=name, ports=text)
            for name, text in ports.items()
        },
    )
    site = pages(*(tmp_path / f"{name}.cdsl" for name in ports))
    assert check_links(site)
    index = site["index.html"]
    assert index.count('class="line call"') == 3  # a to b, b to itself, and the legend
    assert '<a href="components/c.html">' in index


def test_markdown_page_joins_adjacent_code_spans(tmp_path: Path) -> None:
    _write(tmp_path, {"e.cdsl": "/** So `a``b` is. */ Component e { language Python; };"})
    assert "So `ab` is." in pages(tmp_path / "e.cdsl")["components/e.md"]
