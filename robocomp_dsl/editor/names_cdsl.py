"""The names in a CDSL file: the component, the interfaces of its ports, their own names."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from robocomp_dsl.check import check_cdsl
from robocomp_dsl.check.files import Parsed
from robocomp_dsl.check.options import expand
from robocomp_dsl.check.visible import Visible
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.editor.index import Mention, Symbol
from robocomp_dsl.editor.names_idsl import mentions_of
from robocomp_dsl.model.component import Component, Port
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.source import Source
from robocomp_dsl.syntax import ast_cdsl as ast
from robocomp_dsl.syntax import parse_cdsl


def read(path: Path, workspace: Workspace) -> tuple[Source, bool, list[Mention]]:
    """The names in the file at `path`. Raises `UnreadableSource`."""
    file = workspace.files.parse(path, parse_cdsl)
    component = check_cdsl(path, workspace, Report())
    mentions: list[Mention] = []
    if component and file.tree.component:
        declared = symbol(component)
        mentions.append(Mention(declared.span, declared, declares=True))
        visible = visible_in(file, workspace)
        for tree in file.tree.component.ports:
            mentions += mentions_of(tree.interface, visible, Interface)
        mentions += _aliases(file.tree.component, component)
    return file.source, file.tree.complete, mentions


def symbol(component: Component) -> Symbol:
    """The symbol of a component."""
    return Symbol(component.name, "component", component.span, component)


def port_symbol(port: Port, component: Component) -> Symbol:
    """The symbol of a port: its own name, or the place where its interface is named."""
    return Symbol(port.name, "port", port.span, port, component.name)


def has_alias(port: Port, component: Component, workspace: Workspace) -> bool:
    """Whether `port` was given a name (`requires Laser as front`)."""
    tree = workspace.files.parse(component.path, parse_cdsl).tree.component
    ports = tree.ports if tree else ()
    return any(one.alias and one.alias.span.start == port.span.start for one in ports)


def visible_in(file: Parsed[ast.File], workspace: Workspace) -> Visible:
    """What names can mean in a component."""
    workspace.library.begin(file.source.path)
    imports = file.tree.imports
    if file.tree.component:
        imports = expand(file.tree, file.tree.component, Report()).imports
    return workspace.library.visible(file, workspace.library.links(imports, Report()))


def _aliases(tree: ast.Component, component: Component) -> Iterator[Mention]:
    made = {port.span.start: port for port in component.ports}
    for one in tree.ports:
        port = made.get(one.alias.span.start) if one.alias else None
        if port:
            declared = port_symbol(port, component)
            yield Mention(declared.span, declared, declares=True)
