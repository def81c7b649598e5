"""Code lenses: "generate component" above a component or bridge, and the uses of an interface.

In: a CDSL, BDSL or IDSL file. Out: lenses with commands.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from lsprotocol import types as lsp

from robocomp_dsl.language_server.features.commands import GENERATE, SHOW_REFERENCES
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.dependencies import interface_key, known_components
from robocomp_dsl.language_server.symbols.lookup import location_of
from robocomp_dsl.model.component import Port, Role
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.syntax.ast import bdsl, cdsl

_VERBS = {
    Role.IMPLEMENTS: ("implements", "implement"),
    Role.REQUIRES: ("requires", "require"),
    Role.PUBLISHES: ("publishes", "publish"),
    Role.SUBSCRIBES: ("subscribes to", "subscribe to"),
}


def code_lenses(session: Session, params: lsp.CodeLensParams) -> list[lsp.CodeLens]:
    """The lenses of a file."""
    uri = params.text_document.uri
    session.source(uri)
    path = session.path_of(uri)
    match path.suffix.lower():
        case ".idsl":
            objects = [symbol.model_object for symbol in session.index(path).declarations()]
            return _of_interfaces(session, [o for o in objects if isinstance(o, Interface)])
        case ".cdsl" | ".bdsl":
            return _of_component(session, uri, session.parsed(path).tree)
    return []


def _of_component(session: Session, uri: str, tree: object) -> list[lsp.CodeLens]:
    match tree:
        case cdsl.File(component=cdsl.Component(name=name)):
            title = "generate component"
        case bdsl.File(bridge=bdsl.Bridge(name=name)):
            title = "generate bridge"
        case _:
            return []
    command = lsp.Command(title, GENERATE, arguments=[uri])
    return [lsp.CodeLens(session.positions.range_of(name.span), command)]


def _of_interfaces(session: Session, interfaces: list[Interface]) -> list[lsp.CodeLens]:
    keys = {interface_key(interface) for interface in interfaces}
    ports: dict[tuple[str, int], list[tuple[Port, str]]] = {}
    for component in known_components(session) if keys else ():
        for port in component.ports:
            key = interface_key(port.interface)
            if key in keys:
                ports.setdefault(key, []).append((port, component.name))
    return [_lens(session, each, ports.get(interface_key(each), ())) for each in interfaces]


def _lens(
    session: Session, interface: Interface, ports: Iterable[tuple[Port, str]]
) -> lsp.CodeLens:
    ports = list(ports)
    declaration = location_of(session, interface.span)
    counts = Counter(role for role, _ in {(port.role, name) for port, name in ports})
    locations = [location_of(session, port.span) for port, _ in ports]
    arguments = [declaration.uri, declaration.range.start, locations]
    command = lsp.Command(_usage_summary(counts), SHOW_REFERENCES, arguments=arguments)
    return lsp.CodeLens(declaration.range, command)


def _usage_summary(counts: Counter[Role]) -> str:
    parts = [
        f"{n} component{'s' if n > 1 else ''} {plural if n > 1 else singular} this"
        for role, (singular, plural) in _VERBS.items()
        if (n := counts[role])
    ]
    return ", ".join(parts) or "no component uses this"
