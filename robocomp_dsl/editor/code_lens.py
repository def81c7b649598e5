"""Code lens: how many components use an interface, above its declaration.

In: an IDSL file. Out: a line above each interface, which is text only: to see the components, find
the references of the interface.
"""

from __future__ import annotations

from collections import Counter

from lsprotocol import types as lsp

from robocomp_dsl.check.files import identity
from robocomp_dsl.editor.positions import range_of
from robocomp_dsl.editor.session import Session
from robocomp_dsl.model.component import Component, Role
from robocomp_dsl.source import UnreadableSource

_VERBS = {
    Role.IMPLEMENTS: ("implements", "implement"),
    Role.REQUIRES: ("requires", "require"),
    Role.PUBLISHES: ("publishes", "publish"),
    Role.SUBSCRIBES: ("subscribes to", "subscribe to"),
}


def code_lenses(session: Session, params: lsp.CodeLensParams) -> list[lsp.CodeLens]:
    """What to show above the interfaces of a file."""
    session.source(params.text_document.uri)
    path = session.path_of(params.text_document.uri)
    if path.suffix.lower() != ".idsl":
        return []
    found = [one.symbol for one in session.index(path).mentions if one.declares]
    interfaces = [one for one in found if one.kind == "interface"]
    uses = _uses(session) if interfaces else {}
    return [
        lsp.CodeLens(range_of(one.span), lsp.Command(_words(uses.get(one.key, Counter())), ""))
        for one in interfaces
    ]


def _uses(session: Session) -> dict[tuple[str, int], Counter[Role]]:
    """How many components have a port of each role, by the key of the interface."""
    uses: dict[tuple[str, int], Counter[Role]] = {}
    for path in session.every_file():
        if path.suffix.lower() != ".cdsl":
            continue
        try:
            model = session.checked(path).model
        except UnreadableSource:
            continue
        ports = model.ports if isinstance(model, Component) else ()
        for role, interface in {(port.role, port.interface) for port in ports}:
            key = identity(interface.span.source.path), interface.span.start
            uses.setdefault(key, Counter())[role] += 1
    return uses


def _words(counts: Counter[Role]) -> str:
    parts = [
        f"{n} component{'s' if n > 1 else ''} {many if n > 1 else one} this"
        for role, (one, many) in _VERBS.items()
        if (n := counts[role])
    ]
    return ", ".join(parts) or "no component uses this"
