"""From the tree of an IDSL file to its modules, in which every name has become what it means.

In: the tree and what is visible in it. Out: `Module` values without the parts that could not be
understood; each of those has been reported, and what depends on it is left out in silence.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from robocomp_dsl.check import codes
from robocomp_dsl.check.literals import Misfit, OutOfRange, as_int, as_type
from robocomp_dsl.check.names import without_repeats
from robocomp_dsl.check.nesting import MAX_DEPTH, MAX_VALUES, Nesting
from robocomp_dsl.check.patterns import infer, response_index
from robocomp_dsl.check.type_names import TypeNames
from robocomp_dsl.check.visible import Visible
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.model import interface as model
from robocomp_dsl.model import types
from robocomp_dsl.record import Record
from robocomp_dsl.syntax import ast_idsl as ast
from robocomp_dsl.syntax.ast_base import Node, QualifiedName


class Resolved(Record):
    """A module, and for the rules: from what was written to what it became."""

    module: model.Module
    pairs: list[tuple[Node, object]]


def resolve_idsl(tree: ast.Module, path: Path, visible: Visible, report: Report) -> Resolved:
    """The module that `tree` describes."""
    return _Resolver(tree, visible, report).run(path)


class _Resolver:
    """Makes declarations on demand, so that they may stand in any order."""

    def __init__(self, tree: ast.Module, visible: Visible, report: Report) -> None:
        self._tree = tree
        self._visible = visible
        self._report = report
        written = without_repeats(tree.declarations, "declaration", report)
        self._written = {one.name.text: one for one in written}
        self._made: dict[str, types.Declaration | None] = {}
        self._open: dict[str, QualifiedName | None] = {}
        self._names = TypeNames(tree.name.text, self._written, self._own, visible, report)
        self._nesting = Nesting()
        self._pairs: list[tuple[Node, object]] = []

    def run(self, path: Path) -> Resolved:
        made = [self._declare(name, None) for name in self._written]
        module = model.Module(
            self._tree.name.text,
            path,
            self._tree.name.span,
            self._tree.doc,
            self._visible.direct,
            tuple(one for one in made if one is not None),
        )
        return Resolved(module, self._pairs)

    def _own(self, name: QualifiedName) -> types.Declaration | None:
        return self._declare(name.name.text, name)

    def _declare(self, name: str, use: QualifiedName | None) -> types.Declaration | None:
        if name in self._made:
            return self._made[name]
        if name in self._open:
            self._report_recursion(name, use)
            return None
        self._open[name] = use
        tree = self._written[name]
        made = self._make(tree) if len(self._open) <= MAX_DEPTH else None
        if len(self._open) > MAX_DEPTH or (made and self._nesting.is_excessive(made)):
            self._report.add(
                codes.EXCESSIVE_TYPE,
                tree.name.span,
                f"`{name}` nests deeper than {MAX_DEPTH} types or holds over {MAX_VALUES} values",
            )
            made = None
        del self._open[name]
        self._made[name] = made
        self._pairs.append((tree, made))
        return made

    def _make(self, tree: ast.Declaration) -> types.Declaration | None:
        head = (self._tree.name.text, tree.name.text, tree.name.span, tree.doc)
        match tree:
            case ast.Struct():
                return types.Struct(*head, self._fields(tree.fields))
            case ast.ExceptionDecl():
                return types.ExceptionType(*head, self._fields(tree.fields))
            case ast.Enum():
                return types.Enum(*head, self._enumerators(tree.enumerators))
            case ast.Sequence():
                element = self._names.data(tree.element)
                return types.Sequence(*head, element) if element else None
            case ast.Dictionary():
                key, value = self._names.data(tree.key), self._names.data(tree.value)
                return types.Dictionary(*head, key, value) if key and value else None
            case ast.Interface():
                return model.Interface(*head, self._operations(tree.operations))

    def _fields(self, trees: Sequence[ast.Field]) -> tuple[types.Field, ...]:
        found = (self._field(one) for one in without_repeats(trees, "field", self._report))
        return tuple(one for one in found if one is not None)

    def _field(self, tree: ast.Field) -> types.Field | None:
        type_ = self._names.data(tree.type)
        if type_ is None:
            return None
        unit = tree.unit.text if tree.unit else ""
        default = self._default(tree, type_)
        made = types.Field(tree.name.text, type_, tree.name.span, default, unit, tree.doc)
        self._pairs.append((tree, made))
        return made

    def _default(self, tree: ast.Field, type_: types.Type) -> types.Literal | None:
        if tree.default is None:
            return None
        try:
            return as_type(tree.default, type_)
        except Misfit as wrong:
            code = codes.DEFAULT_VALUE if isinstance(wrong, OutOfRange) else codes.DEFAULT_TYPE
            self._report.add(
                code,
                tree.default.span,
                f"the default of `{tree.name.text}` does not fit `{type_.name}`: {wrong}",
                label=wrong.label,
            )
            return None

    def _enumerators(self, trees: Sequence[ast.Enumerator]) -> tuple[types.Enumerator, ...]:
        made: list[types.Enumerator] = []
        following = 0
        for tree in without_repeats(trees, "enumerator", self._report):
            value = self._enum_value(tree, following)
            made.append(types.Enumerator(tree.name.text, value, tree.name.span, tree.doc))
            following = value + 1
        return tuple(made)

    def _enum_value(self, tree: ast.Enumerator, following: int) -> int:
        try:
            return following if tree.value is None else as_int(tree.value, types.INT.bits)
        except Misfit as wrong:
            span = tree.value.span if tree.value else tree.span
            self._report.add(
                codes.ENUM_VALUE, span, f"`{tree.name.text}` needs another value: {wrong}"
            )
            return following

    def _operations(self, trees: Sequence[ast.Operation]) -> tuple[model.Operation, ...]:
        return tuple(
            self._operation(one) for one in without_repeats(trees, "operation", self._report)
        )

    def _operation(self, tree: ast.Operation) -> model.Operation:
        mark = tree.pattern.text.lower() if tree.pattern else ""
        result = self._names.data(tree.result) if tree.result else None
        params = without_repeats(tree.params, "parameter", self._report)
        known = [(one, self._param(one)) for one in params]
        inputs = [param for one, param in known if param and not one.out]
        outputs = [param for one, param in known if param and one.out]
        throws = [found for one in tree.throws if (found := self._names.exception(one))]
        if not outputs and (at := response_index(mark, inputs, result)) is not None:
            outputs = [inputs.pop(at)]
        made = model.Operation(
            tree.name.text,
            tree.name.span,
            infer(mark, has_output=bool(tree.result or outputs or tree.throws)),
            tuple(inputs),
            tuple(outputs),
            result,
            tuple(dict.fromkeys(throws)),
            tree.idempotent,
            bool(mark),
            tree.doc,
        )
        self._pairs.append((tree, made))
        return made

    def _param(self, tree: ast.Param) -> model.Param | None:
        type_ = self._names.data(tree.type)
        unit = tree.unit.text if tree.unit else ""
        return model.Param(tree.name.text, type_, tree.name.span, unit) if type_ else None

    def _report_recursion(self, name: str, use: QualifiedName | None) -> None:
        chain = [*self._open][[*self._open].index(name) :]
        shown = " → ".join(f"`{one}`" for one in (*chain, name))
        uses = [self._open[one] for one in chain[1:]]
        self._report.add(
            codes.RECURSIVE_TYPE,
            use.span if use else self._written[name].name.span,
            f"`{name}` contains itself: {shown}",
            notes=[Note(one.span, f"`{one.text}` is used here") for one in uses if one],
            help="keep the elements in one sequence, and let them refer to each other by number",
        )
