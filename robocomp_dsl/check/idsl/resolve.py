"""Resolves the names in an IDSL module.

In: the tree and its import scope. Out: `Module` values. Faulty declarations are reported and left
out; declarations that depend on them are left out without a further diagnostic.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from robocomp_dsl.check.codes import types as codes
from robocomp_dsl.check.doc_comments import documentation_of, plain
from robocomp_dsl.check.idsl.inheritance import with_inherited
from robocomp_dsl.check.idsl.nesting import MAX_DEPTH, MAX_VALUES, Nesting
from robocomp_dsl.check.idsl.patterns import infer_pattern, response_index
from robocomp_dsl.check.idsl.ros_units import ROS_UNITS
from robocomp_dsl.check.idsl.units import holds_number
from robocomp_dsl.check.literals import OutOfRange, TypeMismatch, as_int, as_type
from robocomp_dsl.check.names.duplicates import unique_by_name
from robocomp_dsl.check.names.import_scope import ImportScope
from robocomp_dsl.check.names.type_names import TypeResolver
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model import interface as model
from robocomp_dsl.model import types
from robocomp_dsl.record import Record
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import idsl as ast
from robocomp_dsl.syntax.ast.base import Literal, Node, QualifiedName, Unit

NO_UNITS: Mapping[str, str] = {}


class ResolvedModule(Record):
    """A module, and pairs of tree node and resolved declaration for the rules."""

    module: model.Module
    pairs: list[tuple[Node, object]]


def resolve_idsl(
    tree: ast.Module, path: Path, visible: ImportScope, report: Report
) -> ResolvedModule:
    """Resolve the module of `tree`."""
    resolver = _Resolver(tree, visible, report)
    resolved = resolver.run(path)
    resolver.close()
    return resolved


class _Resolver:
    """Resolves declarations on demand, so that they may be in any order."""

    def __init__(self, tree: ast.Module, visible: ImportScope, report: Report) -> None:
        self._tree = tree
        self._scope = visible
        self._report = report
        written = unique_by_name(tree.declarations, "declaration", report)
        self._written = {node.name.text: node for node in written}
        self._declared: dict[str, types.Declaration | None] = {}
        self._open: dict[str, QualifiedName | None] = {}
        primitives = types.ROS_PRIMITIVES if tree.origin else types.PRIMITIVES
        self._names = TypeResolver(
            tree.name.text, self._written, self._own, visible, report, primitives
        )
        self._nesting = Nesting()
        self._pairs: list[tuple[Node, object]] = []

    def run(self, path: Path) -> ResolvedModule:
        declarations = [self._declare(name, None) for name in self._written]
        module = model.Module(
            self._tree.name.text,
            path,
            self._tree.name.span,
            plain(self._tree.doc),
            self._scope.direct,
            tuple(d for d in declarations if d is not None and not isinstance(d, types.Alias)),
            tuple(d for d in declarations if isinstance(d, types.Alias)),
            self._tree.origin,
        )
        return ResolvedModule(module, self._pairs)

    def close(self) -> None:
        """Break the cycle with the names, which would keep the trees until a garbage collection.

        An editor checks so often that the collections would take longer than the checks.
        """
        del self._names

    def _own(self, name: QualifiedName) -> types.Declaration | None:
        return self._declare(name.name.text, name)

    def _declare(self, name: str, use: QualifiedName | None) -> types.Declaration | None:
        if name in self._declared:
            return self._declared[name]
        if name in self._open:
            self._report_recursion(name, use)
            return None
        self._open[name] = use
        tree = self._written[name]
        declaration = self._build(tree) if len(self._open) <= MAX_DEPTH else None
        if len(self._open) > MAX_DEPTH or (declaration and self._nesting.is_excessive(declaration)):
            self._report.add(
                codes.EXCESSIVE_TYPE,
                tree.name.span,
                f"`{name}` nests deeper than {MAX_DEPTH} types or holds over {MAX_VALUES} values",
            )
            declaration = None
        del self._open[name]
        self._declared[name] = declaration
        self._pairs.append((tree, declaration))
        return declaration

    def _build(self, tree: ast.Declaration) -> types.Declaration | None:
        head = (
            self._tree.name.text,
            tree.name.text,
            tree.name.span,
            documentation_of(tree),
        )
        match tree:
            case ast.Struct():
                units = ROS_UNITS.get(tree.ros_name, {})
                fields = self._fields(tree.fields, tree.constants, units)
                constants = self._constants(tree.constants)
                text = _ros_definition(tree)
                return types.Struct(*head, fields, constants, tree.ros_name, text)
            case ast.ExceptionDecl():
                return types.ExceptionType(*head, self._fields(tree.fields))
            case ast.Enum():
                return types.Enum(*head, self._enumerators(tree.enumerators))
            case ast.Interface():
                return self._interface(tree, head)
        return self._build_of_others(tree, head)

    def _build_of_others(
        self,
        tree: ast.Sequence | ast.Dictionary | ast.Alias,
        head: tuple[str, str, Span, str],
    ) -> types.Declaration | None:
        """A declaration of one or two other types."""
        match tree:
            case ast.Dictionary():
                key, value = self._names.data(tree.key), self._names.data(tree.value)
                return types.Dictionary(*head, key, value) if key and value else None
            case ast.Sequence():
                element = self._names.data(tree.element)
                return types.Sequence(*head, element, bound=tree.bound) if element else None
            case ast.Alias():
                target = self._names.data(tree.target)
                return types.Alias(*head, target) if target else None

    def _fields(
        self,
        trees: Sequence[ast.Field],
        constants: Sequence[ast.Constant] = (),
        units: Mapping[str, str] = NO_UNITS,
    ) -> tuple[types.Field, ...]:
        members: tuple[ast.Field | ast.Constant, ...] = (*constants, *trees)
        unique = unique_by_name(members, "field", self._report)
        fields = (self._field(node, units) for node in unique if isinstance(node, ast.Field))
        return tuple(node for node in fields if node is not None)

    def _field(self, tree: ast.Field, units: Mapping[str, str]) -> types.Field | None:
        element = self._names.data(tree.type)
        if element is None:
            return None
        if tree.string_bound and isinstance(element, types.Primitive):
            element = element.replace(
                name=f"{element.name}<={tree.string_bound}", bound=tree.string_bound
            )
        default = self._literal(tree.default, element, f"the default of `{tree.name.text}`", tree)
        type_ = self._array(tree.array, element) if tree.array else element
        items = self._items(tree, element)
        unit = self._unit(tree.unit, type_) or units.get(tree.name.text, "")
        doc = documentation_of(tree)
        field = types.Field(tree.name.text, type_, tree.name.span, default, unit, doc, items)
        self._pairs.append((tree, field))
        return field

    def _array(self, tree: ast.Array, element: types.Type) -> types.Sequence:
        name = element.name if isinstance(element, types.Primitive) else element.qualified
        limit = f"<={tree.bound}" if tree.bound else str(tree.size or "")
        return types.Sequence(
            self._tree.name.text,
            f"{name}[{limit}]",
            tree.span,
            "",
            element,
            tree.size,
            tree.bound,
            is_anonymous=True,
        )

    def _items(self, tree: ast.Field, element: types.Type) -> tuple[types.Literal, ...]:
        """The default of an array, whose number of values must fit."""
        what = f"the default of `{tree.name.text}`"
        items = [self._literal(item, element, what) for item in tree.items]
        array, count = tree.array, len(items)
        if array and items and (count > (array.bound or count) or count != (array.size or count)):
            span = tree.items[0].span.cover(tree.items[-1].span)
            self._report.add(
                codes.DEFAULT_VALUE, span, f"{what} has {count} values for `{array.span.text}`"
            )
            return ()
        return tuple(item for item in items if item is not None)

    def _literal(
        self, tree: Literal | None, type_: types.Type, what: str, field: ast.Field | None = None
    ) -> types.Literal | None:
        if tree is None:
            return None
        written = type_.name
        if field and not field.string_bound and self._tree.origin in ("", "ros"):
            written = field.type.text
        try:
            return as_type(tree, type_)
        except TypeMismatch as wrong:
            code = codes.DEFAULT_VALUE if isinstance(wrong, OutOfRange) else codes.DEFAULT_TYPE
            self._report.add(
                code, tree.span, f"{what} does not fit `{written}`: {wrong}", label=wrong.label
            )
            return None

    def _constants(self, trees: Sequence[ast.Constant]) -> tuple[types.Constant, ...]:
        constants: dict[str, types.Constant] = {}
        for tree in trees:
            type_ = self._names.data(tree.type)
            if not isinstance(type_, types.Primitive):
                self._report.add(
                    codes.DEFAULT_TYPE,
                    tree.type.span,
                    f"the constant `{tree.name.text}` is not of a built-in type",
                )
                continue
            value = self._literal(tree.value, type_, f"the constant `{tree.name.text}`")
            if value is not None:
                constant = types.Constant(
                    tree.name.text, type_, value, tree.name.span, documentation_of(tree)
                )
                constants.setdefault(constant.name, constant)
        return tuple(constants.values())

    def _enumerators(self, trees: Sequence[ast.Enumerator]) -> tuple[types.Enumerator, ...]:
        enumerators: list[types.Enumerator] = []
        following = 0
        for tree in unique_by_name(trees, "enumerator", self._report):
            value = self._enum_value(tree, following)
            enumerators.append(
                types.Enumerator(tree.name.text, value, tree.name.span, documentation_of(tree))
            )
            following = value + 1
        return tuple(enumerators)

    def _enum_value(self, tree: ast.Enumerator, following: int) -> int:
        try:
            return following if tree.value is None else as_int(tree.value, types.INT.bits)
        except TypeMismatch as wrong:
            span = tree.value.span if tree.value else tree.span
            self._report.add(
                codes.ENUM_VALUE, span, f"`{tree.name.text}` has an invalid value: {wrong}"
            )
            return following

    def _interface(
        self, tree: ast.Interface, head: tuple[str, str, Span, str]
    ) -> model.Interface | None:
        style = "thrift" if self._tree.origin == "thrift" else ""
        base = self._names.interface(tree.base) if tree.base else None
        if tree.base and base is None:
            return None
        own = self._operations(tree.operations)
        operations = with_inherited(base, own, self._report) if base else own
        return model.Interface(*head, operations, style, base)

    def _operations(self, trees: Sequence[ast.Operation]) -> tuple[model.Operation, ...]:
        return tuple(
            self._operation(node) for node in unique_by_name(trees, "operation", self._report)
        )

    def _operation(self, tree: ast.Operation) -> model.Operation:
        mark = tree.pattern.text.lower() if tree.pattern else ""
        result = self._names.data(tree.result) if tree.result else None
        inputs: list[model.Param] = []
        outputs: list[model.Param] = []
        for node in unique_by_name(tree.params, "parameter", self._report):
            param = self._param(node)
            if param:
                (outputs if node.out else inputs).append(param)
        throws = [found for node in tree.throws if (found := self._names.exception(node))]
        if not outputs and (index := response_index(mark, inputs, result)) is not None:
            outputs = [inputs.pop(index)]
        operation = model.Operation(
            tree.name.text,
            tree.name.span,
            infer_pattern(mark, has_output=bool(tree.result or outputs or tree.throws)),
            tuple(inputs),
            tuple(outputs),
            result,
            tuple(dict.fromkeys(throws)),
            tree.idempotent,
            bool(mark),
            documentation_of(tree),
        )
        self._pairs.append((tree, operation))
        return operation

    def _param(self, tree: ast.Param) -> model.Param | None:
        type_ = self._names.data(tree.type)
        if type_ is None:
            return None
        default = None
        if tree.default is not None:
            default = self._literal(tree.default, type_, f"the default of `{tree.name.text}`")
        unit = self._unit(tree.unit, type_) if tree.unit else ""
        return model.Param(tree.name.text, type_, tree.name.span, unit, default)

    def _unit(self, tree: Unit | None, type_: types.Type) -> str:
        """The unit; the comment of an imported definition may mention one of something else."""
        if tree is None or (self._tree.origin and not holds_number(type_)):
            return ""
        return tree.text

    def _report_recursion(self, name: str, use: QualifiedName | None) -> None:
        chain = [*self._open][[*self._open].index(name) :]
        shown = " → ".join(f"`{node}`" for node in (*chain, name))
        uses = [self._open[node] for node in chain[1:]]
        is_interface = isinstance(self._written[name], ast.Interface)
        advice = "store the elements in one sequence, and refer to them by index"
        self._report.add(
            codes.RECURSIVE_TYPE,
            use.span if use else self._written[name].name.span,
            f"`{name}` {'extends' if is_interface else 'contains'} itself: {shown}",
            notes=[Note(node.span, f"`{node.text}` is used here") for node in uses if node],
            help="remove one `extends`" if is_interface else advice,
        )


def _ros_definition(tree: ast.Struct) -> str:
    """The statements of a ROS definition, if its md5 does not follow from its fields.

    A `#` in a constant of type string belongs to its value.
    """
    lines = [line.strip() for line in tree.span.text.splitlines()] if tree.ros_name else []
    texts = [x if re.match(r"string\s+\w+\s*=", x) else x.split("#")[0].strip() for x in lines]
    statements = [text for text in texts if text and not text.startswith("---")]
    needs_text = tree.constants or any(text.startswith("char") for text in statements)
    return "\n".join(statements) if needs_text else ""
