"""Builds the documentation site: `python -m docs.build_site [FOLDER]`.

In: the Markdown files of the project, its grammars, interfaces, commands and finding codes. Out: a
folder with HTML pages that need no network. A warning of Sphinx is an error.

The pages are staged in a temporary folder first: links between Markdown files are written for
readers of the repository, and the generated reference pages are never part of the source tree.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
from pathlib import Path

from sphinx.cmd.build import main as sphinx_build

from docs.generators import cli, findings, grammar, interfaces
from docs.links import relink
from docs.pages import DOCS, ROOT, staged_pages

OUTPUT = ROOT / "build" / "docs"


def stage(folder: Path) -> None:
    """Copy all pages to `folder`, with links that are right there, and add the generated ones."""
    pages = staged_pages()
    for origin, page in pages.items():
        target = folder / page
        target.parent.mkdir(parents=True, exist_ok=True)
        if target.suffix == ".md":
            text = (ROOT / origin).read_text(encoding="utf-8")
            target.write_text(relink(text, origin, pages), encoding="utf-8")
        else:
            shutil.copyfile(ROOT / origin, target)
    reference = folder / "reference"
    cli.write(reference / "cli")
    findings.write(reference / "findings")
    grammar.write(ROOT / "grammars", reference / "grammars")
    interfaces.write(ROOT / "interfaces", reference / "interfaces")


def build(output: Path) -> int:
    """Build the site into `output`; the exit code of Sphinx."""
    with tempfile.TemporaryDirectory(prefix="rc-docs-") as work:
        source = Path(work, "source")
        stage(source)
        options = ["-b", "html", "-W", "--keep-going", "-q", "-c", str(DOCS)]
        return sphinx_build([*options, "-d", f"{work}/doctrees", str(source), str(output)])


def main() -> int:
    """Entry point; returns the exit code."""
    parser = argparse.ArgumentParser(description="Build the documentation site.")
    parser.add_argument("output", nargs="?", type=Path, default=OUTPUT, help="folder for the HTML")
    output: Path = parser.parse_args().output
    code = build(output)
    if code == 0:
        print(f"{output / 'index.html'}: open it in a browser")
    return code


if __name__ == "__main__":
    sys.exit(main())
