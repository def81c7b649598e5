"""Rename: one name, wherever it is mentioned, in all files at once.

In: a place and a new name. Out: the edits, or a refusal that says why. Nothing is renamed in files
that came with the tool, or where the new name would be another one's.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams

from robocomp_dsl.check.files import identity
from robocomp_dsl.check.resolve_innermodel import ROOT_ID
from robocomp_dsl.editor.asked import everywhere, mentions_at
from robocomp_dsl.editor.bodies import related_files
from robocomp_dsl.editor.index import Mention, Symbol
from robocomp_dsl.editor.positions import range_of
from robocomp_dsl.editor.session import Session
from robocomp_dsl.resources import INTERFACES
from robocomp_dsl.syntax.tables import load

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_WORD = re.compile(r"[^\W\d][\w.:-]*")
_ID = re.compile(r"""[^\s"'<>&\x00-\x1f](?:[^"'<>&\x00-\x1f]*[^\s"'<>&\x00-\x1f])?""")


def prepare(
    session: Session, params: lsp.PrepareRenameParams
) -> lsp.PrepareRenamePlaceholder | None:
    """What would be renamed; None where there is no name."""
    one = _chosen(mentions_at(session, params))
    if one is None:
        return None
    _refuse_shipped(one.symbol)
    return lsp.PrepareRenamePlaceholder(range_of(one.span), one.symbol.name)


def rename(session: Session, params: lsp.RenameParams) -> lsp.WorkspaceEdit | None:
    """The edits that give the symbol at the place another name."""
    one = _chosen(mentions_at(session, params))
    if one is None:
        return None
    symbol, name = one.symbol, params.new_name
    _refuse_shipped(symbol)
    suffix = symbol.span.source.path.suffix.lower()
    if suffix == ".scxml":
        _refuse_word(name)
    elif symbol.kind == "node":
        _refuse_id(name)
    else:
        _refuse_name(name, symbol)
    mentions = list(everywhere(session, symbol.key))
    _refuse_taken(session, symbol, name)
    changes: dict[str, dict[int, lsp.TextEdit]] = {}
    for mention in mentions:
        uri = session.uri_of(mention.span.source.path)
        edit = lsp.TextEdit(range_of(mention.span), mention.form.format(name))
        changes.setdefault(uri, {}).setdefault(mention.span.start, edit)
    return lsp.WorkspaceEdit(changes={uri: list(e.values()) for uri, e in changes.items()})


def _chosen(found: list[Mention]) -> Mention | None:
    """What is declared at a place rather than what is mentioned there."""
    return next((one for one in found if one.declares), found[0] if found else None)


def _refuse_shipped(symbol: Symbol) -> None:
    if INTERFACES.resolve() in symbol.span.source.path.resolve().parents:
        raise JsonRpcInvalidParams(
            f"`{symbol.name}` is declared in `{symbol.span.source.path.name}`, which came with "
            "rcgen; copy that file beside yours to change it"
        )


def _refuse_name(name: str, symbol: Symbol) -> None:
    if not _NAME.fullmatch(name):
        raise JsonRpcInvalidParams(
            f"`{name}` is not a name: letters, digits and `_`, and no digit first"
        )
    tables = load(symbol.span.source.path.suffix[1:].lower())
    word = name.lower() if tables.any_case else name
    if word in tables.keywords:
        raise JsonRpcInvalidParams(f"`{name}` is a keyword here")


def _refuse_word(name: str) -> None:
    if not _WORD.fullmatch(name):
        raise JsonRpcInvalidParams(
            f"`{name}` is no name: letters, digits, `_`, `-`, `.` and `:`, and no digit first"
        )


def _refuse_id(name: str) -> None:
    if name == ROOT_ID:
        raise JsonRpcInvalidParams(f"`{name}` is the frame that all nodes stand in")
    if not _ID.fullmatch(name):
        raise JsonRpcInvalidParams(
            f"`{name}` is no id: no quotes, `<`, `&` or control characters, no blanks around it"
        )


def _refuse_taken(session: Session, symbol: Symbol, name: str) -> None:
    """Refuse the name of a neighbour: of what is declared in the same block of the same file.

    Ids are unique in a body with all that it includes.
    """
    path = symbol.span.source.path
    declared = _ids(session, path) if symbol.kind == "node" else session.index(path).declared()
    for one in declared:
        if one.name == name and _scope(one) == _scope(symbol) and one.key != symbol.key:
            where = f"{identity(one.span.source.path)}:{one.span.begin[0]}"
            raise JsonRpcInvalidParams(f"`{name}` is the name of another {one.kind}, at {where}")


def _scope(symbol: Symbol) -> tuple[str, str]:
    """Where no two names may be alike; ports and events are apart from what is around them."""
    apart = symbol.kind in ("port", "event")
    if symbol.kind == "node":
        return "", "node"
    return symbol.container, symbol.kind if apart else ""


def _ids(session: Session, path: Path) -> Iterator[Symbol]:
    for file in related_files(session, path):
        for one in session.index_or_nothing(file):
            if one.declares:
                yield one.symbol
