"""Diagnostics: the findings of a file as an editor shows them.

In: the check of a file. Out: one list for that file. What is wrong in other files is told at the
import that leads to them, once for each of them.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from lsprotocol import types as lsp

from robocomp_dsl.check.files import identity
from robocomp_dsl.diagnostics import Diagnostic, Severity
from robocomp_dsl.editor.positions import range_of
from robocomp_dsl.editor.session import Checked, Session
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast_base import Import

SOURCE = "rcgen"
MOST = 1000
"""Findings shown of one file: an editor chokes on more, and nobody reads them."""
_SEVERITIES = {
    Severity.ERROR: lsp.DiagnosticSeverity.Error,
    Severity.WARNING: lsp.DiagnosticSeverity.Warning,
    Severity.NOTE: lsp.DiagnosticSeverity.Information,
}


def diagnostics_of(session: Session, checked: Checked) -> list[lsp.Diagnostic]:
    """What to show in the file that was checked."""
    own: list[lsp.Diagnostic] = []
    elsewhere: dict[str, list[Diagnostic]] = {}
    here = identity(checked.source.path)
    for one in checked.findings:
        there = identity(one.span.source.path)
        if there == here:
            own.append(diagnostic(session, one))
        elif one.severity is Severity.ERROR:
            elsewhere.setdefault(there, []).append(one)
    imports = _imports(session, checked.source)
    own.extend(
        _behind_import(session, found, checked.source, imports) for found in elsewhere.values()
    )
    return own if len(own) <= MOST else _cut(own)


def _cut(found: list[lsp.Diagnostic]) -> list[lsp.Diagnostic]:
    """The first ones, errors before the others, and a word on the rest."""
    kept = sorted(found, key=lambda one: one.severity or 0)[:MOST]
    said = f"{len(found) - MOST} more findings in this file are not shown"
    start = lsp.Range(lsp.Position(0, 0), lsp.Position(0, 0))
    kept.append(lsp.Diagnostic(start, said, lsp.DiagnosticSeverity.Information, source=SOURCE))
    return kept


def diagnostic(session: Session, finding: Diagnostic) -> lsp.Diagnostic:
    """One finding."""
    said = [finding.message, finding.label, finding.help and f"help: {finding.help}"]
    return lsp.Diagnostic(
        range=range_of(finding.span),
        message="\n".join(one for one in said if one),
        severity=_SEVERITIES[finding.severity],
        code=finding.code.id,
        source=SOURCE,
        related_information=[_related(session, n.span, n.message) for n in finding.notes] or None,
    )


def _related(session: Session, span: Span, message: str) -> lsp.DiagnosticRelatedInformation:
    uri = session.uri_of(span.source.path)
    return lsp.DiagnosticRelatedInformation(lsp.Location(uri, range_of(span)), message)


def _imports(session: Session, source: Source) -> Sequence[Import]:
    tree = session.parsed(source.path).tree
    found: Iterable[Import] = getattr(tree, "imports", ())
    return list(found)


def _behind_import(
    session: Session, found: Sequence[Diagnostic], source: Source, imports: Sequence[Import]
) -> lsp.Diagnostic:
    path = found[0].span.source.path
    names = {path.name, path.stem}
    leads = (one.path.span for one in imports if Path(one.path.value).name in names)
    more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
    return lsp.Diagnostic(
        range=range_of(next(leads, source.whole)),
        message=f"`{path.name}` has errors: {found[0].message}{more}",
        severity=lsp.DiagnosticSeverity.Error,
        code=found[0].code.id,
        source=SOURCE,
        related_information=[_related(session, one.span, one.message) for one in found],
    )
