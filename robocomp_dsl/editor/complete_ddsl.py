"""Names that a DDSL file can use at a place."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import takewhile

from lsprotocol import types as lsp

from robocomp_dsl.check import check_cdsl
from robocomp_dsl.check.components import imported_components
from robocomp_dsl.check.qos import PRIORITIES
from robocomp_dsl.check.wiring import SOURCES, TARGETS
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.editor import complete_devices
from robocomp_dsl.editor.cursor import Cursor
from robocomp_dsl.editor.names_cdsl import port_symbol
from robocomp_dsl.editor.names_cdsl import symbol as component_symbol
from robocomp_dsl.editor.names_pdsl import symbol as parameter_symbol
from robocomp_dsl.editor.offer import Offer, words
from robocomp_dsl.editor.session import Session
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.parameter import Parameter
from robocomp_dsl.syntax import ast_ddsl as ast
from robocomp_dsl.syntax.lexer import Token

POLICIES = ("on-failure", "always", "never")


def names(session: Session, cursor: Cursor) -> Iterator[Offer]:
    """Components, instances, hosts, ports, parameters: what the place asks for."""
    kinds = [token.kind for token in cursor.statement]
    first, last = (kinds or [""])[0], cursor.last
    trees = [one.tree for one in session.checks_to_complete(cursor.path)]
    files = [tree for tree in trees if isinstance(tree, ast.File)]
    everyone = list(_all_instances(files))
    instances = {i.name.text: (i.component or i.name).text for i in everyone}
    if complete_devices.in_devices(cursor):
        yield from complete_devices.names(cursor, everyone)
    elif first == "COMPONENT" and last in ("COMPONENT", "COLON"):
        components = _components(session, cursor, files).values()
        kind = lsp.CompletionItemKind.Class
        yield from (Offer(c.name, kind, "component", component_symbol(c)) for c in components)
    elif first == "COMPONENT" and last == "_ON":
        yield from words(*(h.name.text for f in files if f.deployment for h in f.deployment.hosts))
    elif last == "DOT" and first in ("CONNECT", "EXPORT"):
        component = _components(session, cursor, files).get(
            instances.get(cursor.statement[-2].text, "")
        )
        yield from _ports(component, SOURCES if "__ANON_0" not in kinds else TARGETS)
    elif first == "SET" and "EQUAL" not in kinds:
        name = [token.text for token in cursor.block if token.kind == "ID"]
        component = _components(session, cursor, files).get(
            instances.get(name[0] if name else "", "")
        )
        if component and component.parameters:
            yield from _parameters(component.parameters.parameters, cursor.statement[1:])
    elif last in ("CONNECT", "__ANON_0", "FROM") or (
        first == "AFTER" and last in ("AFTER", "COMMA")
    ):
        kind = lsp.CompletionItemKind.Variable
        yield from (Offer(name, kind, f": {of}") for name, of in instances.items())
    elif last == "MIDDLEWARE":
        yield from words(*session.workspace.middlewares)
    else:
        yield from words(*_prefixes(everyone) if last == "PREFIX" else _WORDS.get(last, ()))


_WORDS = {"RESTART": POLICIES, "PRIORITY": PRIORITIES}
"""Words that are always the same, by the keyword in front of them."""


def _all_instances(files: Sequence[ast.File]) -> Iterator[ast.Instance]:
    """Those of older texts first, so that newer ones win."""
    for file in reversed(files):
        todo: list[ast.Deployment | ast.Group] = [file.deployment] if file.deployment else []
        while todo:
            block = todo.pop()
            yield from block.instances
            todo.extend(block.groups)


def _prefixes(instances: Sequence[ast.Instance]) -> list[str]:
    """Those that others of the file have, if they can be written without quotation marks."""
    found = {one.prefix.span.text for one in instances if one.prefix}
    return sorted(text for text in found if text.isidentifier())


def _components(
    session: Session, cursor: Cursor, files: Sequence[ast.File]
) -> Mapping[str, Component]:
    found: dict[str, Component] = {}
    for file in files:
        made = imported_components(
            file.imports, cursor.path, session.workspace, check_cdsl, Report()
        )
        found = {**made.components, **found}
    return found


def _ports(component: Component | None, roles: Sequence[object]) -> Iterator[Offer]:
    for port in component.ports if component else ():
        if component and port.role in roles:
            kind = lsp.CompletionItemKind.Property
            detail = f"{port.role} {port.interface.qualified}"
            yield Offer(port.name, kind, detail, port_symbol(port, component))


def _parameters(parameters: Sequence[Parameter], key: Sequence[Token]) -> Iterator[Offer]:
    """The parameters behind what is already written of a dotted key."""
    container = ""
    for part in takewhile(lambda token: token.kind != "EQUAL", key):
        if part.kind == "ID":
            found = next((one for one in parameters if one.name == part.text), None)
            if found is None:
                return
            parameters, container = found.members, found.name
    for one in parameters:
        kind = lsp.CompletionItemKind.Property
        yield Offer(one.name, kind, one.kind.value, parameter_symbol(one, container))
