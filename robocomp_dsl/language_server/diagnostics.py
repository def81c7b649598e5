"""Diagnostics: the findings of a file as an editor shows them.

In: the check result of a file. Out: one list of diagnostics for that file. Errors in other files
are reported at the import or the statement that leads to them, once for each of these files.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from lsprotocol import types as lsp

from robocomp_dsl.check.workspace.source_cache import canonical_path
from robocomp_dsl.diagnostics import Diagnostic, Severity
from robocomp_dsl.language_server.session import CheckResult, Session
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast.base import Import

SOURCE = "rcgen"
MAX_DIAGNOSTICS = 1000
"""Findings shown per file; editors become slow with more."""
_SEVERITIES = {
    Severity.ERROR: lsp.DiagnosticSeverity.Error,
    Severity.WARNING: lsp.DiagnosticSeverity.Warning,
    Severity.NOTE: lsp.DiagnosticSeverity.Information,
}


def diagnostics_of(session: Session, checked: CheckResult) -> list[lsp.Diagnostic]:
    """The diagnostics to show in the checked file."""
    own: list[lsp.Diagnostic] = []
    imported: dict[str, list[Diagnostic]] = {}
    checked_file = canonical_path(checked.source.path)
    for finding in checked.findings:
        source = finding.span.source
        is_own = source is checked.source or canonical_path(source.path) == checked_file
        if is_own:
            own.append(diagnostic(session, finding))
        elif finding.severity is Severity.ERROR:
            imported.setdefault(canonical_path(source.path), []).append(finding)
    imports = _imports(session, checked.source)
    own.extend(
        _import_diagnostic(session, errors, checked.source, imports) for errors in imported.values()
    )
    return own if len(own) <= MAX_DIAGNOSTICS else _truncate(own)


def _truncate(diagnostics: list[lsp.Diagnostic]) -> list[lsp.Diagnostic]:
    """The most severe diagnostics, and a last diagnostic with the number of the others."""
    shown = sorted(diagnostics, key=lambda item: item.severity or 0)[:MAX_DIAGNOSTICS]
    message = f"{len(diagnostics) - MAX_DIAGNOSTICS} more findings in this file are not shown"
    start = lsp.Range(lsp.Position(0, 0), lsp.Position(0, 0))
    shown.append(lsp.Diagnostic(start, message, lsp.DiagnosticSeverity.Information, source=SOURCE))
    return shown


def diagnostic(session: Session, finding: Diagnostic) -> lsp.Diagnostic:
    """The finding in the protocol's form."""
    parts = [finding.message, finding.label, finding.help and f"help: {finding.help}"]
    return lsp.Diagnostic(
        range=session.positions.range_of(finding.span),
        message="\n".join(part for part in parts if part),
        severity=_SEVERITIES[finding.severity],
        code=finding.code.id,
        source=SOURCE,
        related_information=[_related(session, n.span, n.message) for n in finding.notes] or None,
    )


def _related(session: Session, span: Span, message: str) -> lsp.DiagnosticRelatedInformation:
    location = lsp.Location(session.uri_of(span.source.path), session.positions.range_of(span))
    return lsp.DiagnosticRelatedInformation(location, message)


def _imports(session: Session, source: Source) -> Sequence[Import]:
    tree = session.parsed(source.path).tree
    imports: Iterable[Import] = getattr(tree, "imports", ())
    return list(imports)


def _import_diagnostic(
    session: Session, errors: Sequence[Diagnostic], source: Source, imports: Sequence[Import]
) -> lsp.Diagnostic:
    """The errors of another file as one diagnostic: at the import, or at what refers to it."""
    path = errors[0].span.source.path
    names = {path.name, path.stem}
    spans = [item.path.span for item in imports if Path(item.path.value).name in names]
    own = canonical_path(source.path)
    notes = (note.span for error in errors for note in error.notes)
    spans += [span for span in notes if canonical_path(span.source.path) == own]
    more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
    return lsp.Diagnostic(
        range=session.positions.range_of(spans[0] if spans else source.file_span),
        message=f"`{path.name}` has errors: {errors[0].message}{more}",
        severity=lsp.DiagnosticSeverity.Error,
        code=errors[0].code.id,
        source=SOURCE,
        related_information=[_related(session, error.span, error.message) for error in errors],
    )
