"""The names in a DDSL file: instances, hosts, the components, ports and parameters behind them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from robocomp_dsl.check import check_cdsl, check_ddsl
from robocomp_dsl.check.components import imported_components
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.editor.index import Mention, Symbol
from robocomp_dsl.editor.names_cdsl import has_alias, port_symbol
from robocomp_dsl.editor.names_cdsl import symbol as component_symbol
from robocomp_dsl.editor.names_idsl import symbol as declaration_symbol
from robocomp_dsl.editor.names_pdsl import symbol as parameter_symbol
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.parameter import Parameter
from robocomp_dsl.source import Source
from robocomp_dsl.syntax import ast_ddsl as ast
from robocomp_dsl.syntax import parse_ddsl
from robocomp_dsl.syntax.ast_base import Name

_PART = re.compile(r"[A-Za-z_]\w*")


def read(path: Path, workspace: Workspace) -> tuple[Source, bool, list[Mention]]:
    """The names in the file at `path`. Raises `UnreadableSource`."""
    file = workspace.files.parse(path, parse_ddsl)
    tree = file.tree.deployment
    if tree is None:
        return file.source, file.tree.complete, []
    imported = imported_components(file.tree.imports, path, workspace, check_cdsl, Report())
    deployment = check_ddsl(path, workspace, Report())
    things: dict[int, object] = {}
    if deployment:
        things = {one.span.start: one for one in deployment.instances}
        things |= {one.span.start: one for one in deployment.hosts if one.span}
    place = Symbol(tree.name.text, "deployment", tree.name.span, deployment)
    names = _Names(imported.components, things, tree.name.text, workspace)
    mentions = [Mention(place.span, place, declares=True), *names.of_hosts(tree)]
    mentions += names.of_block(tree)
    return file.source, file.tree.complete, mentions


class _Names:
    """`things` are the instances and hosts of the model by the offset of their names."""

    def __init__(
        self,
        components: Mapping[str, Component],
        things: Mapping[int, object],
        container: str,
        workspace: Workspace,
    ) -> None:
        self._components = components
        self._things = things
        self._container = container
        self._workspace = workspace
        self._hosts: dict[str, Symbol] = {}

    def of_hosts(self, tree: ast.Deployment) -> Iterator[Mention]:
        """The hosts, which groups use, too."""
        for one in tree.hosts:
            self._hosts[one.name.text] = self._symbol(one.name, "host")
            yield Mention(one.name.span, self._hosts[one.name.text], declares=True)

    def of_block(self, tree: ast.Deployment | ast.Group) -> Iterator[Mention]:
        """Everything in a deployment or a group."""
        instances = {one.name.text: self._symbol(one.name, "instance") for one in tree.instances}
        for group in tree.groups:
            instances[group.name.text] = self._symbol(group.name, "group")
            yield Mention(group.name.span, instances[group.name.text], declares=True)
            yield from self.of_block(group)
        kinds = {one.name.text: (one.component or one.name).text for one in tree.instances}
        for one in tree.instances:
            yield from self._instance(one, instances)
        ends = [end for one in tree.connections for end in (one.source, one.target)]
        if isinstance(tree, ast.Group):
            ends += [one.target for one in tree.exports]
        for end in ends:
            yield from _known(end.instance, instances)
            component = self._components.get(kinds.get(end.instance.text, ""))
            if component:
                yield from _port(end.port, component, self._workspace)

    def _symbol(self, name: Name, kind: str) -> Symbol:
        thing = self._things.get(name.span.start)
        return Symbol(name.text, kind, name.span, thing, self._container)

    def _instance(self, tree: ast.Instance, known: Mapping[str, Symbol]) -> Iterator[Mention]:
        own, name = tree.name.text, tree.component or tree.name
        component = self._components.get(name.text)
        short = component is not None and tree.component is None
        if component:
            form = f"{own} : {{}}" if short else "{}"
            yield Mention(name.span, component_symbol(component), form=form)
        form = f"{{}} : {own}" if short else "{}"
        yield Mention(tree.name.span, known[own], declares=True, form=form)
        if tree.host:
            yield from _known(tree.host, self._hosts)
        for one in tree.after:
            yield from _known(one, known)
        if component and component.parameters:
            for setting in tree.settings:
                yield from _key(setting.key, component.parameters.parameters, component.name)


def _known(name: Name, symbols: Mapping[str, Symbol]) -> Iterator[Mention]:
    if name.text in symbols:
        yield Mention(name.span, symbols[name.text])


def _port(name: Name, component: Component, workspace: Workspace) -> Iterator[Mention]:
    port = next((one for one in component.ports if one.name == name.text), None)
    if port is None:
        return
    nearer = port_symbol(port, component)
    if has_alias(port, component, workspace):
        yield Mention(name.span, nearer)
    else:
        # `Laser1` is the second port of `Laser`: a renaming keeps the number.
        form = f"{{}}{name.text.removeprefix(port.interface.name)}"
        yield Mention(name.span, declaration_symbol(port.interface), form=form, nearer=nearer)


def _key(name: Name, parameters: Sequence[Parameter], container: str) -> Iterator[Mention]:
    """The parts of `motors[2].min`, as far as they are known."""
    for part in _PART.finditer(name.span.text):
        found = next((one for one in parameters if one.name == part[0]), None)
        if found is None:
            return
        start = name.span.start + part.start()
        span = name.span.source.span(start, start + len(part[0]))
        yield Mention(span, parameter_symbol(found, container))
        parameters, container = found.members, found.name
