"""Completion of DDSL files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from lsprotocol import types as lsp

from robocomp_dsl.check.ddsl.components import imported_components
from robocomp_dsl.check.ddsl.connections import SOURCES, TARGETS
from robocomp_dsl.check.ddsl.qos import PRIORITIES
from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.language_server.completion import (
    complete_connections,
    complete_devices,
    complete_groups,
)
from robocomp_dsl.language_server.completion.candidates import (
    CompletionCandidate,
    middleware_candidates,
    parameter_candidates,
    value_candidates,
)
from robocomp_dsl.language_server.completion.context import CompletionContext
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.symbols_cdsl import component_symbol, port_symbol
from robocomp_dsl.model.component import Component, Role
from robocomp_dsl.syntax.ast import ddsl as ast

POLICIES = ("on-failure", "always", "never")


@dataclass(frozen=True, slots=True)
class _DdslNames:
    """The names of the file, now and at the last check without syntax errors.

    `instances` are the components of the instances by name.
    """

    session: Session
    context: CompletionContext
    files: Sequence[ast.File]
    instances: Mapping[str, str]

    def components(self) -> Mapping[str, Component]:
        """The imported components by name."""
        components: dict[str, Component] = {}
        for file in self.files:
            imported = imported_components(
                file.imports, self.context.path, self.session.workspace, check_cdsl, Report()
            )
            components = {**imported.components, **components}
        return components

    def component_of(self, instance: str) -> Component | None:
        """The component of an instance."""
        return self.components().get(self.instances.get(instance, ""))

    def component_of_block(self) -> Component | None:
        """The component of the instance whose block is open."""
        tokens = self.context.block
        return self.component_of(next((t.text for t in tokens if t.kind == "ID"), ""))


def candidates(session: Session, context: CompletionContext) -> Iterator[CompletionCandidate]:
    """Components, instances, hosts, ports, parameters and middlewares."""
    first = context.statement[0].kind if context.statement else ""
    trees = [checked.tree for checked in session.checks_for_completion(context.path)]
    files = [tree for tree in trees if isinstance(tree, ast.File)]
    all_instances = list(_all_instances(files))
    instances = {i.name.text: (i.component or i.name).text for i in all_instances}
    names = _DdslNames(session, context, files, instances)
    if complete_devices.in_devices(context):
        yield from complete_devices.candidates(context, all_instances)
    elif context.previous_kind in ("MIDDLEWARE", "OVER"):
        yield from middleware_candidates(session.workspace.middlewares)
    elif complete_groups.in_group(context):
        yield from complete_groups.candidates(session, context, files)
    elif first in _CONNECTION_STATEMENTS:
        yield from _in_connection(names, first)
    else:
        yield from _in_setting(names, first, all_instances)


def _in_connection(names: _DdslNames, first: str) -> Iterator[CompletionCandidate]:
    """Instances, ports, interfaces and monitors."""
    context, last = names.context, names.context.previous_kind
    externals = complete_connections.external_names(names.files)
    if first == "MONITOR":
        yield from complete_connections.monitor_candidates(names.session, context)
    elif first == "EXTERN" and last in complete_connections.ROLES:
        yield from complete_connections.interface_candidates(names.components())
    elif first == "PORT" and last == "PORT":
        yield from _ports(names.component_of_block(), tuple(Role))
    elif last == "DOT":
        name = context.statement[-2].text
        if name in externals:
            yield from value_candidates(externals[name].interface.name.text)
        yield from complete_groups.exports(names.session, names.files, name)
        targets = first == "ARBITRATE" or any(t.kind == "__ANON_0" for t in context.statement)
        yield from _ports(names.component_of(name), TARGETS if targets else SOURCES)
    elif last in ("CONNECT", "__ANON_0", "FROM", "ARBITRATE"):
        kind = lsp.CompletionItemKind.Variable
        for name, component in names.instances.items():
            yield CompletionCandidate(name, kind, f": {component}")
        yield from complete_groups.group_names(names.files)
        for name, external in externals.items() if first in ("CONNECT", "FROM") else ():
            yield CompletionCandidate(name, kind, f"over {external.over.text}")


def _in_setting(
    names: _DdslNames, first: str, all_instances: Sequence[ast.Instance]
) -> Iterator[CompletionCandidate]:
    """Components, hosts, parameters and the values of settings."""
    context, last = names.context, names.context.previous_kind
    if first == "COMPONENT" and last in ("COMPONENT", "COLON"):
        kind = lsp.CompletionItemKind.Class
        for each in names.components().values():
            yield CompletionCandidate(each.name, kind, "component", component_symbol(each))
    elif first in _PLACED_STATEMENTS and last in ("_ON", "LABEL", "COMMA"):
        labels = last == "LABEL" and context.statement[-2].kind == "_ON"
        yield from value_candidates(*_hosts_or_labels(names.files, labels=labels))
    elif first == "SET" and all(token.kind != "EQUAL" for token in context.statement):
        component = names.component_of_block()
        if component and component.parameters:
            yield from parameter_candidates(component.parameters.parameters, context.statement[1:])
    elif last == "FROM" or (first == "AFTER" and last in ("AFTER", "COMMA")):
        kind = lsp.CompletionItemKind.Variable
        for name, of in names.instances.items():
            yield CompletionCandidate(name, kind, f": {of}")
    else:
        fixed = _KEYWORD_VALUES.get(last, ())
        yield from value_candidates(*(_prefixes(all_instances) if last == "PREFIX" else fixed))


_CONNECTION_STATEMENTS = frozenset(
    ("CONNECT", "EXPORT", "FROM", "ARBITRATE", "EXTERN", "MONITOR", "PORT")
)
_PLACED_STATEMENTS = frozenset(("COMPONENT", "PROGRAM", "GROUP", "PLACE"))
_KEYWORD_VALUES = {"RESTART": POLICIES, "PRIORITY": PRIORITIES}
"""Keyword to the fixed values that may follow it."""


def _all_instances(files: Sequence[ast.File]) -> Iterator[ast.Instance]:
    """The instances of all trees, the oldest tree first, so that newer instances override."""
    for file in reversed(files):
        todo: list[ast.Deployment | ast.Group] = [*file.groups]
        todo += [file.deployment] if file.deployment else []
        while todo:
            block = todo.pop()
            yield from block.instances
            todo.extend(block.groups)


def _hosts_or_labels(files: Sequence[ast.File], *, labels: bool) -> list[str]:
    """The names of the hosts, or their labels."""
    hosts = [host for file in files if file.deployment for host in file.deployment.hosts]
    if labels:
        return sorted({label.text for host in hosts for label in host.labels})
    return list(dict.fromkeys(host.name.text for host in hosts))


def _prefixes(instances: Sequence[ast.Instance]) -> list[str]:
    """The prefixes of other instances that need no quotation marks."""
    prefixes = {instance.prefix.span.text for instance in instances if instance.prefix}
    return sorted(text for text in prefixes if text.isidentifier())


def _ports(component: Component | None, roles: Sequence[object]) -> Iterator[CompletionCandidate]:
    for port in component.ports if component else ():
        if component and port.role in roles:
            kind = lsp.CompletionItemKind.Property
            detail = f"{port.role} {port.interface.qualified}"
            yield CompletionCandidate(port.name, kind, detail, port_symbol(port, component))
