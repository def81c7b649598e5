"""The result of `rcgen check --fix` for a document.

In: a file, open or not. Out: its text with all automatic fixes. The fixes are applied in a separate
workspace with the same buffers, so the session does not change.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.fixes import fix_all
from robocomp_dsl.check.languages import check_file
from robocomp_dsl.check.workspace.source_cache import SourceCache
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.source import Source


def fixed_text(session: Session, path: Path) -> str:
    """The text with all safe fixes applied. Raises `UnreadableSource`."""
    files = SourceCache()
    for document in session.documents.values():
        files.set_overlay(document.path, session.files.read(document.path).text)
    workspace = Workspace((), session.environ, files=files)

    def check(text: str) -> tuple[Source, list[Diagnostic]]:
        source = files.set_overlay(path, text)
        report = Report()
        check_file(path, workspace, report)
        return source, report.sorted()

    return fix_all(session.files.read(path), check).text


def changed_region(source: Source, new: str) -> tuple[int, int, str]:
    """The start and end offsets of the changed part of `source`, and its replacement."""
    old = source.text
    limit = min(len(old), len(new))
    start = next((i for i in range(limit) if old[i] != new[i]), limit)
    limit -= start
    end = next((i for i in range(limit) if old[-1 - i] != new[-1 - i]), limit)
    return start, len(old) - end, new[start : len(new) - end]
