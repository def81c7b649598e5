"""Names that an IDSL file can use at a place."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from lsprotocol import types as lsp

from robocomp_dsl.editor.cursor import Cursor
from robocomp_dsl.editor.names_idsl import symbol
from robocomp_dsl.editor.offer import Offer, words
from robocomp_dsl.editor.session import Session
from robocomp_dsl.model import types
from robocomp_dsl.model.interface import Interface, Module

KINDS: dict[type, lsp.CompletionItemKind] = {
    types.Struct: lsp.CompletionItemKind.Struct,
    types.ExceptionType: lsp.CompletionItemKind.Struct,
    types.Enum: lsp.CompletionItemKind.Enum,
    types.Sequence: lsp.CompletionItemKind.TypeParameter,
    types.Dictionary: lsp.CompletionItemKind.TypeParameter,
    Interface: lsp.CompletionItemKind.Interface,
}
DATA = (types.Struct, types.Enum, types.Sequence, types.Dictionary)
_BEFORE_TYPE = ("LPAR", "COMMA", "OUT", "IDEMPOTENT", "LESSTHAN", "BRACKETED", "")
_HOLD_TYPES = ("STRUCT", "EXCEPTION", "INTERFACE")


def names(session: Session, cursor: Cursor) -> Iterator[Offer]:
    """Types, exceptions, enumerators: what the place asks for."""
    models = [one.model for one in session.checks_to_complete(cursor.path)]
    own = [m for model in models if isinstance(model, tuple) for m in model]
    modules = [one for module in own for one in module.closure()]
    kinds = [token.kind for token in cursor.statement]
    if cursor.last == "EQUAL":
        yield from _enumerators(cursor, modules)
    elif cursor.last == "_SCOPE":
        wanted = (types.ExceptionType,) if "THROWS" in kinds else DATA
        yield from declared(modules, wanted, module=cursor.statement[-2].text)
    elif "THROWS" in kinds:
        yield from declared(modules, (types.ExceptionType,), own=own)
    elif cursor.last in _BEFORE_TYPE and _holds_types(cursor, kinds):
        yield from words(*types.PRIMITIVES)
        yield from declared(modules, DATA, own=own)
        if cursor.inside == "INTERFACE" and not kinds:
            yield from words("void")


def declared(
    modules: Iterable[Module],
    kinds: tuple[type, ...],
    *,
    module: str | None = None,
    own: Iterable[Module] = (),
) -> Iterator[Offer]:
    """Declarations of some kinds, of one module or of all.

    Those of other modules than one's `own` are offered as `Module::Name`, unless `module` is given
    (and so already written) or they are interfaces.
    """
    mine = {one.name for one in own}
    for one in modules:
        for made in one.declarations if module in (None, one.name) else ():
            if isinstance(made, kinds):
                plain = module is not None or one.name in mine or isinstance(made, Interface)
                label = made.name if plain else made.qualified
                yield Offer(label, KINDS[type(made)], made.qualified, symbol(made))


def _holds_types(cursor: Cursor, kinds: list[str]) -> bool:
    return cursor.inside in _HOLD_TYPES or kinds[:1] in (["SEQUENCE"], ["DICTIONARY"])


def _enumerators(cursor: Cursor, modules: Iterable[Module]) -> Iterator[Offer]:
    """The values of the field that is given a default."""
    names = [token.text for token in cursor.statement if token.kind == "ID"]
    wanted = names[-2] if len(names) > 1 else ""
    for module in modules:
        for one in module.declarations:
            if isinstance(one, types.Enum) and one.name == wanted:
                kind = lsp.CompletionItemKind.EnumMember
                yield from (Offer(v.name, kind, f"{v.value}") for v in one.enumerators)
