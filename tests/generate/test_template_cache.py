"""Compiled templates are kept where they can be, and never needed."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from robocomp_dsl.generate import templates

NAME = "new/component.pdsl.jinja"


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache folder, and templates that nobody compiled before."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    templates._environment.cache_clear()
    return tmp_path / "robocomp_dsl" / "templates"


def rendered() -> str:
    templates._environment.cache_clear()
    return templates.render(NAME, name="arm")


def test_kept_and_used(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = rendered()
    (cached,) = cache.iterdir()
    monkeypatch.setattr("jinja2.Environment.compile", None)  # nothing is compiled any more
    assert rendered() == text
    assert list(cache.iterdir()) == [cached]


@pytest.mark.parametrize("damage", [b"", b"garbage", b"j2\x05\x00" * 100])
def test_damaged(cache: Path, damage: bytes) -> None:
    text = rendered()
    (cached,) = cache.iterdir()
    cached.write_bytes(damage)
    assert rendered() == text
    assert cached.read_bytes() != damage


def test_no_place_for_it(cache: Path) -> None:
    cache.parent.parent.joinpath("robocomp_dsl").write_text("in the way")
    assert "arm" in rendered()


def test_no_home(monkeypatch: pytest.MonkeyPatch, cache: Path) -> None:
    def no_home() -> Path:
        raise RuntimeError

    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setattr(Path, "home", no_home)
    assert "arm" in rendered()


def test_python_was_told_to_write_none(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    rendered()
    assert not cache.exists()
