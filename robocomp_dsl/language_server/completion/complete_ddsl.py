"""Completion of DDSL files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import takewhile

from lsprotocol import types as lsp

from robocomp_dsl.check.ddsl.components import imported_components
from robocomp_dsl.check.ddsl.connections import SOURCES, TARGETS
from robocomp_dsl.check.ddsl.qos import PRIORITIES
from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.language_server.completion import complete_devices
from robocomp_dsl.language_server.completion.candidates import (
    CompletionCandidate,
    middleware_candidates,
    value_candidates,
)
from robocomp_dsl.language_server.completion.context import CompletionContext
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.symbols_cdsl import component_symbol, port_symbol
from robocomp_dsl.language_server.symbols.symbols_pdsl import parameter_symbol
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.parameter import Parameter
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.grammar.lexer import Token

POLICIES = ("on-failure", "always", "never")


def candidates(session: Session, context: CompletionContext) -> Iterator[CompletionCandidate]:
    """Components, instances, hosts, ports and parameters."""
    kinds = [token.kind for token in context.statement]
    first, last = (kinds or [""])[0], context.previous_kind
    trees = [checked.tree for checked in session.checks_for_completion(context.path)]
    files = [tree for tree in trees if isinstance(tree, ast.File)]
    all_instances = list(_all_instances(files))
    instances = {i.name.text: (i.component or i.name).text for i in all_instances}
    if complete_devices.in_devices(context):
        yield from complete_devices.candidates(context, all_instances)
    elif first == "COMPONENT" and last in ("COMPONENT", "COLON"):
        components = _components(session, context, files).values()
        kind = lsp.CompletionItemKind.Class
        for each in components:
            yield CompletionCandidate(each.name, kind, "component", component_symbol(each))
    elif first == "COMPONENT" and last == "_ON":
        deployments = [file.deployment for file in files if file.deployment]
        yield from value_candidates(*(h.name.text for d in deployments for h in d.hosts))
    elif last == "DOT" and first in ("CONNECT", "EXPORT"):
        component = _components(session, context, files).get(
            instances.get(context.statement[-2].text, "")
        )
        yield from _ports(component, SOURCES if "__ANON_0" not in kinds else TARGETS)
    elif first == "SET" and "EQUAL" not in kinds:
        name = [token.text for token in context.block if token.kind == "ID"]
        component = _components(session, context, files).get(
            instances.get(name[0] if name else "", "")
        )
        if component and component.parameters:
            yield from _parameters(component.parameters.parameters, context.statement[1:])
    elif last in ("CONNECT", "__ANON_0", "FROM") or (
        first == "AFTER" and last in ("AFTER", "COMMA")
    ):
        kind = lsp.CompletionItemKind.Variable
        yield from (CompletionCandidate(name, kind, f": {of}") for name, of in instances.items())
    elif last in ("MIDDLEWARE", "OVER"):
        yield from middleware_candidates(session.workspace.middlewares)
    else:
        fixed = _KEYWORD_VALUES.get(last, ())
        yield from value_candidates(*(_prefixes(all_instances) if last == "PREFIX" else fixed))


_KEYWORD_VALUES = {"RESTART": POLICIES, "PRIORITY": PRIORITIES}
"""Keyword to the fixed values that may follow it."""


def _all_instances(files: Sequence[ast.File]) -> Iterator[ast.Instance]:
    """The instances of all trees, the oldest tree first, so that newer ones override."""
    for file in reversed(files):
        todo: list[ast.Deployment | ast.Group] = [file.deployment] if file.deployment else []
        while todo:
            block = todo.pop()
            yield from block.instances
            todo.extend(block.groups)


def _prefixes(instances: Sequence[ast.Instance]) -> list[str]:
    """The prefixes of other instances that need no quotation marks."""
    prefixes = {instance.prefix.span.text for instance in instances if instance.prefix}
    return sorted(text for text in prefixes if text.isidentifier())


def _components(
    session: Session, context: CompletionContext, files: Sequence[ast.File]
) -> Mapping[str, Component]:
    components: dict[str, Component] = {}
    for file in files:
        imported = imported_components(
            file.imports, context.path, session.workspace, check_cdsl, Report()
        )
        components = {**imported.components, **components}
    return components


def _ports(component: Component | None, roles: Sequence[object]) -> Iterator[CompletionCandidate]:
    for port in component.ports if component else ():
        if component and port.role in roles:
            kind = lsp.CompletionItemKind.Property
            detail = f"{port.role} {port.interface.qualified}"
            yield CompletionCandidate(port.name, kind, detail, port_symbol(port, component))


def _parameters(
    parameters: Sequence[Parameter], key: Sequence[Token]
) -> Iterator[CompletionCandidate]:
    """The parameters that may continue a dotted key."""
    container = ""
    for part in takewhile(lambda token: token.kind != "EQUAL", key):
        if part.kind == "ID":
            group = next((p for p in parameters if p.name == part.text), None)
            if group is None:
                return
            parameters, container = group.members, group.name
    kind = lsp.CompletionItemKind.Property
    for parameter in parameters:
        symbol = parameter_symbol(parameter, container)
        yield CompletionCandidate(parameter.name, kind, parameter.kind.value, symbol)
