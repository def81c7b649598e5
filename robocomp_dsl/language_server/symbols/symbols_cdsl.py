"""Indexer of CDSL files: the component, the interfaces of its ports, and the port aliases."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.check.cdsl.options import expand_options, resolve_imports
from robocomp_dsl.check.names.import_scope import ImportScope
from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.source_cache import Parsed
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.language_server.symbols.symbol import Occurrence, Symbol
from robocomp_dsl.language_server.symbols.symbols_idsl import occurrences_of
from robocomp_dsl.model.component import Component, Port
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.ast import cdsl as ast
from robocomp_dsl.syntax.parse import parse_cdsl


def index_file(path: Path, workspace: Workspace) -> tuple[Source, bool, list[Occurrence]]:
    """The occurrences in the file at `path`. Raises `UnreadableSource`."""
    file = workspace.sources.parse(path, parse_cdsl)
    component = check_cdsl(path, workspace, Report())
    occurrences: list[Occurrence] = []
    if component and file.tree.component:
        declared = component_symbol(component)
        occurrences.append(Occurrence(declared.span, declared, declares=True))
        visible = import_scope_of(file, workspace)
        for tree in file.tree.component.ports:
            occurrences += occurrences_of(tree.interface, visible, Interface)
        occurrences += _aliases(file.tree.component, component)
    return file.source, file.tree.complete, occurrences


def component_symbol(component: Component) -> Symbol:
    """The symbol of a component."""
    return Symbol(component.name, "component", component.span, component)


def port_symbol(port: Port, component: Component) -> Symbol:
    """The symbol of a port, at its alias or at the name of its interface."""
    return Symbol(port.name, "port", port.span, port, component.name)


def has_alias(port: Port, component: Component, workspace: Workspace) -> bool:
    """Whether `port` has an alias (`requires Laser as front`)."""
    declared = workspace.sources.parse(component.path, parse_cdsl).tree.component
    ports = declared.ports if declared else ()
    return any(tree.alias and tree.alias.span.start == port.span.start for tree in ports)


def import_scope_of(file: Parsed[ast.File], workspace: Workspace) -> ImportScope:
    """The declarations that are visible in a component."""
    workspace.modules.start_run(file.source.path)
    if file.tree.component:
        expanded = expand_options(file.tree, file.tree.component, Report())
        links = resolve_imports(expanded, workspace.modules, Report())
    else:
        links = workspace.modules.resolve_imports(file.tree.imports, Report())
    return workspace.modules.import_scope(file, links)


def _aliases(tree: ast.Component, component: Component) -> Iterator[Occurrence]:
    ports_by_offset = {port.span.start: port for port in component.ports}
    for declared_port in tree.ports:
        alias = declared_port.alias
        port = ports_by_offset.get(alias.span.start) if alias else None
        if port:
            symbol = port_symbol(port, component)
            yield Occurrence(symbol.span, symbol, declares=True)
