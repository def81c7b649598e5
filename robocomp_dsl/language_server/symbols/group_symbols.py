"""What names of groups mean in the editor: definitions, exports, and components in keys of `set`.

In: the groups of a file, and the definitions that are visible in it. Out: symbols, which may be in
imported files.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TypeAlias

from robocomp_dsl.check.ddsl.definitions import DefinitionFiles
from robocomp_dsl.language_server.symbols.symbol import Occurrence, Symbol
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.parameter import Parameter
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Name

_NAME = re.compile(r"[A-Za-z_]\w*")
ExportTarget: TypeAlias = "Symbol | tuple[Name, Component] | None"


def group_symbol(group: ast.Group, container: str = "") -> Symbol:
    """The symbol of a group or of a definition."""
    return Symbol(group.name.text, "group", group.name.span, group, container)


class GroupSymbols:
    """Looks names up in groups and their definitions."""

    def __init__(self, definitions: DefinitionFiles) -> None:
        self._definitions = definitions

    def definition_of(self, group: ast.Group) -> ast.Group | None:
        """The definition that an instance names."""
        return self._definitions.find(group)

    def of_definition_name(self, group: ast.Group) -> Iterator[Occurrence]:
        """The name of the definition in `group left : arm;`."""
        definition = self.definition_of(group)
        if definition is not None and group.definition is not None:
            yield Occurrence(group.definition.span, group_symbol(definition))

    def expanded(self, group: ast.Group) -> ast.Group:
        """The group whose items an instance has: its definition, or that of its definition."""
        seen: list[ast.Group] = []
        while (following := self.definition_of(group)) is not None and following not in seen:
            seen.append(following)
            group = following
        return group

    def component_of(self, instance: ast.Instance) -> Component | None:
        """The component of an instance, also of one in an imported file."""
        name = instance.component or instance.name
        known = self._definitions.components_of(instance).components
        return None if instance.is_program else known.get(name.text)

    def target_of_export(self, group: ast.Group, port: str) -> ExportTarget:
        """What `port` of a group means: a symbol if it was renamed, else the port of a component.

        The port is its name in the component.
        """
        inside = self.expanded(group)
        export = next((each for each in inside.exports if each.port.text == port), None)
        if export is None:
            return None
        if export.port is not export.target.port:
            name = export.port
            return Symbol(name.text, "export", name.span, None, inside.name.text)
        owner = export.target.instance.text
        for instance in inside.instances:
            if instance.name.text == owner and (component := self.component_of(instance)):
                return export.target.port, component
        nested = next((each for each in inside.groups if each.name.text == owner), None)
        return self.target_of_export(nested, export.target.port.text) if nested else None

    def of_key(self, group: ast.Group, key: Name) -> Iterator[Occurrence | KeyRest]:
        """The members that a key of `set` names, then the parameters in it."""
        block, component = self.expanded(group), None
        for part in _NAME.finditer(key.span.text):
            start = key.span.start + part.start()
            if component is not None:
                if component.parameters:
                    rest = key.span.subspan(start, key.span.end)
                    yield KeyRest(rest, component.parameters.parameters, component.name)
                return
            span = key.span.subspan(start, start + len(part[0]))
            members = {i.name.text: i for i in block.instances}
            nested = next((each for each in block.groups if each.name.text == part[0]), None)
            if part[0] in members:
                member = members[part[0]]
                yield Occurrence(span, Symbol(part[0], "instance", member.name.span, None))
                component = self.component_of(member)
                if component is None:
                    return
            elif nested is not None:
                yield Occurrence(span, group_symbol(nested))
                block = self.expanded(nested)
            else:
                return


class KeyRest:
    """The part of a key that names parameters."""

    def __init__(self, span: Span, parameters: tuple[Parameter, ...], container: str) -> None:
        self.name = Name(span, span.text)
        self.parameters = parameters
        self.container = container
