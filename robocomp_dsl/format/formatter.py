"""The formatter: rewrites a source in canonical style.

In: a source and the findings of the parser. Out: the new text. Formatting changes only whitespace
between tokens and comments, so the meaning stays; this is verified each time.

    tokens    tokens and comments with their positions
    scan      text to tokens: the languages with braces     xml_scan   the XML languages
    items     tokens to statements and blocks
    style     the style of each language, as a table
    layout    statements to lines                           xml        tags to lines
    lines     lines to text: trailing comments, indentation of comments

Legacy syntax is formatted, but not replaced: `rcgen check --fix` does that.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Sequence

from robocomp_dsl.diagnostics import Diagnostic, Report, Severity
from robocomp_dsl.format import items, tokens
from robocomp_dsl.format.layout import lay_out
from robocomp_dsl.format.lines import Line, text_of
from robocomp_dsl.format.scan import scan
from robocomp_dsl.format.style import STYLES
from robocomp_dsl.format.tokens import Change, FormatToken
from robocomp_dsl.format.xml import lay_out_xml
from robocomp_dsl.format.xml_scan import scan_xml
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.codes import file as file_codes
from robocomp_dsl.syntax.codes import legacy as legacy_codes
from robocomp_dsl.syntax.parse import LANGUAGES, parse_innermodel, parse_scxml

XML: dict[str, Callable[[Source, Report], object]] = {
    ".xml": parse_innermodel,
    ".scxml": parse_scxml,
}
PARSERS: dict[str, Callable[[Source, Report], object]] = {**LANGUAGES, **XML}
"""File suffix (lower case) to parser, for every language that can be formatted."""


_LINE_END = re.compile(r"(?: |\\t|\\r)+(?=\\n)")
"""Whitespace before a line feed, as in the output of `repr`."""


class CannotFormat(Exception):
    """The text cannot be formatted; the message gives the reason for the user."""


def format_source(source: Source, findings: Collection[Diagnostic]) -> str | None:
    """The text of `source` in canonical style, or None if it has syntax errors.

    `findings` are those of the parser. Raises `KeyError` for a suffix that is not in `PARSERS`, and
    `CannotFormat`.
    """
    suffix = source.path.suffix.lower()
    parser = PARSERS[suffix]
    if any(finding.severity is Severity.ERROR for finding in findings):
        return None
    missing = {
        finding.span.end for finding in findings if finding.code is legacy_codes.LEGACY_SEMICOLON
    }
    old = _scan(source.text, suffix, missing)
    new = _lay_out(old, suffix, source.text)
    # Without findings the parser repaired nothing, so equal tokens give equal trees.
    right = tokens.same_content([token for token in old if token.text], _scan(new, suffix))
    if not right or (findings and not _same_tree(source, new, parser)):
        raise CannotFormat(_reason(findings))
    return new


def _reason(findings: Collection[Diagnostic]) -> str:
    if any(finding.code is file_codes.TOO_MANY_FINDINGS for finding in findings):
        return "too much legacy syntax; fix it first with `rcgen check --fix`"
    return "internal error: formatting would change the meaning; please report it"


def changes(source: Source, new: str) -> list[Change]:
    """The minimal changes from `source` to `new`, the result of `format_source`."""
    suffix = source.path.suffix.lower()
    old = _scan(source.text, suffix)
    return list(tokens.changes(source.text, new, old, _scan(new, suffix)))


def _scan(text: str, suffix: str, missing: Collection[int] = ()) -> list[FormatToken]:
    return scan_xml(text) if suffix in XML else scan(text, suffix[1:], missing)


def _lay_out(old: Sequence[FormatToken], suffix: str, text: str) -> str:
    new = text_of(_lines(old, suffix))
    crlf = text.count("\r\n") * 2 > text.count("\n")
    return new.replace("\n", "\r\n") if crlf else new


def _lines(old: Sequence[FormatToken], suffix: str) -> list[Line]:
    if suffix in XML:
        return lay_out_xml(old)
    style = STYLES[suffix[1:]]
    return lay_out(items.parse_statements(old, inline_braces=style.inline_braces), style)


def _same_tree(source: Source, new: str, parser: Callable[[Source, Report], object]) -> bool:
    trees = (parser(text, Report()) for text in (source, Source(source.path, new)))
    # `repr` shows no spans. Line ends in comments may change with those of the file.
    old, result = (_LINE_END.sub("", repr(tree)) for tree in trees)
    return old == result
