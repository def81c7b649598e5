"""Formatting: the same text as the house writes it.

In: a source and what the parser found in it. Out: the new text. Only what stands between tokens and
comments changes, so a text says the same before and after; that is checked each time.

    pieces    tokens and comments, in order: what stays
    scan      text to pieces: the languages with braces     xml_scan   those in XML
    items     pieces to statements and blocks
    style     the look of each language, as a table
    layout    statements to lines                           xml        tags to lines
    lines     lines to text: comments behind lines, indentation of comments

Legacy forms are formatted and not changed: `rcgen check --fix` changes them.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Sequence

from robocomp_dsl.diagnostics import Diagnostic, Report, Severity
from robocomp_dsl.format import items, pieces
from robocomp_dsl.format.layout import lay_out
from robocomp_dsl.format.lines import Line, text_of
from robocomp_dsl.format.pieces import Change, Piece
from robocomp_dsl.format.scan import scan
from robocomp_dsl.format.style import STYLES
from robocomp_dsl.format.xml import lay_out_xml
from robocomp_dsl.format.xml_scan import scan_xml
from robocomp_dsl.source import Source
from robocomp_dsl.syntax import LANGUAGES, codes, parse_innermodel, parse_scxml

XML: dict[str, Callable[[Source, Report], object]] = {
    ".xml": parse_innermodel,
    ".scxml": parse_scxml,
}
PARSERS: dict[str, Callable[[Source, Report], object]] = {**LANGUAGES, **XML}
"""File suffix (lower case) to parser, for every language that can be formatted."""


_LINE_END = re.compile(r"(?: |\\t|\\r)+(?=\\n)")
"""Blanks in front of a line feed, as `repr` shows them."""


class CannotFormat(Exception):
    """The text must stay as it is; the message says why, in words for the user."""


def formatted(source: Source, findings: Collection[Diagnostic]) -> str | None:
    """The text of `source` as the house writes it, or None if it has errors of form.

    `findings` are those of the parser. Raises `KeyError` for a suffix that is none of `PARSERS`,
    and `CannotFormat`.
    """
    suffix = source.path.suffix.lower()
    parser = PARSERS[suffix]
    if any(one.severity is Severity.ERROR for one in findings):
        return None
    missing = {one.span.end for one in findings if one.code is codes.LEGACY_SEMICOLON}
    old = _scan(source.text, suffix, missing)
    new = _formatted(old, suffix, source.text)
    # Where nothing was found, nothing was guessed either, and the tokens alone give the tree.
    right = pieces.same([one for one in old if one.text], _scan(new, suffix))
    if not right or (findings and not _same_tree(source, new, parser)):
        raise CannotFormat(_reason(findings))
    return new


def _reason(findings: Collection[Diagnostic]) -> str:
    if any(one.code is codes.TOO_MANY for one in findings):
        return "it has too many legacy forms; mend them first, with `rcgen check --fix`"
    return "it would say something else, which is a mistake of ours; please report it"


def changes(source: Source, new: str) -> list[Change]:
    """The small changes that make `new`, which is `formatted`, of `source`."""
    suffix = source.path.suffix.lower()
    old = _scan(source.text, suffix)
    return list(pieces.changes(source.text, new, old, _scan(new, suffix)))


def _scan(text: str, suffix: str, missing: Collection[int] = ()) -> list[Piece]:
    return scan_xml(text) if suffix in XML else scan(text, suffix[1:], missing)


def _formatted(old: Sequence[Piece], suffix: str, text: str) -> str:
    new = text_of(_lines(old, suffix))
    crlf = text.count("\r\n") * 2 > text.count("\n")
    return new.replace("\n", "\r\n") if crlf else new


def _lines(old: Sequence[Piece], suffix: str) -> list[Line]:
    if suffix in XML:
        return lay_out_xml(old)
    style = STYLES[suffix[1:]]
    return lay_out(items.read(old, inline_braces=style.inline_braces), style)


def _same_tree(source: Source, new: str, parser: Callable[[Source, Report], object]) -> bool:
    trees = (parser(one, Report()) for one in (source, Source(source.path, new)))
    # Without spans; the ends of lines in comments are those of the whole file then.
    old, made = (_LINE_END.sub("", repr(tree)) for tree in trees)
    return old == made
