"""Completion of IDSL files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from lsprotocol import types as lsp

from robocomp_dsl.language_server.completion.candidates import CompletionCandidate, value_candidates
from robocomp_dsl.language_server.completion.context import CompletionContext
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.symbols_idsl import declaration_symbol
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
_KINDS_BEFORE_TYPE = ("LPAR", "COMMA", "OUT", "IDEMPOTENT", "LESSTHAN", "BRACKETED", "")
_BLOCKS_WITH_TYPES = ("STRUCT", "EXCEPTION", "INTERFACE")


def candidates(session: Session, context: CompletionContext) -> Iterator[CompletionCandidate]:
    """Types, exceptions and enumerators."""
    models = [checked.model for checked in session.checks_for_completion(context.path)]
    own = [m for model in models if isinstance(model, tuple) for m in model]
    modules = [module for own_module in own for module in own_module.closure()]
    kinds = [token.kind for token in context.statement]
    if context.previous_kind == "EQUAL":
        yield from _enumerators(context, modules)
    elif context.previous_kind == "_SCOPE":
        accepted = (types.ExceptionType,) if "THROWS" in kinds else DATA
        yield from declaration_candidates(modules, accepted, module=context.statement[-2].text)
    elif "THROWS" in kinds:
        yield from declaration_candidates(modules, (types.ExceptionType,), own=own)
    elif context.previous_kind in _KINDS_BEFORE_TYPE and _accepts_type(context, kinds):
        yield from value_candidates(*types.PRIMITIVES)
        yield from declaration_candidates(modules, DATA, own=own)
        if context.block_kind == "INTERFACE" and not kinds:
            yield from value_candidates("void")


def declaration_candidates(
    modules: Iterable[Module],
    kinds: tuple[type, ...],
    *,
    module: str | None = None,
    own: Iterable[Module] = (),
) -> Iterator[CompletionCandidate]:
    """The declarations of some kinds, in all modules or in the one named `module`.

    Labels are qualified (`Module::Name`), except for interfaces, for declarations of `own` modules,
    and if `module` is given, because the text then already contains it.
    """
    own_names = {each.name for each in own}
    for each in modules:
        for declaration in each.declarations if module in (None, each.name) else ():
            if isinstance(declaration, kinds):
                unqualified = module is not None or each.name in own_names
                unqualified = unqualified or isinstance(declaration, Interface)
                label = declaration.name if unqualified else declaration.qualified
                kind, symbol = KINDS[type(declaration)], declaration_symbol(declaration)
                yield CompletionCandidate(label, kind, declaration.qualified, symbol)


def _accepts_type(context: CompletionContext, kinds: list[str]) -> bool:
    return context.block_kind in _BLOCKS_WITH_TYPES or kinds[:1] in (["SEQUENCE"], ["DICTIONARY"])


def _enumerators(
    context: CompletionContext, modules: Iterable[Module]
) -> Iterator[CompletionCandidate]:
    """The enumerators for the default of a field."""
    names = [token.text for token in context.statement if token.kind == "ID"]
    enum_name = names[-2] if len(names) > 1 else ""
    kind = lsp.CompletionItemKind.EnumMember
    for module in modules:
        for enum in module.declarations:
            if isinstance(enum, types.Enum) and enum.name == enum_name:
                for value in enum.enumerators:
                    yield CompletionCandidate(value.name, kind, f"{value.value}")
