"""Quick fixes of bridges: each removes its finding and adds no syntax error."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_bdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Diagnostic, Edit, Report
from tests.check.other_middlewares import BRIDGED_MIDDLEWARES

CASES = Path(__file__).parent.parent / "cases"
FILES = sorted(CASES.glob("bdsl/sem_*.bdsl"))


def _findings(path: Path, text: str) -> list[Diagnostic]:
    workspace = Workspace(environ={}, shipped=CASES / "interfaces", middlewares=BRIDGED_MIDDLEWARES)
    workspace.sources.set_overlay(path, text)
    report = Report()
    check_bdsl(path, workspace, report)
    return list(report)


def _applied(text: str, edits: tuple[Edit, ...]) -> str:
    for edit in sorted(edits, key=lambda edit: edit.span.start, reverse=True):
        text = text[: edit.span.start] + edit.text + text[edit.span.end :]
    return text


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_fixes_of_bridge_remove_their_findings(path: Path) -> None:
    text = path.read_text("utf-8")
    before = _findings(path, text)
    for diagnostic in before:
        if diagnostic.fix is None:
            continue
        after = _findings(path, _applied(text, diagnostic.fix.edits))
        shown = f"{diagnostic.span.start_position[0]}: {diagnostic.message}: {diagnostic.fix.title}"
        own = (diagnostic.code.id, diagnostic.message)
        assert [(d.code.id, d.message) for d in after].count(own) < [
            (d.code.id, d.message) for d in before
        ].count(own), shown
        syntax = [d.message for d in after if d.code.id.startswith("RC1")]
        known = [d.message for d in before if d.code.id.startswith("RC1")]
        assert len(syntax) <= len(known), (shown, syntax)
