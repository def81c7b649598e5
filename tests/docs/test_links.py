"""Links between Markdown files lead to files, headings and images that exist."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from docs.links import GENERATED, LINK
from docs.pages import staged_pages
from tests.docs.blocks import ROOT

SOURCES = sorted(
    {
        path
        for pattern in ("*.md", "docs/**/*.md", "components/*/*.md", "editors/**/*.md")
        for path in ROOT.glob(pattern)
        if "node_modules" not in path.parts
    }
)


def _text(path: Path) -> str:
    """The text without fenced blocks, in which nothing is a link."""
    return re.sub(
        r"^```.*?^```$", "", path.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL
    )


def _anchors(path: Path) -> set[str]:
    headings = re.findall(r"^#+ (.+)$", _text(path), re.MULTILINE)
    return {_slug(heading) for heading in headings}


def _slug(heading: str) -> str:
    """As GitHub and MyST make anchors of headings."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(ROOT)))
def test_links_of_markdown_file_resolve(path: Path) -> None:
    broken = [match["target"] for match in LINK.finditer(_text(path)) if _is_broken(path, match)]
    assert broken == []


def _is_broken(path: Path, match: re.Match[str]) -> bool:
    target = match["target"]
    if re.match(r"[a-z]+:", target):
        return target.startswith("http:")  # no address without encryption
    file, _, anchor = target.partition("#")
    found = (path if not file else path.parent / file).resolve()
    if str(found.relative_to(ROOT)).startswith(GENERATED):
        return False  # written when the site is built; Sphinx checks these links
    if not found.exists():
        return True
    return bool(anchor) and found.suffix == ".md" and anchor not in _anchors(found)


def test_docs_pages_are_all_in_the_site() -> None:
    pages = staged_pages()
    assert {str(path.relative_to(ROOT)) for path in (ROOT / "docs").rglob("*.md")} <= set(pages)
    assert len(set(pages.values())) == len(pages)
