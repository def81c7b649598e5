"""Indexer of DDSL files: instances, hosts, groups, components, ports and parameters."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from robocomp_dsl.check.ddsl.definitions import DefinitionFiles
from robocomp_dsl.check.passes import check_cdsl, check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.language_server.symbols.group_symbols import GroupSymbols, group_symbol
from robocomp_dsl.language_server.symbols.symbol import Occurrence, Symbol
from robocomp_dsl.language_server.symbols.symbols_cdsl import (
    component_symbol,
    has_alias,
    port_symbol,
)
from robocomp_dsl.language_server.symbols.symbols_idsl import declaration_symbol
from robocomp_dsl.language_server.symbols.symbols_pdsl import parameter_symbol
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.deployment import External
from robocomp_dsl.model.parameter import Parameter
from robocomp_dsl.model.placement import LabelledHosts
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Name
from robocomp_dsl.syntax.parse import parse_ddsl

_PART = re.compile(r"[A-Za-z_]\w*")


def index_file(path: Path, workspace: Workspace) -> tuple[Source, bool, list[Occurrence]]:
    """The occurrences in the file at `path`. Raises `UnreadableSource`."""
    file = workspace.sources.parse(path, parse_ddsl)
    tree = file.tree.deployment
    if tree is None and not file.tree.groups:
        return file.source, file.tree.complete, []
    definitions = DefinitionFiles(workspace, check_cdsl)
    imported = definitions.load(file, Report()).components
    deployment = check_ddsl(path, workspace, Report())
    model_objects: dict[int, object] = {}
    if deployment:
        own = [i for i in deployment.instances if i.span.source.path == path]
        model_objects = {instance.span.start: instance for instance in own}
        model_objects |= {host.span.start: host for host in deployment.hosts if host.span}
        model_objects |= {external.span.start: external for external in deployment.externals}
    name = tree.name.text if tree else ""
    collector = _OccurrenceCollector(
        imported.components, model_objects, name, workspace, GroupSymbols(definitions)
    )
    occurrences: list[Occurrence] = []
    if tree is not None:
        symbol = Symbol(name, "deployment", tree.name.span, deployment)
        occurrences = [Occurrence(symbol.span, symbol, declares=True), *collector.of_hosts(tree)]
        occurrences += collector.of_externals(tree)
        occurrences += collector.of_block(tree)
    for group in file.tree.groups:
        occurrences += collector.of_group(group, group_symbol(group))
    return file.source, file.tree.complete, occurrences


class _OccurrenceCollector:
    """`model_objects` are the instances and hosts of the model by the offset of their names."""

    def __init__(
        self,
        components: Mapping[str, Component],
        model_objects: Mapping[int, object],
        container: str,
        workspace: Workspace,
        groups: GroupSymbols,
    ) -> None:
        self._groups = groups
        self._components = components
        self._model_objects = model_objects
        self._container = container
        self._workspace = workspace
        self._hosts: dict[str, Symbol] = {}
        self._labels: dict[str, Symbol] = {}
        self._externals: dict[str, Symbol] = {}

    def of_hosts(self, tree: ast.Deployment) -> Iterator[Occurrence]:
        """The hosts, which are also visible in groups."""
        for host in tree.hosts:
            self._hosts[host.name.text] = self._symbol(host.name, "host")
            yield Occurrence(host.name.span, self._hosts[host.name.text], declares=True)
        for host in tree.hosts:
            for label in host.labels:
                first = label.text not in self._labels
                if first:
                    self._labels[label.text] = self._label(label, tree)
                yield Occurrence(label.span, self._labels[label.text], declares=first)

    def of_externals(self, tree: ast.Deployment) -> Iterator[Occurrence]:
        """The external programs, which are also visible in groups."""
        for external in tree.externals:
            symbol = self._symbol(external.name, "external program")
            self._externals[external.name.text] = symbol
            yield Occurrence(external.name.span, symbol, declares=True)
            if isinstance(symbol.model_object, External):
                interface = symbol.model_object.only_port.interface
                yield Occurrence(external.interface.name.span, declaration_symbol(interface))

    def of_block(self, tree: ast.Deployment | ast.Group) -> Iterator[Occurrence]:
        """All occurrences in a deployment or a group."""
        instances = {i.name.text: self._symbol(i.name, "instance") for i in tree.instances}
        for group in tree.groups:
            instances[group.name.text] = group_symbol(group, self._container)
        groups = {group.name.text: group for group in tree.groups}
        for group in tree.groups:
            yield from self.of_group(group, instances[group.name.text])
            for name in group.after:
                yield from _name_occurrence(name, instances)
        kinds = {
            i.name.text: (i.component or i.name).text for i in tree.instances if not i.is_program
        }
        for instance in tree.instances:
            yield from self._instance(instance, instances)
        if isinstance(tree, ast.Group):
            yield from _renamed_exports(tree)
        for end in _ends(tree):
            yield from _name_occurrence(end.instance, {**self._externals, **instances})
            component = self._components.get(kinds.get(end.instance.text, ""))
            if component:
                yield from _port_occurrence(end.port, component, self._workspace)
            if end.instance.text in groups:
                yield from self._exported(end.port, groups[end.instance.text])
            program = self._externals.get(end.instance.text)
            if program and isinstance(program.model_object, External):
                interface = program.model_object.only_port.interface
                yield Occurrence(end.port.span, declaration_symbol(interface))

    def of_group(self, group: ast.Group, symbol: Symbol) -> Iterator[Occurrence]:
        """All occurrences in a group, its name included."""
        yield Occurrence(group.name.span, symbol, declares=True)
        yield from self._groups.of_definition_name(group)
        yield from self._place(group)
        for setting in group.settings:
            for found in self._groups.of_key(group, setting.key):
                if isinstance(found, Occurrence):
                    yield found
                else:
                    yield from _key_occurrences(found.name, found.parameters, found.container)
        yield from self.of_block(group)

    def _exported(self, port: Name, group: ast.Group) -> Iterator[Occurrence]:
        """The port of a group: its export, or the port that is exported under its own name."""
        target = self._groups.target_of_export(group, port.text)
        if isinstance(target, Symbol):
            yield Occurrence(port.span, target)
        elif target is not None:
            yield from _port_occurrence(port, target[1], self._workspace)

    def _symbol(self, name: Name, kind: str) -> Symbol:
        model_object = self._model_objects.get(name.span.start)
        return Symbol(name.text, kind, name.span, model_object, self._container)

    def _instance(self, tree: ast.Instance, known: Mapping[str, Symbol]) -> Iterator[Occurrence]:
        own, name = tree.name.text, tree.component or tree.name
        component = None if tree.is_program else self._components.get(name.text)
        short = component is not None and tree.component is None
        if component:
            template = f"{own} : {{}}" if short else "{}"
            yield Occurrence(name.span, component_symbol(component), rename_template=template)
        template = f"{{}} : {own}" if short else "{}"
        yield Occurrence(tree.name.span, known[own], declares=True, rename_template=template)
        yield from self._place(tree)
        for name in tree.after:
            yield from _name_occurrence(name, known)
        if component:
            for own_port in tree.own_ports:
                yield from _port_occurrence(own_port.port, component, self._workspace)
        if component and component.parameters:
            for setting in tree.settings:
                yield from _key_occurrences(
                    setting.key, component.parameters.parameters, component.name
                )

    def _label(self, name: Name, tree: ast.Deployment) -> Symbol:
        """The symbol of a label, which may belong to several hosts."""
        hosts = [h.name.text for h in tree.hosts if name.text in [each.text for each in h.labels]]
        labelled = LabelledHosts(name.text, tuple(hosts))
        return Symbol(name.text, "label", name.span, labelled, self._container)

    def _place(self, tree: ast.Instance | ast.Group) -> Iterator[Occurrence]:
        """The host of a component or group, or the hosts and label among which one is chosen."""
        hosts = [tree.host] if tree.host else []
        labels = [tree.label] if tree.label else []
        if tree.place is not None:
            hosts += tree.place.hosts
            labels += [tree.place.label] if tree.place.label else []
        for name in hosts:
            yield from _name_occurrence(name, self._hosts)
        for name in labels:
            yield from _name_occurrence(name, self._labels)


def _ends(tree: ast.Deployment | ast.Group) -> Iterator[ast.PortRef]:
    """The ports that connections, arbitrations and exports name."""
    for connection in tree.connections:
        yield from (connection.source, connection.target)
    for arbitration in tree.arbitrations:
        yield from (arbitration.target, *(c.source for c in arbitration.candidates))
    if isinstance(tree, ast.Group):
        yield from (export.target for export in tree.exports)


def _renamed_exports(tree: ast.Group) -> Iterator[Occurrence]:
    """The names of exports that differ from those of their ports."""
    for export in tree.exports:
        if export.port is not export.target.port:
            name = export.port
            symbol = Symbol(name.text, "export", name.span, None, tree.name.text)
            yield Occurrence(name.span, symbol, declares=True)


def _name_occurrence(name: Name, symbols: Mapping[str, Symbol]) -> Iterator[Occurrence]:
    if name.text in symbols:
        yield Occurrence(name.span, symbols[name.text])


def _port_occurrence(
    name: Name, component: Component, workspace: Workspace
) -> Iterator[Occurrence]:
    port = next((port for port in component.ports if port.name == name.text), None)
    if port is None:
        return
    definition = port_symbol(port, component)
    if has_alias(port, component, workspace):
        yield Occurrence(name.span, definition)
    else:
        # `Laser1` is the second port of `Laser`: a rename keeps the number.
        template = f"{{}}{name.text.removeprefix(port.interface.name)}"
        yield Occurrence(
            name.span,
            declaration_symbol(port.interface),
            rename_template=template,
            definition=definition,
        )


def _key_occurrences(
    name: Name, parameters: Sequence[Parameter], container: str
) -> Iterator[Occurrence]:
    """The parameters in a key such as `motors[2].min`, up to the first unknown name."""
    for part in _PART.finditer(name.span.text):
        parameter = next((p for p in parameters if p.name == part[0]), None)
        if parameter is None:
            return
        start = name.span.start + part.start()
        span = name.span.source.span(start, start + len(part[0]))
        yield Occurrence(span, parameter_symbol(parameter, container))
        parameters, container = parameter.members, parameter.name
