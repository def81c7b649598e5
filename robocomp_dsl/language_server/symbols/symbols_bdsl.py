"""Indexer of BDSL files: inputs, hubs, functions, outputs, services, calls, types and fields."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Protocol

from robocomp_dsl.check.names.import_scope import ImportScope
from robocomp_dsl.check.passes import check_bdsl
from robocomp_dsl.check.workspace.source_cache import Parsed
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.language_server.symbols.bridge_declarations import (
    BridgeDeclarations,
)
from robocomp_dsl.language_server.symbols.bridge_occurrences import (
    enumerators,
    member_occurrence,
    occurrence_of,
    operation_occurrence,
)
from robocomp_dsl.language_server.symbols.bridge_types import (
    BridgeMember,
    DeclaredTypes,
    members_of,
)
from robocomp_dsl.language_server.symbols.symbol import Occurrence, Symbol
from robocomp_dsl.language_server.symbols.symbols_idsl import declaration_symbol, occurrences_of
from robocomp_dsl.model import types
from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.model.interface import Interface, Param
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.ast import bdsl as ast
from robocomp_dsl.syntax.ast.base import Name, Node, QualifiedName
from robocomp_dsl.syntax.languages.bdsl_expressions import operands
from robocomp_dsl.syntax.parse import parse_bdsl


class Check(Protocol):
    """The result of a check: the model and the tree of one version of a file."""

    @property
    def model(self) -> object:
        """The model, or None."""

    @property
    def tree(self) -> object:
        """The tree."""


def index_file(path: Path, workspace: Workspace) -> tuple[Source, bool, list[Occurrence]]:
    """The occurrences in the file at `path`. Raises `UnreadableSource`."""
    file = workspace.sources.parse(path, parse_bdsl)
    tree = file.tree.bridge
    if tree is None:
        return file.source, file.tree.complete, []
    bridge = check_bdsl(path, workspace, Report())
    collector = _OccurrenceCollector(tree, bridge, import_scope_of(file, workspace))
    return file.source, file.tree.complete, list(collector)


def import_scope_of(file: Parsed[ast.File], workspace: Workspace) -> ImportScope:
    """The declarations that are visible in a bridge."""
    workspace.modules.start_run(file.source.path)
    links = workspace.modules.resolve_imports(file.tree.imports, Report())
    return workspace.modules.import_scope(file, links)


def bridge_names(checks: Sequence[Check], path: Path, workspace: Workspace) -> BridgeDeclarations:
    """The names of some versions of the file at `path`. Raises `UnreadableSource`."""
    models = [check.model for check in checks]
    trees = [check.tree for check in checks]
    file = workspace.sources.parse(path, parse_bdsl)
    return BridgeDeclarations(
        [model for model in models if isinstance(model, Bridge)],
        [tree.bridge for tree in trees if isinstance(tree, ast.File) and tree.bridge],
        DeclaredTypes(import_scope_of(file, workspace)),
    )


class _OccurrenceCollector:
    """All names of a bridge, in any order."""

    def __init__(self, tree: ast.Bridge, bridge: Bridge | None, scope: ImportScope) -> None:
        self._tree = tree
        self._bridge = bridge
        self._types = DeclaredTypes(scope)
        self._names = BridgeDeclarations([bridge] if bridge else [], [tree], self._types)
        self._scope = scope
        self._values: dict[str, Symbol] = {}
        self._functions: dict[str, Symbol] = {}
        self._own_models = _own_models(bridge) if bridge else {}

    def __iter__(self) -> Iterator[Occurrence]:
        tree = self._tree
        yield self._declared(tree.name, "bridge", self._bridge, container="")
        yield from self._declarations()
        for node in tree.inputs:
            yield from self._type(node.type)
            if node.stamp:
                yield from self._path(node.stamp, self._types.message(node.type))
        for function in tree.functions:
            yield from self._fields(function.parameters, function.name.text, "parameter")
            yield from self._type(function.result)
        for hub in tree.hubs:
            for value in hub.values:
                yield from self._expression(value)
        for output in tree.outputs:
            yield from self._output(output)
        for service in tree.services:
            yield from self._service(service)
        for action in tree.actions:
            yield from self._action(action)
        if self._bridge:
            yield from enumerators(self._bridge)

    def _declarations(self) -> Iterator[Occurrence]:
        """The names that expressions refer to, and the outputs and services."""
        tree, names = self._tree, self._names
        values, functions = names.values(), names.functions()
        declared = [(node.name, "input") for node in tree.inputs]
        declared += [(node.name, "hub") for node in tree.hubs]
        for name, kind in declared:
            found = self._declared(name, kind, values.get(name.text))
            self._values.setdefault(name.text, found.symbol)
            yield found
        for function in tree.functions:
            model = functions.get(function.name.text)
            found = self._declared(function.name, "function", model)
            self._functions.setdefault(function.name.text, found.symbol)
            yield found
        for output in tree.outputs:
            yield self._declared(output.name, "output", names.outputs().get(output.name.text))
        for service in tree.services:
            yield self._declared(service.name, "service", names.services().get(service.name.text))

    def _declared(
        self, name: Name, kind: str, model: object, container: str | None = None
    ) -> Occurrence:
        inside = self._tree.name.text if container is None else container
        return Occurrence(
            name.span, Symbol(name.text, kind, name.span, model, inside), declares=True
        )

    def _output(self, output: ast.Output) -> Iterator[Occurrence]:
        if output.type:
            yield from self._type(output.type)
        if output.value:
            yield from self._expression(output.value)
        members = self._types.message(output.type) if output.type else ()
        for field in output.fields:
            yield from self._expression(field.value)
            if isinstance(field, ast.Assignment):
                yield from self._path(field.path, members)

    def _service(self, service: ast.Service) -> Iterator[Occurrence]:
        own = service.name.text
        yield from self._type(service.type)
        calls: dict[str, Symbol] = {}
        models = self._names.calls(own)
        for call in service.calls:
            yield from self._type(call.type)
            model = models.get(call.name.text)
            for assignment in call.fields:
                yield from self._expression(assignment.value, own, calls)
                yield from self._path(assignment.path, self._types.request(call.type))
            found = self._declared(call.name, "call", model, f"{self._tree.name.text}.{own}")
            calls.setdefault(call.name.text, found.symbol)
            yield found
        reply = self._types.reply(service.type)
        for assignment in service.fields:
            yield from self._expression(assignment.value, own, calls)
            yield from self._path(assignment.path, reply)

    def _action(self, action: ast.Action) -> Iterator[Occurrence]:
        own, inside = action.name.text, f"{self._tree.name.text}.{action.name.text}"
        model = self._names.actions().get(own)
        yield self._declared(action.name, "action", model)
        yield from self._ros_type(action.type.name, "Goal")
        values: dict[str, Symbol] = {}
        for state in action.states:
            found = self._declared(state.name, "input", None, inside)
            values.setdefault(state.name.text, found.symbol)
            yield found
            yield from self._type(state.type)
        for command in action.commands:
            yield self._declared(command.name, "output", None, inside)
            if command.type:
                yield from self._type(command.type)
            members = self._types.message(command.type) if command.type else ()
            for field in command.fields:
                yield from self._expression(field.value, own, values)
                if isinstance(field, ast.Assignment):
                    yield from self._path(field.path, members)
        for assignment in action.fields:
            yield from self._expression(assignment.value, own, values)
            path = assignment.path.replace(parts=assignment.path.parts[1:])
            part = assignment.path.parts[0].name.text.capitalize()
            yield from self._path(path, self._types.action_part(action.type, part))
        for condition in (*action.succeed, *action.abort):
            for comparison in condition.comparisons:
                for side in filter(None, (comparison.left, comparison.right)):
                    yield from self._expression(side, own, values)

    def _expression(
        self, tree: Node, service: str = "", calls: dict[str, Symbol] | None = None
    ) -> Iterator[Occurrence]:
        """The names in an expression; `calls` are those of the `service` so far."""
        todo = [tree]
        values = self._values if calls is None else calls
        while todo:
            node = todo.pop()
            if isinstance(node, ast.Reference) and node.name.text in values:
                yield Occurrence(node.name.span, values[node.name.text])
            elif isinstance(node, ast.FunctionCall) and node.name.text in self._functions:
                yield Occurrence(node.name.span, self._functions[node.name.text])
            elif isinstance(node, ast.Member):
                owner = self._names.resolve(node.value, service)
                yield from member_occurrence(node.name, members_of(owner))
            todo += operands(node)

    def _path(self, path: ast.Path, members: Iterable[BridgeMember]) -> Iterator[Occurrence]:
        """The fields of a path, up to the first unknown one."""
        for part in path.parts:
            member = next((m for m in members if m.name == part.name.text), None)
            if member is None:
                return
            yield occurrence_of(part.name, member)
            owner = member.type
            if part.index is not None and isinstance(owner, types.Sequence):
                owner = owner.element
            members = members_of(owner)

    def _fields(
        self, fields: Sequence[ast.ShapeField], container: str, kind: str
    ) -> Iterator[Occurrence]:
        for field in fields:
            model = self._own_models.get(field.name.span.start)
            symbol = Symbol(field.name.text, kind, field.name.span, model, container)
            yield Occurrence(symbol.span, symbol, declares=True)
            yield from self._type(field.type)

    def _type(self, tree: ast.TypeRef) -> Iterator[Occurrence]:
        if tree.shape is not None:
            yield from self._fields(tree.shape, "", "field")
        elif tree.name and tree.operation:
            found = list(occurrences_of(tree.name, self._scope, Interface))
            yield from found
            interface = found[-1].symbol.model_object if found else None
            if isinstance(interface, Interface):
                yield from operation_occurrence(tree.operation, interface)
        elif tree.name:
            found = list(occurrences_of(tree.name, self._scope, types.Declaration))
            yield from found or self._ros_type(tree.name, "Request")

    def _ros_type(self, name: QualifiedName | None, part: str) -> Iterator[Occurrence]:
        """The request of a ROS service or the goal of an action, which is no declaration itself."""
        if name is None:
            return
        request = Name(name.name.span, f"{name.name.text}_{part}")
        found = self._scope.lookup(QualifiedName(name.span, request, name.module), types.Struct)
        for struct in found[:1]:
            yield Occurrence(name.name.span, declaration_symbol(struct))


def _own_models(bridge: Bridge) -> dict[int, object]:
    """The fields of inline types and the parameters of functions, by their offset in the file."""
    declarations = bridge.types.declarations if bridge.types else ()
    structs = [d for d in declarations if isinstance(d, types.Struct)]
    declared: list[types.Field | Param] = [field for struct in structs for field in struct.fields]
    declared += [parameter for function in bridge.functions for parameter in function.parameters]
    return {item.span.start: item for item in declared}
