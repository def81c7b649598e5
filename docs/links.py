"""Links of Markdown files, moved to another folder.

In: the text of a file, its path in the repository, the map of all pages. Out: the text with links
that are right in the site. A link to a file that is no page becomes the path of the file.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Mapping
from typing import TypeAlias

Staged: TypeAlias = Mapping[str, str]
"""Path in the repository → path in the site."""

LINK = re.compile(r"(?P<bang>!?)\[(?P<text>[^\]]*)\]\((?P<target>[^)\s]+)\)")
GENERATED = tuple(
    f"docs/reference/{folder}/" for folder in ("cli", "findings", "grammars", "interfaces")
)
"""Folders of pages that exist only in the site."""
_ABSOLUTE = re.compile(r"[a-z][a-z0-9+.-]*:|#")


def relink(text: str, origin: str, pages: Staged) -> str:
    """`text` of the file `origin` with its relative links pointing into the site."""
    fenced = re.split(r"(^```.*?^```$)", text, flags=re.MULTILINE | re.DOTALL)
    return "".join(
        part if part.startswith("```") else LINK.sub(lambda m: _link(m, origin, pages), part)
        for part in fenced
    )


def _link(match: re.Match[str], origin: str, pages: Staged) -> str:
    target = match["target"]
    if _ABSOLUTE.match(target):
        return match[0]
    path, hash_sign, anchor = target.partition("#")
    resolved = posixpath.normpath(posixpath.join(posixpath.dirname(origin), path))
    if resolved.startswith(GENERATED):
        return match[0]
    if f"{resolved}/README.md" in pages:
        resolved = posixpath.join(resolved, "README.md")
    if resolved not in pages:
        return f"{match['text']} (`{resolved}`)" if match["text"] != resolved else f"`{resolved}`"
    relative = posixpath.relpath(pages[resolved], posixpath.dirname(pages[origin]))
    return f"{match['bang']}[{match['text']}]({relative}{hash_sign}{anchor})"
