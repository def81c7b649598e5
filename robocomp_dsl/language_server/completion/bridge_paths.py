"""Where the cursor is in a bridge: in a type, in an expression, or in the path of a field.

In: the completion context. Out: answers, and the members that the path before the cursor has.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import dropwhile, takewhile

from robocomp_dsl.language_server.completion.context import CompletionContext
from robocomp_dsl.language_server.symbols.bridge_declarations import BridgeDeclarations
from robocomp_dsl.language_server.symbols.bridge_types import (
    BridgeMember,
    element_of,
    member_of,
    members_of,
)
from robocomp_dsl.syntax.ast import bdsl as ast
from robocomp_dsl.syntax.ast.base import Name, QualifiedName
from robocomp_dsl.syntax.grammar.lexer import Token

_BLOCKS = ("BRIDGE", "INPUT", "HUB", "OUTPUT", "SERVICE", "CALL", "ACTION", "COMMAND", "STATE")
_WITH_TYPES = ("INPUT", "OUTPUT", "SERVICE", "CALL", "FUNCTION", "ACTION", "COMMAND", "STATE")
_BEHIND_TYPE = frozenset(("OVER", "AT", "EQUAL"))
_ARROW = "__ANON_0"


def is_type(context: CompletionContext) -> bool:
    """Whether a type is expected, or the part of one."""
    kinds = [token.kind for token in context.statement]
    if not kinds or kinds[0] not in _WITH_TYPES or _in_list(context):
        return False
    if _BEHIND_TYPE.intersection(kinds):
        return False
    if kinds[0] == "FUNCTION":
        return "LPAR" in kinds and kinds[-1] in ("LPAR", "COMMA", _ARROW, "_SCOPE")
    return "COLON" in kinds and kinds[-1] in ("COLON", "LPAR", "COMMA", "_SCOPE", "DOT")


def is_expression(context: CompletionContext) -> bool:
    """Whether an expression is expected, or a field of the value before the cursor."""
    kinds = [token.kind for token in context.statement]
    return _in_list(context) or "EQUAL" in kinds or kinds[:1] == ["ITEM"] or "WHEN" in kinds


def _in_list(context: CompletionContext) -> bool:
    """Whether the innermost brace opens a list, not the block of a statement."""
    if len(context.blocks) < 2:
        return False
    block = context.block
    if not block or block[0].kind not in _BLOCKS:
        return True
    kinds = [token.kind for token in block]
    return kinds[-1] in ("EQUAL", "COMMA", "LPAR", "PLUS", "MINUS", "TIMES", "DIVIDE")


def value_path_members(
    context: CompletionContext, names: BridgeDeclarations, service: str
) -> Iterator[BridgeMember]:
    """The members of the path before the cursor, such as `imu.angular_velocity.`."""
    path: list[Token] = []
    for token in reversed(context.statement):
        if token.kind not in ("ID", "DOT", "BRACKETED") or _ends_path(path, token):
            break
        path.insert(0, token)
    if not path or path[0].kind != "ID":
        return
    owner = _follow(names.root(path[0].text, service), path[1:])
    yield from members_of(owner)


def _ends_path(path: Sequence[Token], token: Token) -> bool:
    """Whether `token` precedes the path that begins with `path`: two names in a row."""
    return bool(path) and token.kind == "ID" and path[0].kind == "ID"


def target_members(context: CompletionContext, names: BridgeDeclarations) -> Iterator[BridgeMember]:
    """What may be assigned to: the fields of a message, a reply or the arguments of a call."""
    statement = list(context.statement)
    block = context.block
    if statement[:1] and statement[0].kind == "STAMP":
        members: Iterable[BridgeMember] = members_of(names.root(_name_of(block)))
        statement = statement[1:]
    else:
        members = _block_members(context, names)
    if not statement or statement[-1].kind == "DOT":
        owner = _follow_members(members, statement)
        yield from members_of(owner) if statement else members


def target_type(context: CompletionContext, names: BridgeDeclarations) -> object:
    """The type of the field that the statement at the cursor assigns to."""
    path = list(takewhile(lambda token: token.kind != "EQUAL", context.statement))
    return _follow_members(_block_members(context, names), path)


def _follow_members(members: Iterable[BridgeMember], path: Sequence[Token]) -> object:
    """The type behind the names and indices of the path of a field."""
    owner: object = None
    for token in path:
        if token.kind == "BRACKETED":
            owner = element_of(owner)
        elif token.kind != "DOT":
            member = next((m for m in members if m.name == token.text), None)
            owner = member.type if member else None
        members = members_of(owner)
    return owner


def _block_members(context: CompletionContext, names: BridgeDeclarations) -> Iterable[BridgeMember]:
    """The fields that the statements of the innermost block assign to."""
    written = _written_type(context)
    match context.block_kind:
        case "OUTPUT" | "COMMAND":
            return names.declared.message(written)
        case "SERVICE":
            return names.declared.reply(written)
        case "ACTION":
            return names.declared.action_messages(written)
        case "CALL":
            return names.declared.request(written)
    return ()


def _written_type(context: CompletionContext) -> ast.TypeRef:
    """The type in the statement that opened the innermost block, which may not be in the tree."""
    block, source = context.block, context.source
    span = source.span(context.start, context.start)
    names: list[Name] = []
    has_module = False
    for token in dropwhile(lambda token: token.kind != "COLON", block):
        if token.kind in ("OVER", "AT", "EQUAL", "BRACKETED"):
            break
        has_module = has_module or token.kind == "_SCOPE"
        if token.kind == "ID":
            names.append(Name(source.span(token.start, token.end), token.text))
    module = names.pop(0) if has_module and names else None
    if not names:
        return ast.TypeRef(span)
    operation = names[1] if len(names) > 1 else None
    return ast.TypeRef(span, QualifiedName(span, names[0], module), operation)


def _name_of(block: Sequence[Token]) -> str:
    return block[1].text if len(block) > 1 else ""


def _follow(owner: object, path: Sequence[Token]) -> object:
    """The object behind the names and selections of a path."""
    for token in path:
        if token.kind == "ID":
            member = member_of(owner, token.text)
            owner = member.type if member else None
        elif token.kind == "BRACKETED" and token.text[1:-1].strip().isdecimal():
            owner = element_of(owner)
    return owner
