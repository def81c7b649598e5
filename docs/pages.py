"""The pages of the site that are files of the repository.

In: nothing. Out: the path of each page in the repository → its path in the site.
"""

from __future__ import annotations

from pathlib import Path

from docs.links import Staged

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
EXTRA = {
    "ARCHITECTURE.md": "explanation/architecture.md",
    "CONTRIBUTING.md": "project/contributing.md",
    "SECURITY.md": "project/security.md",
    "CHANGELOG.md": "project/changelog.md",
    "editors/README.md": "how-to/editors.md",
}
"""Markdown files outside `docs/` that are pages, and where they are in the site."""


def staged_pages() -> Staged:
    """Every Markdown file and image of the site: its path in the repository → its page."""
    pages = {
        str(path.relative_to(ROOT)): str(path.relative_to(DOCS))
        for suffix in ("*.md", "*.png")
        for path in sorted(DOCS.rglob(suffix))
    }
    for readme in sorted(ROOT.glob("components/*/README.md")):
        pages[str(readme.relative_to(ROOT))] = f"reference/components/{readme.parent.name}.md"
    return pages | EXTRA
