"""Completion: keywords and names that are valid at a position.

In: a position, usually in an incomplete file. Out: items. Keywords come from the parse tables.
Names come from the file and its imports, now and at the last check without syntax errors.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from lsprotocol import types as lsp

from robocomp_dsl.check.idsl.units import KNOWN
from robocomp_dsl.language_server.completion import (
    complete_bdsl,
    complete_cdsl,
    complete_ddsl,
    complete_idsl,
    complete_innermodel,
    complete_paths,
    complete_pdsl,
    complete_scxml,
    complete_smdsl,
)
from robocomp_dsl.language_server.completion.candidates import CompletionCandidate, value_candidates
from robocomp_dsl.language_server.completion.context import CompletionContext, context_at
from robocomp_dsl.language_server.completion.xml_context import XmlContext, xml_context_at
from robocomp_dsl.language_server.features.hover import symbol_markdown
from robocomp_dsl.language_server.positions import PositionCodec
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.lookup import resolve_position

TRIGGERS = ['"', ":", ".", "[", "<", "/"]

_HIDDEN_KEYWORDS = frozenset(
    (
        "EXTENDS",
        "NO_GUI",
        "USEQT",
        "QTVERSION",
        "WORKER",
        "ROBOCOMPCLASSES",
        "ROBOCOMPMODULES",
        "OLD_TRANSITIONS",
    )
)
"""Keywords that the parser accepts only for legacy files and for error messages."""
_PORT_KEYWORDS = frozenset(("IMPLEMENTS", "REQUIRES", "SUBSCRIBES", "PUBLISHES"))
_FIELD_WORDS = frozenset(
    (
        "RATE",
        "ITEM",
        "CALL",
        "RELIABLE",
        "BEST_EFFORT",
        "PRIORITY",
        "DEPTH",
        "KEEP",
        "LATCHED",
        "DEADLINE",
        "LIVELINESS",
    )
)
"""Keywords of BDSL that the parser accepts as names of fields in every block."""
_HIDDEN_IN_BLOCK = {
    "COMPONENT": _PORT_KEYWORDS,
    "MODULE": frozenset(("IDEMPOTENT", "OUT")),
    "STRUCT": frozenset(("SEQUENCE", "DICTIONARY")),
    "EXCEPTION": frozenset(("SEQUENCE", "DICTIONARY")),
    "INTERFACE": frozenset(("SEQUENCE", "DICTIONARY")),
    "OUTPUT": frozenset(("CALL",)),
    "SERVICE": _FIELD_WORDS - {"CALL"},
    "CALL": _FIELD_WORDS,
}
"""Keywords that the parser accepts in a block only to report that they belong elsewhere."""


PATTERNS = ("command", "query", "publish")

_PROVIDERS: dict[str, Callable[[Session, CompletionContext], Iterator[CompletionCandidate]]] = {
    "idsl": complete_idsl.candidates,
    "cdsl": complete_cdsl.candidates,
    "ddsl": complete_ddsl.candidates,
    "pdsl": complete_pdsl.candidates,
    "smdsl": complete_smdsl.candidates,
    "bdsl": complete_bdsl.candidates,
}

_XML_PROVIDERS: dict[str, Callable[[Session, XmlContext], Iterator[CompletionCandidate]]] = {
    ".scxml": complete_scxml.candidates,
    ".xml": complete_innermodel.candidates,
}


def completion(session: Session, params: lsp.CompletionParams) -> list[lsp.CompletionItem]:
    """The completion items for the position."""
    path, offset = resolve_position(session, params.text_document, params.position)
    source = session.source(params.text_document.uri)
    context: CompletionContext | XmlContext | None = None
    candidates: Iterator[CompletionCandidate] = iter(())
    if path.suffix.lower() in _XML_PROVIDERS:
        if context := xml_context_at(path, source, offset):
            candidates = _XML_PROVIDERS[path.suffix.lower()](session, context)
    elif path.suffix[1:].lower() in _PROVIDERS and (context := context_at(path, source, offset)):
        candidates = _candidates(session, context)
    if context is None:
        return []
    word_range = session.positions.range_of(source.span(context.start, offset))
    by_label: dict[str, CompletionCandidate] = {}
    for candidate in candidates:
        by_label.setdefault(candidate.label, candidate)
    return [
        _item(session.positions, word_range, candidate, number)
        for number, candidate in enumerate(by_label.values())
    ]


def _candidates(session: Session, context: CompletionContext) -> Iterator[CompletionCandidate]:
    """Names first, then keywords."""
    if context.in_string:
        yield from complete_paths.candidates(session, context)
    elif context.in_brackets:
        begins = context.block_kind == "INTERFACE" and not context.statement
        yield from value_candidates(*(PATTERNS if begins else sorted(KNOWN)))
    else:
        if context.accepted & {"ID", "BRACKETED"}:
            yield from _PROVIDERS[context.tables.language](session, context)
        yield from _keywords(context)


def _keywords(context: CompletionContext) -> Iterator[CompletionCandidate]:
    hidden = _HIDDEN_KEYWORDS | _HIDDEN_IN_BLOCK.get(context.block_kind, frozenset())
    if context.tables.language == "idsl" and not context.block and not context.statement:
        hidden |= context.tables.keyword_terminals - {"IMPORT", "MODULE"}
    if context.previous_kind in ("STAMP", "DOT"):
        hidden |= _FIELD_WORDS
    if context.previous_kind == "COMMA":  # the parser accepts a trailing comma, but needs none
        hidden |= {"ON", "AFTER"}
    for kind in sorted((context.accepted & context.tables.keyword_terminals) - hidden):
        yield CompletionCandidate(
            context.tables.terminal_texts[kind], lsp.CompletionItemKind.Keyword
        )


def _item(
    positions: PositionCodec, word_range: lsp.Range, candidate: CompletionCandidate, number: int
) -> lsp.CompletionItem:
    edits = candidate.additional_fix.edits if candidate.additional_fix else ()
    return lsp.CompletionItem(
        candidate.label,
        kind=candidate.kind,
        detail=candidate.detail or None,
        documentation=_documentation(candidate),
        sort_text=f"{number:05}",
        text_edit=lsp.TextEdit(word_range, candidate.label),
        additional_text_edits=[
            lsp.TextEdit(positions.range_of(edit.span), edit.text) for edit in edits
        ]
        or None,
    )


def _documentation(candidate: CompletionCandidate) -> lsp.MarkupContent | None:
    if candidate.symbol:
        return symbol_markdown(candidate.symbol)
    if candidate.documentation:
        return lsp.MarkupContent(lsp.MarkupKind.Markdown, candidate.documentation)
    return None
