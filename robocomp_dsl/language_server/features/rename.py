"""Rename: a symbol and all its occurrences, in all known files.

In: a position and a new name. Out: the edits, or an error that says why the rename is impossible.
Declarations in files that ship with rcgen, and names that are already in use, are rejected.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams

from robocomp_dsl.check.innermodel.resolve import ROOT_ID
from robocomp_dsl.check.workspace.source_cache import canonical_path
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.language_server.symbols.include_graph import connected_files
from robocomp_dsl.language_server.symbols.lookup import find_occurrences, occurrences_at
from robocomp_dsl.language_server.symbols.symbol import Occurrence, Symbol
from robocomp_dsl.resources import INTERFACES
from robocomp_dsl.syntax.definitions import DEFINITION_SUFFIXES, YARP_SUFFIXES
from robocomp_dsl.syntax.grammar.tables import load

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_WORD = re.compile(r"[^\W\d][\w.:-]*")
_ID = re.compile(r"""[^\s"'<>&\x00-\x1f](?:[^"'<>&\x00-\x1f]*[^\s"'<>&\x00-\x1f])?""")


def prepare(
    session: Session, params: lsp.PrepareRenameParams
) -> lsp.PrepareRenamePlaceholder | None:
    """The range and name that a rename would change; None if there is no name."""
    occurrences = occurrences_at(session, params.text_document, params.position)
    selected = _select_occurrence(occurrences)
    if selected is None:
        return None
    _reject_shipped(selected.symbol)
    _reject_definition(selected.symbol)
    extent = session.positions.range_of(selected.span)
    return lsp.PrepareRenamePlaceholder(extent, selected.symbol.name)


def rename(session: Session, params: lsp.RenameParams) -> lsp.WorkspaceEdit | None:
    """The edits that rename the symbol at the position."""
    selected = _select_occurrence(occurrences_at(session, params.text_document, params.position))
    if selected is None:
        return None
    symbol, name = selected.symbol, params.new_name
    _reject_shipped(symbol)
    _reject_definition(symbol)
    suffix = symbol.span.source.path.suffix.lower()
    if suffix == ".scxml":
        _validate_scxml_id(name)
    elif symbol.kind == "node":
        _validate_node_id(name)
    else:
        _validate_identifier(name, symbol)
    occurrences = list(find_occurrences(session, symbol.key))
    _reject_duplicate(session, symbol, name)
    changes: dict[str, dict[int, lsp.TextEdit]] = {}
    for occurrence in occurrences:
        uri = session.uri_of(occurrence.span.source.path)
        text = occurrence.rename_template.format(name)
        edit = lsp.TextEdit(session.positions.range_of(occurrence.span), text)
        changes.setdefault(uri, {}).setdefault(occurrence.span.start, edit)
    return lsp.WorkspaceEdit(changes={uri: list(e.values()) for uri, e in changes.items()})


def _select_occurrence(occurrences: list[Occurrence]) -> Occurrence | None:
    """The declaring occurrence if there is one, else the first."""
    first = occurrences[0] if occurrences else None
    return next((occurrence for occurrence in occurrences if occurrence.declares), first)


def _reject_shipped(symbol: Symbol) -> None:
    if INTERFACES.resolve() in symbol.span.source.path.resolve().parents:
        raise JsonRpcInvalidParams(
            f"`{symbol.name}` is declared in `{symbol.span.source.path.name}`, which ships with "
            "rcgen; copy that file beside yours to change it"
        )


def _reject_definition(symbol: Symbol) -> None:
    """Reject a name in a definition of ROS or YARP."""
    suffix = symbol.span.source.path.suffix.lower()
    if suffix in DEFINITION_SUFFIXES:
        owner = "YARP" if suffix in YARP_SUFFIXES else "ROS"
        raise JsonRpcInvalidParams(
            f"`{symbol.name}` is declared in the {owner} definition"
            f" `{symbol.span.source.path.name}`; its name is known to all {owner} programs that"
            " use it"
        )


def _validate_identifier(name: str, symbol: Symbol) -> None:
    if not _NAME.fullmatch(name):
        raise JsonRpcInvalidParams(
            f"`{name}` is not a valid name: use letters, digits and `_`, not starting with a digit"
        )
    tables = load(symbol.span.source.path.suffix[1:].lower())
    word = name.lower() if tables.any_case else name
    if word in tables.keywords:
        raise JsonRpcInvalidParams(f"`{name}` is a keyword of this language")


def _validate_scxml_id(name: str) -> None:
    if not _WORD.fullmatch(name):
        raise JsonRpcInvalidParams(
            f"`{name}` is not a valid name: use letters, digits, `_`, `-`, `.` and `:`, "
            "not starting with a digit"
        )


def _validate_node_id(name: str) -> None:
    if name == ROOT_ID:
        raise JsonRpcInvalidParams(f"`{name}` is reserved for the root frame")
    if not _ID.fullmatch(name):
        raise JsonRpcInvalidParams(
            f"`{name}` is not a valid id: it must not contain quotes, `<`, `&` or control "
            "characters, nor start or end with a space"
        )


def _reject_duplicate(session: Session, symbol: Symbol, name: str) -> None:
    """Reject a name that is already declared in the same scope.

    Node ids are unique in a world with all included files.
    """
    path = symbol.span.source.path
    is_node = symbol.kind == "node"
    declared = _node_symbols(session, path) if is_node else session.index(path).declarations()
    for other in declared:
        if other.name == name and _scope(other) == _scope(symbol) and other.key != symbol.key:
            where = f"{canonical_path(other.span.source.path)}:{other.span.start_position[0]}"
            raise JsonRpcInvalidParams(f"another {other.kind} is named `{name}`, at {where}")


def _scope(symbol: Symbol) -> tuple[str, str]:
    """The scope in which names must be unique; ports and events have scopes of their own."""
    if symbol.kind == "node":
        return "", "node"
    return symbol.container, symbol.kind if symbol.kind in ("port", "event") else ""


def _node_symbols(session: Session, path: Path) -> Iterator[Symbol]:
    for file in connected_files(session, path):
        for occurrence in session.occurrences_in(file):
            if occurrence.declares:
                yield occurrence.symbol
