"""Completion of XML, common to all XML languages: tags, closing tags, attributes and values.

In: the context, and the language's candidates for each kind of position. Out: candidates.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from lsprotocol import types as lsp

from robocomp_dsl.language_server.completion.candidates import CompletionCandidate
from robocomp_dsl.language_server.completion.xml_context import PositionKind, XmlContext


def candidates(
    context: XmlContext,
    tags: Callable[[str], Iterable[CompletionCandidate]],
    attributes: Callable[[], Iterable[CompletionCandidate]],
    values: Callable[[], Iterable[CompletionCandidate]],
) -> Iterator[CompletionCandidate]:
    """All candidates for the position; `tags` takes the text to insert before a name."""
    match context.position_kind:
        case PositionKind.CONTENT:
            yield from tags("<")
            yield from closing_tag(context, "</")
        case PositionKind.TAG:
            yield from tags("")
            yield from closing_tag(context, "/")
        case PositionKind.CLOSING:
            yield from closing_tag(context, "")
        case PositionKind.ATTRIBUTE:
            yield from attributes()
        case PositionKind.VALUE:
            yield from values()


def closing_tag(context: XmlContext, before: str) -> Iterator[CompletionCandidate]:
    """The closing tag of the innermost open element."""
    if context.open_tags:
        end = "" if context.source.text[context.offset : context.offset + 1] == ">" else ">"
        label = f"{before}{context.open_tags[-1]}{end}"
        yield CompletionCandidate(label, lsp.CompletionItemKind.Class, "closing tag")
