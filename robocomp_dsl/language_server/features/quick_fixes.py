"""Code actions: quick fixes of findings.

In: a range of a file. Out: an action for every fix of a finding there, an action for all fixes of
the file, and `source.fixAll`, which does what `rcgen check --fix` does.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

from lsprotocol import types as lsp

from robocomp_dsl.check.workspace.source_cache import canonical_path
from robocomp_dsl.diagnostics import Diagnostic, Edit, Fix
from robocomp_dsl.language_server.diagnostics import diagnostic
from robocomp_dsl.language_server.features.fix_all import changed_region, fixed_text
from robocomp_dsl.language_server.features.fixes_for import fixes_for
from robocomp_dsl.language_server.session import Session

FIX_ALL = "source.fixAll.rcgen"
KINDS = (lsp.CodeActionKind.QuickFix, FIX_ALL)


def code_actions(session: Session, params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
    """The actions for a range. Raises `UnsupportedDocument` and `InvalidPosition`."""
    uri = params.text_document.uri
    requested = session.positions.span_of(session.source(uri), params.range)
    path = session.path_of(uri)
    file = canonical_path(path)
    own = [f for f in session.checked(path).findings if canonical_path(f.span.source.path) == file]
    actions: list[lsp.CodeAction] = []
    if _is_requested(params.context.only, lsp.CodeActionKind.QuickFix):
        near = (d for d in own if d.span.start <= requested.end and requested.start <= d.span.end)
        fixes = [
            (finding, fix)
            for finding in near
            for fix in fixes_for(session, path, finding)
            if all(canonical_path(edit.span.source.path) == file for edit in fix.edits)
        ]
        counts = Counter(id(finding) for finding, _ in fixes)
        actions += [
            _quick_fix_action(session, uri, finding, fix, counts[id(finding)] == 1)
            for finding, fix in fixes
        ]
        actions += _fix_file_action(session, uri, fixes, own)
    if _is_requested(params.context.only, FIX_ALL):
        actions += _fix_all_action(session, path, uri)
    return actions


def _fix_file_action(
    session: Session,
    uri: str,
    near: Sequence[tuple[Diagnostic, Fix]],
    own: Sequence[Diagnostic],
) -> list[lsp.CodeAction]:
    """One action for all fixes of the file, also unsafe ones, if there are several."""
    fixes = [finding.fix for finding in own if finding.fix]
    if not near or len(fixes) < 2:
        return []
    edits = without_overlaps(fix.edits for fix in fixes)
    title = f"Apply all {len(fixes)} fixes in this file"
    kind = lsp.CodeActionKind.QuickFix
    return [lsp.CodeAction(title, kind=kind, edit=_workspace_edit(session, uri, edits))]


def _fix_all_action(session: Session, path: Path, uri: str) -> list[lsp.CodeAction]:
    """The safe fixes of `rcgen check --fix`; editors may apply them on every save."""
    source = session.files.read(path)
    new = fixed_text(session, path)
    if new == source.text:
        return []
    start, end, text = changed_region(source, new)
    edit = Edit(source.span(start, end), text)
    title = "Update legacy syntax"
    return [lsp.CodeAction(title, kind=FIX_ALL, edit=_workspace_edit(session, uri, [edit]))]


def without_overlaps(fixes: Iterable[Sequence[Edit]]) -> list[Edit]:
    """The edits of all fixes, except fixes that overlap an earlier one."""
    accepted: list[Edit] = []
    for edits in fixes:
        if not any(_overlap(edit, other) for edit in edits for other in accepted):
            accepted.extend(edits)
    return accepted


def _overlap(edit: Edit, other: Edit) -> bool:
    if edit.span.start == other.span.start and edit.text == other.text:
        return True
    return edit.span.start < other.span.end and other.span.start < edit.span.end


def _quick_fix_action(
    session: Session, uri: str, finding: Diagnostic, fix: Fix, preferred: bool
) -> lsp.CodeAction:
    return lsp.CodeAction(
        fix.title[:1].upper() + fix.title[1:],
        kind=lsp.CodeActionKind.QuickFix,
        diagnostics=[diagnostic(session, finding)],
        edit=_workspace_edit(session, uri, fix.edits),
        is_preferred=preferred,
    )


def _workspace_edit(session: Session, uri: str, edits: Iterable[Edit]) -> lsp.WorkspaceEdit:
    changes = [lsp.TextEdit(session.positions.range_of(edit.span), edit.text) for edit in edits]
    return lsp.WorkspaceEdit(changes={uri: changes})


def _is_requested(only: Sequence[lsp.CodeActionKind | str] | None, kind: str) -> bool:
    """Whether the client requests that kind of action, or a kind that includes it."""
    if only is None:
        return kind != FIX_ALL
    return any(kind == requested or kind.startswith(f"{requested}.") for requested in only)
