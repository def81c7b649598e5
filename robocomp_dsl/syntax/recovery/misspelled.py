"""Malformed tokens: wrong quotes, unclosed strings and comments, merge conflict markers.

In: the diagnostics of a file and the range of the malformed text. Out: the token that replaces it,
or the offset to continue at, and usually a diagnostic.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import TypeAlias

from robocomp_dsl.diagnostics import Note
from robocomp_dsl.syntax.codes import legacy as legacy_codes
from robocomp_dsl.syntax.codes import syntax as syntax_codes
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics

_MEANINGFUL = re.compile(r"[\sA-Za-z0-9_;{}()<>\[\],:=\"'/#.+-]|\Z")
_FIRST_MARK = re.compile(r"^<{7}", re.MULTILINE)
_MIDDLE_MARK = re.compile(r"^={7}[^\n]*", re.MULTILINE)
_LAST_MARK = re.compile(r"^>{7}[^\n]*", re.MULTILINE)
_HASH = re.compile(r"^[ \t]*#+", re.MULTILINE)

RecoveredToken: TypeAlias = tuple[str, str, int]
"""Kind and text of a token and the offset after it; no kind: continue there without a token."""


def _other_quotes(findings: FileDiagnostics, start: int, end: int) -> RecoveredToken:
    """`'text'` or “text”."""
    inside = findings.source.text[start + 1 : end - 1].replace('"', '\\"')
    right = f'"{inside}"'
    findings.add(
        syntax_codes.WRONG_QUOTES,
        start,
        end,
        "strings use double quotes",
        label=f"write {right}",
        fix=findings.fix("use double quotes", (start, end, right)),
    )
    return "STRING", right, end


def _open_string(findings: FileDiagnostics, start: int, end: int) -> RecoveredToken:
    """`"text` up to the end of the line."""
    findings.add(
        syntax_codes.UNCLOSED_STRING,
        start,
        end,
        "this string has no closing quote",
        label='missing `"`',
        fix=findings.fix("close the string", (end, end, '"')),
    )
    return "STRING", findings.source.text[start:end] + '"', end


def _open_comment(findings: FileDiagnostics, start: int, end: int) -> RecoveredToken:
    """`/*` without `*/`: the rest of the file is a comment."""
    findings.add(
        syntax_codes.UNCLOSED_COMMENT,
        start,
        end,
        "this comment is never closed",
        label="everything from here to the end of the file is ignored",
        help="write `*/` where the comment ends",
    )
    findings.is_truncated = True
    return "", "", len(findings.source.text)


def _merge_mark(findings: FileDiagnostics, start: int, end: int) -> RecoveredToken:
    """A merge conflict marker. The first version is read, the other one is skipped."""
    text, source = findings.source.text, findings.source
    first = text[start] == "<"
    if first or not _FIRST_MARK.search(text, 0, start):
        middle = _MIDDLE_MARK.search(text, end)
        notes = (Note(source.span(*middle.span()), "the other version"),) if middle else ()
        findings.add(
            syntax_codes.MERGE_CONFLICT,
            start,
            end,
            "unresolved merge conflict",
            label="the first version begins here" if first else "conflict marker",
            notes=notes,
            help="keep one of the two versions and delete the conflict markers",
        )
        return "", "", end
    last = _LAST_MARK.search(text, start)
    return "", "", last.end() if last else end


def _stray_characters(findings: FileDiagnostics, start: int, end: int) -> RecoveredToken:
    """Any other invalid character and those that follow it; the parser reports them."""
    text = findings.source.text
    follows = _MEANINGFUL.search(text, max(end, start + 1))
    end = follows.start() if follows else len(text)
    return "STRAY", text[start:end], end


def _hash_lines(findings: FileDiagnostics, start: int, end: int) -> RecoveredToken:
    """Lines that begin with `#`: comments of an older tool, or preprocessor directives."""
    text = findings.source.text
    marks = (mark.end() for mark in _HASH.finditer(text, text.rfind("\n", 0, start) + 1, end))
    findings.add(
        legacy_codes.HASH_COMMENT,
        start,
        start + len(text[start:end].partition("\n")[0]),
        "comments begin with `//`",
        label="ignored",
        fix=findings.fix("write `//`", *((at - 1, at, "//") for at in marks)),
    )
    return "", "", end


def _repeated_semicolon(findings: FileDiagnostics, start: int, end: int) -> RecoveredToken:
    """`;;`, also with space between the two."""
    findings.add(
        legacy_codes.EMPTY_STATEMENT,
        start + 1,
        end,
        "superfluous `;`",
        fix=findings.fix("delete it", (start + 1, end, "")),
    )
    return "_SEMI", ";", end


READERS: Mapping[str, Callable[[FileDiagnostics, int, int], RecoveredToken]] = {
    "OTHER_QUOTES": _other_quotes,
    "OPEN_STRING": _open_string,
    "OPEN_COMMENT": _open_comment,
    "MERGE_MARK": _merge_mark,
    "HASH_LINES": _hash_lines,
    "_SEMI": _repeated_semicolon,
    "STRAY": _stray_characters,
}
"""Group of the scanner to the function that reads the malformed text."""
