"""Hubs: the concatenation of values, with a policy.

In: the tree nodes of all hubs. Out: `BridgeHub` values, resolved on demand, so that they may be in
any order.
"""

from __future__ import annotations

from collections.abc import Iterable

from robocomp_dsl.check.bdsl.context import BridgeContext, FaultyExpression
from robocomp_dsl.check.bdsl.expressions import typed
from robocomp_dsl.check.bdsl.items import joined_type, struct_items, with_count
from robocomp_dsl.check.bdsl.scopes import BridgeScope
from robocomp_dsl.check.bdsl.units import convert, parsed
from robocomp_dsl.check.codes import bridge as codes
from robocomp_dsl.check.codes import bridge_values as value_codes
from robocomp_dsl.diagnostics import Note
from robocomp_dsl.model.bridge_ports import BridgeInput, ItemsType
from robocomp_dsl.model.bridge_values import (
    BridgeHub,
    Expression,
    HubPolicy,
    HubValue,
    InputValue,
    ListExpression,
)
from robocomp_dsl.model.types import Struct
from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import bdsl as ast
from robocomp_dsl.syntax.ast.base import Duration, Name

_LONGEST_S = 24 * 60 * 60.0


class HubResolver:
    """Resolves the hubs of a bridge."""

    def __init__(self, trees: Iterable[ast.Hub], context: BridgeContext) -> None:
        self._trees = {tree.name.text: tree for tree in trees}
        self._context = context
        self._open: list[tuple[str, Name]] = []
        context.hubs |= dict.fromkeys(self._trees)
        self._done: set[str] = set()

    def resolve_all(self) -> tuple[BridgeHub, ...]:
        """All valid hubs, in order of writing."""
        hubs = [self._resolve(name, tree.name) for name, tree in self._trees.items()]
        return tuple(hub for hub in hubs if hub is not None)

    def find(self, name: Name) -> BridgeHub | None:
        """The hub that `name` refers to; None if it is faulty."""
        return self._resolve(name.text, name)

    def _resolve(self, name: str, use: Name) -> BridgeHub | None:
        if name in self._done:
            return self._context.hubs[name]
        open_names = [entry for entry, _ in self._open]
        if name in open_names:
            self._report_cycle(open_names.index(name), use)
            return None
        self._open.append((name, use))
        hub = self._build(self._trees[name])
        self._open.pop()
        self._done.add(name)
        self._context.hubs[name] = hub
        return hub

    def _report_cycle(self, start: int, use: Name) -> None:
        chain = self._open[start:]
        shown = " → ".join(f"`{name}`" for name in (*(name for name, _ in chain), use.text))
        self._context.report.add(
            codes.HUB_CYCLE,
            use.span,
            f"the hub `{use.text}` contains itself: {shown}",
            notes=[Note(name.span, f"`{name.text}` is used here") for _, name in chain[1:]],
        )

    def _build(self, tree: ast.Hub) -> BridgeHub | None:
        # No attribute: it would be in a cycle with the resolver.
        scope = BridgeScope(self._context, self.find, has_time=False)
        values: list[Expression] = []
        max_age_s = _seconds(tree.max_age, "max_age", self._context)
        is_valid = True
        for node in tree.values:
            try:
                value = typed(node, scope)
                inner = self._parts(value)
            except FaultyExpression:
                is_valid = False
                continue
            if isinstance(value, HubValue) and value.hub.max_age_s:
                max_age_s = min(max_age_s or value.hub.max_age_s, value.hub.max_age_s)
            values += inner
        if not is_valid:
            return None
        values = [self._in_shared_unit(value, values) for value in values]
        inputs = _inputs_of(values)
        policy = _policy(tree, inputs, self._context)
        type_, length = _declared_length(tree, joined_type(values), self._context)
        return BridgeHub(
            tree.name.text,
            tuple(values),
            inputs,
            type_,
            policy,
            tree.name.span,
            _seconds(tree.tolerance, "within", self._context),
            max_age_s,
            length,
            tree.doc,
        )

    def _parts(self, value: Expression) -> list[Expression]:
        """A value as it is joined: a struct as its fields, a hub as its values."""
        if isinstance(value.type, Struct):
            return [struct_items(value, value.type)]
        if not isinstance(value, HubValue):
            return list(value.items) if isinstance(value, ListExpression) else [value]
        if value.hub.policy is not HubPolicy.LATEST:
            message = f"`{value.hub.name}` has the policy `{value.hub.policy}`"
            help_ = "use its inputs here: the policy of the outer hub decides"
            self._context.fail(codes.HUB_POLICY, value.span, message, help_)
        return list(value.hub.values)

    def _in_shared_unit(self, value: Expression, values: list[Expression]) -> Expression:
        """`value` in the unit of the first value of the same dimension."""
        unit = parsed(value.unit) if value.unit else None
        for other in values:
            first = parsed(other.unit) if other.unit else None
            if unit is not None and first is not None and first.dimension == unit.dimension:
                return convert(value, other.unit, "the hub", self._context)
        return value


def _inputs_of(values: Iterable[Expression]) -> tuple[BridgeInput, ...]:
    nodes = (node for value in values for node in value.walk())
    return tuple(dict.fromkeys(node.input for node in nodes if isinstance(node, InputValue)))


def _policy(tree: ast.Hub, inputs: tuple[BridgeInput, ...], context: BridgeContext) -> HubPolicy:
    word = tree.policy.text.lower() if tree.policy else "latest"
    if word.startswith("synchroni"):
        if len(inputs) < 2:
            _report(
                (tree.policy or tree.name).span,
                f"`{tree.name.text}` has {len(inputs)} input: there is nothing to synchronise",
                "use the policy `all`, which uses every message once",
                context,
            )
        return HubPolicy.SYNCHRONISED
    return HubPolicy.ALL if word == "all" else HubPolicy.LATEST


def _seconds(written: Duration | None, what: str, context: BridgeContext) -> float:
    if written is None:
        return 0.0
    if 0 < written.seconds <= _LONGEST_S:
        return written.seconds
    text = f"`{what}` is a duration above 0 and up to a day, not `{written.span.text}`"
    help_ = "the time stamps of two messages are hardly ever equal" if what == "within" else ""
    _report(written.span, text, help_, context)
    return 0.0


def _declared_length(
    tree: ast.Hub, type_: ItemsType, context: BridgeContext
) -> tuple[ItemsType, int | None]:
    """The type with the declared length, and that length if it is checked at run time."""
    if tree.length is None:
        return type_, None
    length = int(tree.length.value)
    known = sum(group.count or 0 for group in type_.groups)
    if type_.count == length:
        return type_, None
    if type_.count is not None or known > length:
        at_least = "" if type_.count is not None else "at least "
        context.report.add(
            value_codes.VALUE_LENGTH,
            tree.length.span,
            f"`{tree.name.text}` has {at_least}{known} items, not {length}",
        )
        return type_, None
    return with_count(type_, length), length


def _report(span: Span, message: str, help_: str, context: BridgeContext) -> None:
    context.report.add(codes.HUB_POLICY, span, message, help=help_)
