"""Completion of BDSL files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from lsprotocol import types as lsp

from robocomp_dsl.check.ddsl.qos import PRIORITIES
from robocomp_dsl.language_server.completion.bridge_paths import (
    is_expression,
    is_type,
    target_members,
    target_type,
    value_path_members,
)
from robocomp_dsl.language_server.completion.candidates import (
    CompletionCandidate,
    middleware_candidates,
    value_candidates,
)
from robocomp_dsl.language_server.completion.complete_idsl import DATA, declaration_candidates
from robocomp_dsl.language_server.completion.context import CompletionContext
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.signatures.signatures_bdsl import format_function, value_text
from robocomp_dsl.language_server.signatures.signatures_idsl import format_operation
from robocomp_dsl.language_server.symbols.bridge_declarations import BridgeDeclarations
from robocomp_dsl.language_server.symbols.bridge_occurrences import member_symbol
from robocomp_dsl.language_server.symbols.bridge_types import BridgeMember
from robocomp_dsl.language_server.symbols.symbols_bdsl import bridge_names
from robocomp_dsl.model import types
from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.model.interface import Interface, Module
from robocomp_dsl.syntax.languages.bdsl import POLICIES
from robocomp_dsl.syntax.languages.builder import TIME_UNITS

BUILT_IN_FUNCTIONS = {
    "number": "number(x): a string, a bool or any number as a double",
    "text": "text(x): a number or a bool as a string",
    "length": "length(x): the number of items, or of characters",
    "stamp": "stamp(input): the time stamp of the newest message of an input",
}
TIMES = {
    "now": "the time at which the message is sent",
    "counter": "the number of messages sent before, from 0",
}
_WITH_DURATION = frozenset(("TIMEOUT", "POLICY", "MAX_AGE", "DEADLINE", "LIVELINESS"))
_FIXED = {"POLICY": POLICIES, "PRIORITY": PRIORITIES}
"""Keyword to the words that may follow it."""


def candidates(session: Session, context: CompletionContext) -> Iterator[CompletionCandidate]:
    """Types, middlewares, names of values, fields on both sides of an assignment."""
    last = context.previous_kind
    first = context.statement[0].kind if context.statement else ""
    checks = session.checks_for_completion(context.path)
    bridges = [checked.model for checked in checks if isinstance(checked.model, Bridge)]
    names = bridge_names(checks, context.path, session.workspace)
    if last in ("MIDDLEWARE", "OVER"):
        yield from middleware_candidates(session.workspace.middlewares)
    elif last in _FIXED:
        yield from value_candidates(*_FIXED[last])
    elif last == "NUMBER" and first in _WITH_DURATION:
        yield from value_candidates(*TIME_UNITS)
    elif is_type(context):
        yield from _types(context, _modules(bridges))
    elif is_expression(context):
        if "ID" in context.accepted:
            yield from _values(context, names)
    else:
        yield from _members(target_members(context, names))


def _modules(bridges: Iterable[Bridge]) -> list[Module]:
    """All imported modules, each once."""
    every = [m for bridge in bridges for direct in bridge.modules for m in direct.closure()]
    return list(dict.fromkeys(every))


def _types(context: CompletionContext, modules: list[Module]) -> Iterator[CompletionCandidate]:
    """Built-in types, imported types and interfaces; behind a dot the operations."""
    last = context.previous_kind
    kinds = (*DATA, Interface)
    if last == "DOT":
        name = context.statement[-2].text
        declared = (d for module in modules for d in module.interfaces if d.name == name)
        for operation in (o for interface in declared for o in interface.operations):
            kind = lsp.CompletionItemKind.Method
            yield CompletionCandidate(operation.name, kind, format_operation(operation))
    elif last == "_SCOPE":
        package = context.statement[-2].text
        yield from declaration_candidates(modules, kinds, module=package)
        yield from _ros_services([m for m in modules if m.name == package], qualified=False)
    else:
        yield from value_candidates(*(name for name in types.PRIMITIVES if name.isidentifier()))
        yield from declaration_candidates(modules, kinds)
        yield from _ros_services(modules, qualified=True)


def _ros_services(modules: list[Module], *, qualified: bool) -> Iterator[CompletionCandidate]:
    """The services of imported ROS definitions, which are declared as two messages."""
    suffix = "_Request"
    for module in modules:
        for struct in module.declarations:
            if isinstance(struct, types.Struct) and "/srv/" in struct.ros_name:
                name = struct.name.removesuffix(suffix)
                if struct.name.endswith(suffix):
                    label = f"{module.name}::{name}" if qualified else name
                    yield CompletionCandidate(label, lsp.CompletionItemKind.Interface, "service")


def _values(context: CompletionContext, names: BridgeDeclarations) -> Iterator[CompletionCandidate]:
    """Names in an expression; behind a dot the fields of what is before it."""
    service = _service(context)
    if context.previous_kind == "DOT":
        yield from _members(value_path_members(context, names, service))
        return
    for name, detail in _values_of(service, names):
        yield CompletionCandidate(name, lsp.CompletionItemKind.Variable, detail)
    target = target_type(context, names)
    for enumerator in target.enumerators if isinstance(target, types.Enum) else ():
        kind = lsp.CompletionItemKind.EnumMember
        yield CompletionCandidate(enumerator.name, kind, f"{enumerator.value}")
    for name, function in names.functions().items():
        detail = format_function(function)
        yield CompletionCandidate(name, lsp.CompletionItemKind.Function, detail)
    for name, detail in BUILT_IN_FUNCTIONS.items():
        yield CompletionCandidate(name, lsp.CompletionItemKind.Function, detail)
    for name, detail in TIMES.items():
        yield CompletionCandidate(name, lsp.CompletionItemKind.Constant, detail)
    yield from value_candidates("true", "false")


def _values_of(service: str, names: BridgeDeclarations) -> Iterator[tuple[str, str]]:
    """The names of values with their details, in a service or action, or outside of both."""
    action = names.action_tree(service) if service else None
    if action:
        yield "goal", f"the goal of {service}"
        for state in action.states:
            yield state.name.text, "the newest message of the state"
    elif service:
        yield "request", f"the request of {service}"
        for call in names.call_trees(service):
            yield call, "the reply of the call"
    else:
        for name, value in names.values().items():
            yield name, value_text(value.type, getattr(value, "unit", "")) if value else ""


def _service(context: CompletionContext) -> str:
    """The name of the service or action around the cursor; empty in hubs and outputs."""
    owners = ("SERVICE", "ACTION")
    blocks = [block for block in context.blocks if block and block[0].kind in owners]
    return blocks[0][1].text if blocks and len(blocks[0]) > 1 else ""


def _members(members: Iterable[BridgeMember]) -> Iterator[CompletionCandidate]:
    for member in members:
        detail = value_text(member.type, member.unit)
        kind = lsp.CompletionItemKind.Field
        symbol = member_symbol(member)
        yield CompletionCandidate(member.name, kind, detail, symbol)
