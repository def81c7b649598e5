"""Completion of SCXML files: elements, attributes and states."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types as lsp

from robocomp_dsl.check.states.scxml_syntax import local_name
from robocomp_dsl.check.states.scxml_tags import STATES, TAGS
from robocomp_dsl.language_server.completion import complete_xml
from robocomp_dsl.language_server.completion.candidates import CompletionCandidate
from robocomp_dsl.language_server.completion.xml_context import XmlContext
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.symbols_innermodel import elements
from robocomp_dsl.language_server.symbols.symbols_scxml import STATE_ATTRIBUTES, listed_words
from robocomp_dsl.syntax.ast.innermodel import File

_ROOT = "scxml"


def candidates(session: Session, context: XmlContext) -> Iterator[CompletionCandidate]:
    """All candidates for the position."""
    return complete_xml.candidates(
        context,
        lambda before: _tags(context, before),
        lambda: _attributes(context),
        lambda: _values(session, context),
    )


def _attributes(context: XmlContext) -> Iterator[CompletionCandidate]:
    known = TAGS.get(context.tag)
    for name in known.attributes if known else ():
        if name not in context.existing_attributes:
            yield CompletionCandidate(name, lsp.CompletionItemKind.Property)


def _values(session: Session, context: XmlContext) -> Iterator[CompletionCandidate]:
    if context.attribute in STATE_ATTRIBUTES.get(context.tag, ()):
        yield from _states(session, context)


def _tags(context: XmlContext, before: str) -> Iterator[CompletionCandidate]:
    parent = TAGS.get(context.open_tags[-1]) if context.open_tags else None
    names = parent.holds if parent else () if context.open_tags else (_ROOT,)
    for name in names:
        yield CompletionCandidate(before + name, lsp.CompletionItemKind.Class, TAGS[name].unused)


def _states(session: Session, context: XmlContext) -> Iterator[CompletionCandidate]:
    """The states of the file, appended to those that the attribute already lists."""
    written = context.source.text[context.start : context.offset]
    listed = written[: len(written) - len(written.split(" ")[-1])]
    for checked in session.checks_for_completion(context.path):
        root = checked.tree.root if isinstance(checked.tree, File) else None
        for element in elements(root):
            if local_name(element) in STATES:
                for _, name in listed_words(element, "id"):
                    kind = lsp.CompletionItemKind.EnumMember
                    yield CompletionCandidate(listed + name, kind, local_name(element))
