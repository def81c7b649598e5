"""Reference pages of the interface library, by `rcgen doc` itself.

In: the folder with IDSL files. Out: a page for each module and each interface. Anchors that
`rcgen doc` writes as HTML become targets of the site, so that links are checked.
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from pathlib import Path

_RCGEN = [sys.executable, "-m", "robocomp_dsl.cli.rcgen"]
_ANCHOR = re.compile(r'<a id="(?P<name>[^"]+)"></a>')
_LINK = re.compile(r"\]\((?P<path>[^)#\s]*\.md)?#(?P<name>[^)\s]+)\)")
_TRAIL = re.compile(r"\A<!--.*?-->\n\[.*\n")


_CONTENTS = """
```{toctree}
:hidden:
:glob:

interfaces/*
modules/*
```
"""


def write(library: Path, folder: Path) -> None:
    """Write the pages of all interfaces of `library` into `folder`."""
    with tempfile.TemporaryDirectory(prefix="rc-docs-") as work:
        files = [str(path) for path in sorted(library.glob("*.idsl"))]
        options = ["-o", work, "--format", "markdown", "--title", "Interface library", "-q"]
        subprocess.run([*_RCGEN, "doc", *files, *options], check=True)  # noqa: S603
        for page in sorted(Path(work).rglob("*.md")):
            target = folder / page.relative_to(work)
            target.parent.mkdir(parents=True, exist_ok=True)
            contents = _CONTENTS if target == folder / "index.md" else ""
            target.write_text(_adapted(page) + contents, encoding="utf-8")


def _adapted(page: Path) -> str:
    text = _TRAIL.sub("", page.read_text(encoding="utf-8"))
    text = _ANCHOR.sub(lambda m: f"({_label(page.stem, m['name'])})=", text)
    return _LINK.sub(lambda m: f"](#{_label(_stem(m['path'], page), m['name'])})", text)


def _stem(path: str | None, page: Path) -> str:
    return Path(path).stem if path else page.stem


def _label(page: str, name: str) -> str:
    return f"{page}-{name}".lower()
