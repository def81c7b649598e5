"""Hover: the signature and doc comment of a name; what a middleware can do.

In InnerModel also the documentation of tags and attributes, in bridges unit conversions.
"""

from __future__ import annotations

from pathlib import Path

from lsprotocol import types as lsp

from robocomp_dsl.language_server.completion import innermodel_reference
from robocomp_dsl.language_server.features.conversions import conversion_at
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.signatures.signatures import doc_of, signature
from robocomp_dsl.language_server.symbols.lookup import occurrences_at, resolve_position
from robocomp_dsl.language_server.symbols.middleware_names import (
    describe_middleware,
    middleware_names,
)
from robocomp_dsl.language_server.symbols.symbol import Symbol
from robocomp_dsl.language_server.symbols.symbols_innermodel import elements
from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast.innermodel import Element
from robocomp_dsl.syntax.ast.innermodel import File as XmlFile


def hover(session: Session, params: lsp.HoverParams) -> lsp.Hover | None:
    """The hover text at the position; None if there is no resolved name."""
    occurrences = occurrences_at(session, params.text_document, params.position)
    if occurrences:
        occurrence = occurrences[0]
        markup = symbol_markdown(occurrence.definition or occurrence.symbol)
        markup.value += _conversion_note(session, params)
        return lsp.Hover(markup, session.positions.range_of(occurrence.span))
    path, offset = resolve_position(session, params.text_document, params.position)
    tree = session.parsed(path).tree
    for name in middleware_names(tree):
        text = describe_middleware(name.text, session.workspace.middlewares)
        if _touches(name.span, offset) and text:
            markup = lsp.MarkupContent(lsp.MarkupKind.Markdown, text)
            return lsp.Hover(markup, session.positions.range_of(name.span))
    documented = _conversion(session, path, offset)
    if isinstance(tree, XmlFile):
        documented = _documentation_at(tree, offset)
    if documented is None:
        return None
    span, text = documented
    markup = lsp.MarkupContent(lsp.MarkupKind.Markdown, text)
    return lsp.Hover(markup, session.positions.range_of(span))


def _conversion_note(session: Session, params: lsp.HoverParams) -> str:
    """The unit conversion of the value at the position, as a paragraph."""
    path, offset = resolve_position(session, params.text_document, params.position)
    converted = _conversion(session, path, offset)
    return f"\n\n{converted[1]}" if converted else ""


def _conversion(session: Session, path: Path, offset: int) -> tuple[Span, str] | None:
    """The unit conversion at `offset` in a bridge."""
    if path.suffix.lower() != ".bdsl":
        return None
    model = session.checked(path).model
    return conversion_at(model, offset) if isinstance(model, Bridge) else None


def symbol_markdown(symbol: Symbol) -> lsp.MarkupContent:
    """The signature in the language of the declaring file, then the doc comment."""
    language = symbol.span.source.path.suffix[1:].lower()
    code = signature(symbol.model_object) or f"{symbol.kind} {symbol.name}"
    parts = [f"```{language}\n{code}\n```", doc_of(symbol.model_object)]
    return lsp.MarkupContent(lsp.MarkupKind.Markdown, "\n\n".join(part for part in parts if part))


def _documentation_at(tree: XmlFile, offset: int) -> tuple[Span, str] | None:
    """The span and documentation of the InnerModel tag or attribute at `offset`."""
    for element in elements(tree.root):
        if _touches(element.span, offset):
            documented = _element_documentation(element, offset)
            if documented and documented[1]:
                return documented
    return None


def _element_documentation(element: Element, offset: int) -> tuple[Span, str] | None:
    tag = element.tag
    if _touches(tag.span, offset):
        description = innermodel_reference.describe_tag(tag.text)
        return tag.span, f"```xml\n<{tag.text}>\n```\n\n{description}"
    for attribute in element.attributes:
        if _touches(attribute.span, offset):
            name = attribute.name.text
            return attribute.span, innermodel_reference.describe_attribute(tag.text, name)
    return None


def _touches(span: Span, offset: int) -> bool:
    return span.start <= offset <= span.end
