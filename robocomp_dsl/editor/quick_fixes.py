"""Quick fixes: the ways out that the checks know, as edits.

In: a range of a file. Out: one action for every finding there that has a fix, and one that mends
the whole file.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from lsprotocol import types as lsp

from robocomp_dsl.check.files import identity
from robocomp_dsl.diagnostics import Diagnostic, Edit
from robocomp_dsl.editor.diagnostics import diagnostic
from robocomp_dsl.editor.positions import range_of, span_of
from robocomp_dsl.editor.session import Session

FIX_ALL = "source.fixAll.rcgen"
KINDS = (lsp.CodeActionKind.QuickFix, FIX_ALL)


def code_actions(session: Session, params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
    """What can be mended in the range. Raises `NoDescription` and `WrongPosition`."""
    uri = params.text_document.uri
    asked = span_of(session.source(uri), params.range)
    path = session.path_of(uri)
    here = identity(path)
    own = [
        one
        for one in session.checked(path).findings
        if one.fix and all(identity(e.span.source.path) == here for e in one.fix.edits)
    ]
    actions: list[lsp.CodeAction] = []
    if _wanted(params.context.only, lsp.CodeActionKind.QuickFix):
        near = (d for d in own if d.span.start <= asked.end and asked.start <= d.span.end)
        actions += [
            _mend(session, uri, one) for one in near if identity(one.span.source.path) == here
        ]
    if own and _wanted(params.context.only, FIX_ALL):
        edits = without_overlaps(one.fix.edits for one in own if one.fix)
        title = "Mend everything that can be mended"
        actions.append(lsp.CodeAction(title, kind=FIX_ALL, edit=_workspace_edit(uri, edits)))
    return actions


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


def _mend(session: Session, uri: str, finding: Diagnostic) -> lsp.CodeAction:
    fix = finding.fix
    title = fix.title if fix else ""
    return lsp.CodeAction(
        title[:1].upper() + title[1:],
        kind=lsp.CodeActionKind.QuickFix,
        diagnostics=[diagnostic(session, finding)],
        edit=_workspace_edit(uri, fix.edits if fix else ()),
        is_preferred=True,
    )


def _workspace_edit(uri: str, edits: Iterable[Edit]) -> lsp.WorkspaceEdit:
    made = [lsp.TextEdit(range_of(one.span), one.text) for one in edits]
    return lsp.WorkspaceEdit(changes={uri: made})


def _wanted(only: Sequence[lsp.CodeActionKind | str] | None, kind: str) -> bool:
    """Whether the client asked for that kind, or for one that it is a part of."""
    if only is None:
        return kind != FIX_ALL
    return any(kind == one or kind.startswith(f"{one}.") for one in only)
