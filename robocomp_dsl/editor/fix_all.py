"""What `rcgen check --fix` would make of a text, asked by an editor.

In: a file, open or not. Out: its text with all automatic fixes. The session is not touched: the
rounds that this takes run in a workspace of their own, which has the same buffers.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check import check_file
from robocomp_dsl.check.files import Files
from robocomp_dsl.check.fixes import fix_all
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.editor.session import Session
from robocomp_dsl.source import Source


def fixed_text(session: Session, path: Path) -> str:
    """The text without what can be mended without asking. Raises `UnreadableSource`."""
    files = Files()
    for document in session.documents.values():
        files.open_buffer(document.path, session.files.read(document.path).text)
    workspace = Workspace((), session.environ, files=files)

    def judge(text: str) -> tuple[Source, list[Diagnostic]]:
        source = files.open_buffer(path, text)
        report = Report()
        check_file(path, workspace, report)
        return source, report.sorted()

    return fix_all(session.files.read(path), judge).text


def only_difference(source: Source, new: str) -> tuple[int, int, str]:
    """Where the two texts differ, from the first to the last character, and what stands there."""
    old = source.text
    most = min(len(old), len(new))
    start = next((at for at in range(most) if old[at] != new[at]), most)
    most -= start
    end = next((at for at in range(most) if old[-1 - at] != new[-1 - at]), most)
    return start, len(old) - end, new[start : len(new) - end]
