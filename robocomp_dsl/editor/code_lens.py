"""Code lens: what can be done with a component, and how many components use an interface.

In: a CDSL or IDSL file. Out: a line above each component that generates it, and one above each
interface that leads to the components.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from lsprotocol import types as lsp

from robocomp_dsl.editor.asked import location
from robocomp_dsl.editor.commands import GENERATE, SHOW_REFERENCES
from robocomp_dsl.editor.positions import range_of
from robocomp_dsl.editor.session import Session
from robocomp_dsl.editor.uses import components, interface_key
from robocomp_dsl.model.component import Port, Role
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.syntax import ast_cdsl

_VERBS = {
    Role.IMPLEMENTS: ("implements", "implement"),
    Role.REQUIRES: ("requires", "require"),
    Role.PUBLISHES: ("publishes", "publish"),
    Role.SUBSCRIBES: ("subscribes to", "subscribe to"),
}


def code_lenses(session: Session, params: lsp.CodeLensParams) -> list[lsp.CodeLens]:
    """What to show in a file."""
    uri = params.text_document.uri
    session.source(uri)
    path = session.path_of(uri)
    match path.suffix.lower():
        case ".idsl":
            things = [one.thing for one in session.index(path).declared()]
            return _of_interfaces(session, [one for one in things if isinstance(one, Interface)])
        case ".cdsl":
            return _of_component(uri, session.parsed(path).tree)
    return []


def _of_component(uri: str, tree: object) -> list[lsp.CodeLens]:
    if not isinstance(tree, ast_cdsl.File) or tree.component is None:
        return []
    command = lsp.Command("generate component", GENERATE, arguments=[uri])
    return [lsp.CodeLens(range_of(tree.component.name.span), command)]


def _of_interfaces(session: Session, declared: list[Interface]) -> list[lsp.CodeLens]:
    keys = {interface_key(one) for one in declared}
    ports: dict[tuple[str, int], list[tuple[Port, str]]] = {}
    for component in components(session) if keys else ():
        for port in component.ports:
            key = interface_key(port.interface)
            if key in keys:
                ports.setdefault(key, []).append((port, component.name))
    return [_lens(session, one, ports.get(interface_key(one), ())) for one in declared]


def _lens(
    session: Session, interface: Interface, ports: Iterable[tuple[Port, str]]
) -> lsp.CodeLens:
    ports = list(ports)
    uri, place = session.uri_of(interface.span.source.path), range_of(interface.span)
    counts = Counter(role for role, _ in {(port.role, name) for port, name in ports})
    places = [location(session, port.span) for port, _ in ports]
    arguments = [uri, place.start, places]
    return lsp.CodeLens(place, lsp.Command(_words(counts), SHOW_REFERENCES, arguments=arguments))


def _words(counts: Counter[Role]) -> str:
    parts = [
        f"{n} component{'s' if n > 1 else ''} {many if n > 1 else one} this"
        for role, (one, many) in _VERBS.items()
        if (n := counts[role])
    ]
    return ", ".join(parts) or "no component uses this"
