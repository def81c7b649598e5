"""Call hierarchy over components: who uses what I offer, and whose offers I use.

In: a name of a component, an instance or an interface. Out: its users (incoming) or those that it
uses (outgoing), with the ports or wires that say so. An item says by its file and name what it is,
so that it still means the same after an edit.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from lsprotocol import types as lsp

from robocomp_dsl.check.files import identity
from robocomp_dsl.editor.asked import mentions_at
from robocomp_dsl.editor.positions import range_of
from robocomp_dsl.editor.session import NoDescription, Session
from robocomp_dsl.editor.uses import (
    Party,
    Use,
    components,
    uses_of_components,
    uses_of_instances,
    uses_of_interface,
)
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.deployment import Deployment, Instance
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.source import Span, UnreadableSource

KINDS: dict[type, lsp.SymbolKind] = {
    Component: lsp.SymbolKind.Class,
    Instance: lsp.SymbolKind.Object,
    Interface: lsp.SymbolKind.Interface,
}


def prepare(
    session: Session, params: lsp.CallHierarchyPrepareParams
) -> list[lsp.CallHierarchyItem] | None:
    """The component, instance or interface at the place; None where there is none."""
    things = [one.symbol.thing for one in mentions_at(session, params)]
    found = [one for one in things if isinstance(one, Component | Instance | Interface)]
    # Of an instance that has the name of its component the instance says more.
    found.sort(key=lambda one: not isinstance(one, Instance))
    return [_item(session, found[0])] if found else None


def incoming(
    session: Session, params: lsp.CallHierarchyIncomingCallsParams
) -> list[lsp.CallHierarchyIncomingCall]:
    """Who requires what it implements, and who subscribes to what it publishes."""
    me = _key(session, params.item)
    uses = (one for one in _uses(session, params.item) if _party_key(one.provider) == me)
    grouped = _grouped(uses, lambda one: (one.user, one.user_span))
    return [
        lsp.CallHierarchyIncomingCall(_item(session, party), [range_of(one) for one in spans])
        for party, spans in grouped
    ]


def outgoing(
    session: Session, params: lsp.CallHierarchyOutgoingCallsParams
) -> list[lsp.CallHierarchyOutgoingCall]:
    """Who implements what it requires, and who publishes what it subscribes to."""
    me = _key(session, params.item)
    uses = (one for one in _uses(session, params.item) if _party_key(one.user) == me)
    grouped = _grouped(uses, lambda one: (one.provider, one.user_span))
    return [
        lsp.CallHierarchyOutgoingCall(_item(session, party), [range_of(one) for one in spans])
        for party, spans in grouped
    ]


def _uses(session: Session, item: lsp.CallHierarchyItem) -> list[Use]:
    """All uses of the world that the item is of: a deployment, or the components."""
    path = session.path_of(item.uri)
    model = _model(session, item)
    if isinstance(model, Deployment):
        return uses_of_instances(model)
    if path.suffix.lower() != ".idsl":
        return uses_of_components(components(session))
    modules = model if isinstance(model, tuple) else ()
    declared = (one for module in modules for one in module.declarations)
    found = (one for one in declared if isinstance(one, Interface) and one.name == item.name)
    interface = next(found, None)
    return uses_of_interface(interface, components(session)) if interface else []


def _model(session: Session, item: lsp.CallHierarchyItem) -> object:
    try:
        return session.checked(session.path_of(item.uri)).model
    except UnreadableSource as error:
        raise NoDescription(f"cannot read `{item.uri}`: {error}") from None


def _key(session: Session, item: lsp.CallHierarchyItem) -> tuple[str, str]:
    return identity(session.path_of(item.uri)), item.name


def _party_key(party: Party) -> tuple[str, str]:
    return identity(party.span.source.path), party.name


def _grouped(
    uses: Iterable[Use], other: Callable[[Use], tuple[Party, Span]]
) -> Iterator[tuple[Party, list[Span]]]:
    """The other parties, each with its places, none twice."""
    found: dict[tuple[str, str], tuple[Party, dict[int, Span]]] = {}
    for one in uses:
        party, span = other(one)
        _, spans = found.setdefault(_party_key(party), (party, {}))
        spans.setdefault(span.start, span)
    return ((party, list(spans.values())) for party, spans in found.values())


def _item(session: Session, party: Party) -> lsp.CallHierarchyItem:
    place = range_of(party.span)
    uri = session.uri_of(party.span.source.path)
    made = lsp.CallHierarchyItem(party.name, KINDS[type(party)], uri, place, place)
    match party:
        case Instance():
            made.detail = f": {party.component.name}"
        case Interface():
            made.detail = party.qualified
        case Component():
            made.detail = ", ".join(
                f"{port.role} {port.interface.name}" for port in party.ports[:4]
            )
    return made
