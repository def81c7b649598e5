"""The cache of compiled templates is optional."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from robocomp_dsl.generate import templates

NAME = "new/component.pdsl.jinja"


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache folder, and no compiled templates in memory."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    templates._environment.cache_clear()
    return tmp_path / "robocomp_dsl" / "templates"


def rendered() -> str:
    templates._environment.cache_clear()
    return templates.render(NAME, name="arm")


def test_template_cache_is_reused(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = rendered()
    (cached,) = cache.iterdir()
    monkeypatch.setattr("jinja2.Environment.compile", None)  # compilation fails
    assert rendered() == text
    assert list(cache.iterdir()) == [cached]


@pytest.mark.parametrize("damage", [b"", b"garbage", b"j2\x05\x00" * 100])
def test_template_cache_replaces_damaged_file(cache: Path, damage: bytes) -> None:
    text = rendered()
    (cached,) = cache.iterdir()
    cached.write_bytes(damage)
    assert rendered() == text
    assert cached.read_bytes() != damage


def test_template_cache_without_folder_is_skipped(cache: Path) -> None:
    cache.parent.parent.joinpath("robocomp_dsl").write_text("in the way")
    assert "arm" in rendered()


def test_template_cache_without_home_is_skipped(
    monkeypatch: pytest.MonkeyPatch, cache: Path
) -> None:
    def no_home() -> Path:
        raise RuntimeError

    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setattr(Path, "home", no_home)
    assert "arm" in rendered()


def test_template_cache_respects_dont_write_bytecode(
    cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    rendered()
    assert not cache.exists()
