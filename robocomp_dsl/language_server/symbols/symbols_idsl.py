"""Indexer of IDSL files, and the symbols of their declarations."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from robocomp_dsl.check.names.import_scope import ImportScope
from robocomp_dsl.check.workspace.loaded import LoadedModule
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.language_server.symbols.symbol import Occurrence, Symbol
from robocomp_dsl.model import types
from robocomp_dsl.model.interface import Interface, Module, Operation
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.ast import idsl as ast
from robocomp_dsl.syntax.ast.base import Name, Node, QualifiedName

KINDS: dict[type, str] = {
    types.Struct: "struct",
    types.ExceptionType: "exception",
    types.Enum: "enum",
    types.Sequence: "sequence",
    types.Dictionary: "dictionary",
    types.Alias: "typedef",
    Interface: "interface",
}


def index_file(path: Path, workspace: Workspace) -> tuple[Source, bool, list[Occurrence]]:
    """The occurrences in the file at `path`. Raises `UnreadableSource`."""
    workspace.modules.start_run(path)
    loaded = workspace.modules.load(path)
    visible = workspace.modules.import_scope(loaded.parsed, loaded.imports, loaded.modules)
    occurrences = [
        Occurrence(s.span, s, declares=True) for m in loaded.modules for s in module_symbols(m)
    ]
    declared = {o.span for o in occurrences}
    for tree in loaded.parsed.tree.modules:
        for name in qualified_names(tree):
            found = occurrences_of(name, visible, types.Declaration, loaded)
            # Thrift's `list<T>` is declared where it is first used.
            occurrences += (o for o in found if o.span not in declared)
    occurrences += _default_occurrences(loaded)
    return loaded.parsed.source, loaded.parsed.tree.complete, occurrences


def declaration_symbol(declaration: types.Declaration) -> Symbol:
    """The symbol of a declaration."""
    kind = KINDS[type(declaration)]
    return Symbol(declaration.name, kind, declaration.span, declaration, declaration.module)


def module_symbols(module: Module) -> Iterator[Symbol]:
    """The symbols of `module` and of all declarations in it, down to parameters."""
    yield Symbol(module.name, "module", module.span, module)
    for declaration in (*module.declarations, *module.aliases):
        yield declaration_symbol(declaration)
        yield from _member_symbols(declaration)


def _member_symbols(declaration: types.Declaration) -> Iterator[Symbol]:
    container = declaration.name
    match declaration:
        case types.Struct() | types.ExceptionType():
            for field in declaration.fields:
                yield Symbol(field.name, "field", field.span, field, container)
            constants = declaration.constants if isinstance(declaration, types.Struct) else ()
            for constant in constants:
                yield Symbol(constant.name, "constant", constant.span, constant, container)
        case types.Enum():
            for value in declaration.enumerators:
                yield Symbol(value.name, "enumerator", value.span, value, container)
        case Interface():
            for operation in declaration.own_operations:
                yield Symbol(operation.name, "operation", operation.span, operation, container)
                yield from _parameter_symbols(operation)


def _parameter_symbols(operation: Operation) -> Iterator[Symbol]:
    for parameter in (*operation.inputs, *operation.outputs):
        # A parameter without a name (legacy syntax) has the span of its type.
        if parameter.span.text == parameter.name:
            yield Symbol(parameter.name, "parameter", parameter.span, parameter, operation.name)


def qualified_names(node: Node) -> Iterator[QualifiedName]:
    """Every `Name` or `Module::Name` in a tree."""
    if isinstance(node, QualifiedName):
        yield node
        return
    fields: tuple[str, ...] = type(node).__match_args__
    for field in fields:
        value = getattr(node, field)
        for child in value if isinstance(value, tuple) else (value,):
            if isinstance(child, Node):
                yield from qualified_names(child)


def occurrences_of(
    name: QualifiedName,
    visible: ImportScope,
    kind: type[types.Declaration],
    here: LoadedModule | None = None,
) -> Iterator[Occurrence]:
    """The occurrence of a declaration, and that of its module if the name is qualified."""
    matches = visible.lookup(name, kind)
    own = [match for match in matches if here and match.span.source is here.parsed.source]
    in_own_file = [match for match in matches if match.span.source.path.stem == match.name]
    best: Sequence[types.Declaration] = own or in_own_file or matches
    if not best:
        return
    if name.module and name.module.span.start != name.name.span.start:
        direct = (module for module in visible.direct if best[0] in module.declarations)
        indirect = (m for d in visible.direct for m in d.closure() if best[0] in m.declarations)
        module = next(direct, None) or next(indirect, None)
        if module:
            yield Occurrence(name.module.span, Symbol(module.name, "module", module.span, module))
    yield Occurrence(name.name.span, declaration_symbol(best[0]))


def _default_occurrences(loaded: LoadedModule) -> Iterator[Occurrence]:
    """The enumerators that are defaults of fields."""
    objects = {s.span.start: s.model_object for m in loaded.modules for s in module_symbols(m)}
    for module in loaded.parsed.tree.modules:
        for declaration in module.declarations:
            if not isinstance(declaration, ast.Struct | ast.ExceptionDecl):
                continue
            for field in declaration.fields:
                yield from _default_occurrence(field, objects.get(field.name.span.start))


def _default_occurrence(tree: ast.Field, field: object) -> Iterator[Occurrence]:
    if not (isinstance(tree.default, Name) and isinstance(field, types.Field)):
        return
    if isinstance(field.type, types.Enum):
        for value in field.type.enumerators:
            if value.name == tree.default.text:
                symbol = Symbol(value.name, "enumerator", value.span, value, field.type.name)
                yield Occurrence(tree.default.span, symbol)
