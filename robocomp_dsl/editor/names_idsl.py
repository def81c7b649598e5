"""The names in an IDSL file, and symbols for everything that such a file declares."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from robocomp_dsl.check.loaded import Loaded
from robocomp_dsl.check.visible import Visible
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.editor.index import Mention, Symbol
from robocomp_dsl.model import types
from robocomp_dsl.model.interface import Interface, Module, Operation
from robocomp_dsl.source import Source
from robocomp_dsl.syntax import ast_idsl as ast
from robocomp_dsl.syntax.ast_base import Name, Node, QualifiedName

KINDS: dict[type, str] = {
    types.Struct: "struct",
    types.ExceptionType: "exception",
    types.Enum: "enum",
    types.Sequence: "sequence",
    types.Dictionary: "dictionary",
    Interface: "interface",
}


def read(path: Path, workspace: Workspace) -> tuple[Source, bool, list[Mention]]:
    """The names in the file at `path`. Raises `UnreadableSource`."""
    workspace.library.begin(path)
    loaded = workspace.library.load(path)
    visible = workspace.library.visible(loaded.parsed, loaded.links, loaded.modules)
    mentions = [Mention(s.span, s, declares=True) for m in loaded.modules for s in symbols(m)]
    for tree in loaded.parsed.tree.modules:
        for name in qualified_names(tree):
            mentions += mentions_of(name, visible, types.Declaration, loaded)
    mentions += _defaults(loaded)
    return loaded.parsed.source, loaded.parsed.tree.complete, mentions


def symbol(declaration: types.Declaration) -> Symbol:
    """The symbol of a declaration."""
    kind = KINDS[type(declaration)]
    return Symbol(declaration.name, kind, declaration.span, declaration, declaration.module)


def symbols(module: Module) -> Iterator[Symbol]:
    """Everything that `module` declares, from itself to its parameters."""
    yield Symbol(module.name, "module", module.span, module)
    for one in module.declarations:
        yield symbol(one)
        yield from _members(one)


def _members(one: types.Declaration) -> Iterator[Symbol]:
    match one:
        case types.Struct() | types.ExceptionType():
            for field in one.fields:
                yield Symbol(field.name, "field", field.span, field, one.name)
        case types.Enum():
            for value in one.enumerators:
                yield Symbol(value.name, "enumerator", value.span, value, one.name)
        case Interface():
            for operation in one.operations:
                yield Symbol(operation.name, "operation", operation.span, operation, one.name)
                yield from _parameters(operation)


def _parameters(operation: Operation) -> Iterator[Symbol]:
    for one in (*operation.inputs, *operation.outputs):
        # A parameter without a name (a legacy form) stands for its type.
        if one.span.text == one.name:
            yield Symbol(one.name, "parameter", one.span, one, operation.name)


def qualified_names(node: Node) -> Iterator[QualifiedName]:
    """Every `Name` or `Module::Name` in a tree."""
    if isinstance(node, QualifiedName):
        yield node
        return
    fields: tuple[str, ...] = type(node).__match_args__
    for field in fields:
        value = getattr(node, field)
        for one in value if isinstance(value, tuple) else (value,):
            if isinstance(one, Node):
                yield from qualified_names(one)


def mentions_of(
    name: QualifiedName, visible: Visible, kind: type[types.Declaration], here: Loaded | None = None
) -> Iterator[Mention]:
    """The mention of a declaration, and that of its module if it is written."""
    found = visible.find(name, kind)
    own = [one for one in found if here and one.span.source is here.parsed.source]
    named = [one for one in found if one.span.source.path.stem == one.name]
    best: Sequence[types.Declaration] = own or named or found
    if not best:
        return
    if name.module and name.module.span.start != name.name.span.start:
        modules = (one for one in visible.direct if best[0] in one.declarations)
        behind = (m for one in visible.direct for m in one.closure() if best[0] in m.declarations)
        module = next(modules, None) or next(behind, None)
        if module:
            yield Mention(name.module.span, Symbol(module.name, "module", module.span, module))
    yield Mention(name.name.span, symbol(best[0]))


def _defaults(loaded: Loaded) -> Iterator[Mention]:
    """Enumerators that fields begin with."""
    made = {s.span.start: s.thing for m in loaded.modules for s in symbols(m)}
    for module in loaded.parsed.tree.modules:
        for one in module.declarations:
            if not isinstance(one, ast.Struct | ast.ExceptionDecl):
                continue
            for field in one.fields:
                yield from _default(field, made.get(field.name.span.start))


def _default(tree: ast.Field, field: object) -> Iterator[Mention]:
    if not (isinstance(tree.default, Name) and isinstance(field, types.Field)):
        return
    if isinstance(field.type, types.Enum):
        for value in field.type.enumerators:
            if value.name == tree.default.text:
                found = Symbol(value.name, "enumerator", value.span, value, field.type.name)
                yield Mention(tree.default.span, found)
