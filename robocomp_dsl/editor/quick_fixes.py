"""Quick fixes: the ways out that the checks know, as edits.

In: a range of a file. Out: an action for every way out of a finding there, one that takes all of
the file, and `source.fixAll`, which does what `rcgen check --fix` does.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

from lsprotocol import types as lsp

from robocomp_dsl.check.files import identity
from robocomp_dsl.diagnostics import Diagnostic, Edit, Fix
from robocomp_dsl.editor.diagnostics import diagnostic
from robocomp_dsl.editor.fix_all import fixed_text, only_difference
from robocomp_dsl.editor.positions import range_of, span_of
from robocomp_dsl.editor.session import Session
from robocomp_dsl.editor.ways_out import ways_out

FIX_ALL = "source.fixAll.rcgen"
KINDS = (lsp.CodeActionKind.QuickFix, FIX_ALL)


def code_actions(session: Session, params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
    """What can be mended in the range. Raises `NoDescription` and `WrongPosition`."""
    uri = params.text_document.uri
    asked = span_of(session.source(uri), params.range)
    path = session.path_of(uri)
    here = identity(path)
    own = [one for one in session.checked(path).findings if identity(one.span.source.path) == here]
    actions: list[lsp.CodeAction] = []
    if _wanted(params.context.only, lsp.CodeActionKind.QuickFix):
        near = (d for d in own if d.span.start <= asked.end and asked.start <= d.span.end)
        found = [
            (one, fix)
            for one in near
            for fix in ways_out(session, path, one)
            if all(identity(edit.span.source.path) == here for edit in fix.edits)
        ]
        counts = Counter(id(one) for one, _ in found)
        actions += [_mend(session, uri, *each, counts[id(each[0])] == 1) for each in found]
        actions += _all_mended(uri, found, own)
    if _wanted(params.context.only, FIX_ALL):
        actions += _fixed(session, path, uri)
    return actions


def _all_mended(
    uri: str, near: Sequence[tuple[Diagnostic, Fix]], own: Sequence[Diagnostic]
) -> list[lsp.CodeAction]:
    """One action for all fixes of the file, guesses included, where it has several."""
    fixes = [one.fix for one in own if one.fix]
    if not near or len(fixes) < 2:
        return []
    edits = without_overlaps(one.edits for one in fixes)
    title = f"Take all {len(fixes)} fixes in this file"
    kind = lsp.CodeActionKind.QuickFix
    return [lsp.CodeAction(title, kind=kind, edit=_workspace_edit(uri, edits))]


def _fixed(session: Session, path: Path, uri: str) -> list[lsp.CodeAction]:
    """What `check --fix` does, which is safe enough to happen on every save."""
    source = session.files.read(path)
    new = fixed_text(session, path)
    if new == source.text:
        return []
    start, end, text = only_difference(source, new)
    edit = Edit(source.span(start, end), text)
    title = "Bring legacy forms up to date"
    return [lsp.CodeAction(title, kind=FIX_ALL, edit=_workspace_edit(uri, [edit]))]


def without_overlaps(fixes: Iterable[Sequence[Edit]]) -> list[Edit]:
    """The edits of all fixes but those of which an edit meets an earlier one."""
    kept: list[Edit] = []
    for edits in fixes:
        if not any(_meet(one, other) for one in edits for other in kept):
            kept.extend(edits)
    return kept


def _meet(one: Edit, other: Edit) -> bool:
    if one.span.start == other.span.start and one.text == other.text:
        return True
    return one.span.start < other.span.end and other.span.start < one.span.end


def _mend(
    session: Session, uri: str, finding: Diagnostic, fix: Fix, preferred: bool
) -> lsp.CodeAction:
    return lsp.CodeAction(
        fix.title[:1].upper() + fix.title[1:],
        kind=lsp.CodeActionKind.QuickFix,
        diagnostics=[diagnostic(session, finding)],
        edit=_workspace_edit(uri, fix.edits),
        is_preferred=preferred,
    )


def _workspace_edit(uri: str, edits: Iterable[Edit]) -> lsp.WorkspaceEdit:
    made = [lsp.TextEdit(range_of(one.span), one.text) for one in edits]
    return lsp.WorkspaceEdit(changes={uri: made})


def _wanted(only: Sequence[lsp.CodeActionKind | str] | None, kind: str) -> bool:
    """Whether the client asked for that kind, or for one that it is a part of."""
    if only is None:
        return kind != FIX_ALL
    return any(kind == one or kind.startswith(f"{one}.") for one in only)
