"""Call hierarchy of components, instances and interfaces.

In: the name of one of them. Out: its clients (incoming calls) or its servers (outgoing calls), with
the spans of the ports or connections. An item identifies its declaration by file and name, so that
it stays valid after an edit.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from lsprotocol import types as lsp

from robocomp_dsl.check.workspace.source_cache import canonical_path
from robocomp_dsl.language_server.session import Session, UnsupportedDocument
from robocomp_dsl.language_server.symbols.dependencies import (
    Dependency,
    Participant,
    component_dependencies,
    instance_dependencies,
    interface_dependencies,
    known_components,
)
from robocomp_dsl.language_server.symbols.lookup import occurrences_at
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.deployment import Deployment, External, Instance
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.source import Span, UnreadableSource

KINDS: dict[type, lsp.SymbolKind] = {
    Component: lsp.SymbolKind.Class,
    Instance: lsp.SymbolKind.Object,
    External: lsp.SymbolKind.Object,
    Interface: lsp.SymbolKind.Interface,
}


def prepare(
    session: Session, params: lsp.CallHierarchyPrepareParams
) -> list[lsp.CallHierarchyItem] | None:
    """The component, instance or interface at the position; None if there is none."""
    occurrences = occurrences_at(session, params.text_document, params.position)
    objects = [occurrence.symbol.model_object for occurrence in occurrences]
    participants = [o for o in objects if isinstance(o, Component | Instance | Interface)]
    # For an instance with the name of its component, the instance is more specific.
    participants.sort(key=lambda participant: not isinstance(participant, Instance))
    return [_item(session, participants[0])] if participants else None


def incoming(
    session: Session, params: lsp.CallHierarchyIncomingCallsParams
) -> list[lsp.CallHierarchyIncomingCall]:
    """The clients of its implemented interfaces and the subscribers of its topics."""
    key = _key(session, params.item)
    dependencies = _dependencies(session, params.item)
    own = (d for d in dependencies if _participant_key(d.server) == key)
    grouped = _grouped(own, lambda dependency: (dependency.client, dependency.client_span))
    return [
        lsp.CallHierarchyIncomingCall(_item(session, client), _ranges(session, spans))
        for client, spans in grouped
    ]


def outgoing(
    session: Session, params: lsp.CallHierarchyOutgoingCallsParams
) -> list[lsp.CallHierarchyOutgoingCall]:
    """The servers of its required interfaces and the publishers of its subscribed topics."""
    key = _key(session, params.item)
    dependencies = _dependencies(session, params.item)
    own = (d for d in dependencies if _participant_key(d.client) == key)
    grouped = _grouped(own, lambda dependency: (dependency.server, dependency.client_span))
    return [
        lsp.CallHierarchyOutgoingCall(_item(session, server), _ranges(session, spans))
        for server, spans in grouped
    ]


def _ranges(session: Session, spans: Iterable[Span]) -> list[lsp.Range]:
    return [session.positions.range_of(span) for span in spans]


def _dependencies(session: Session, item: lsp.CallHierarchyItem) -> list[Dependency]:
    """All dependencies in the item's deployment, or among all known components."""
    path = session.path_of(item.uri)
    model = _model(session, item)
    if isinstance(model, Deployment):
        return instance_dependencies(model)
    if path.suffix.lower() != ".idsl":
        return component_dependencies(known_components(session))
    modules = model if isinstance(model, tuple) else ()
    declared = (declaration for module in modules for declaration in module.declarations)
    matches = (d for d in declared if isinstance(d, Interface) and d.name == item.name)
    interface = next(matches, None)
    return interface_dependencies(interface, known_components(session)) if interface else []


def _model(session: Session, item: lsp.CallHierarchyItem) -> object:
    try:
        return session.checked(session.path_of(item.uri)).model
    except UnreadableSource as error:
        raise UnsupportedDocument(f"cannot read `{item.uri}`: {error}") from None


def _key(session: Session, item: lsp.CallHierarchyItem) -> tuple[str, str]:
    return canonical_path(session.path_of(item.uri)), item.name


def _participant_key(participant: Participant) -> tuple[str, str]:
    return canonical_path(participant.span.source.path), participant.name


def _grouped(
    dependencies: Iterable[Dependency], other: Callable[[Dependency], tuple[Participant, Span]]
) -> Iterator[tuple[Participant, list[Span]]]:
    """The participants at the other end, each with its spans, without duplicates."""
    groups: dict[tuple[str, str], tuple[Participant, dict[int, Span]]] = {}
    for dependency in dependencies:
        participant, span = other(dependency)
        _, spans = groups.setdefault(_participant_key(participant), (participant, {}))
        spans.setdefault(span.start, span)
    return ((participant, list(spans.values())) for participant, spans in groups.values())


def _item(session: Session, participant: Participant) -> lsp.CallHierarchyItem:
    extent = session.positions.range_of(participant.span)
    uri = session.uri_of(participant.span.source.path)
    kind = KINDS[type(participant)]
    item = lsp.CallHierarchyItem(participant.name, kind, uri, extent, extent)
    match participant:
        case External():
            item.detail = f"over {participant.middleware}"
        case Instance():
            item.detail = f": {participant.component.name}"
        case Interface():
            item.detail = participant.qualified
        case Component():
            ports = participant.ports[:4]
            item.detail = ", ".join(f"{port.role} {port.interface.name}" for port in ports)
    return item
