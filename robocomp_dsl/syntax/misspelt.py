"""Characters that are no token of any language, and what was probably meant by them.

In: the findings of a file and the offsets of such characters. Out: the token that is read in their
place, or where to go on behind what is passed over, and mostly a finding.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import TypeAlias

from robocomp_dsl.diagnostics import Note
from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.findings import Findings

_MEANINGFUL = re.compile(r"[\sA-Za-z0-9_;{}()<>\[\],:=\"'/#.+-]|\Z")
_FIRST_MARK = re.compile(r"^<{7}", re.MULTILINE)
_MIDDLE_MARK = re.compile(r"^={7}[^\n]*", re.MULTILINE)
_LAST_MARK = re.compile(r"^>{7}[^\n]*", re.MULTILINE)
_HASH = re.compile(r"^[ \t]*#+", re.MULTILINE)

Read: TypeAlias = tuple[str, str, int]
"""Kind and text of a token and the offset behind it; no kind: go on there without a token."""


def _other_quotes(findings: Findings, start: int, end: int) -> Read:
    """`'text'` or “text”."""
    inside = findings.source.text[start + 1 : end - 1].replace('"', '\\"')
    right = f'"{inside}"'
    findings.add(
        codes.WRONG_QUOTES,
        start,
        end,
        "a text stands in double quotes",
        label=f"write {right}",
        fix=findings.fix("use double quotes", (start, end, right)),
    )
    return "STRING", right, end


def _open_string(findings: Findings, start: int, end: int) -> Read:
    """`"text` up to the end of the line."""
    findings.add(
        codes.UNCLOSED_TEXT,
        start,
        end,
        "this text has no closing quote",
        label='`"` is missing here at the latest',
        fix=findings.fix("close the text", (end, end, '"')),
    )
    return "STRING", findings.source.text[start:end] + '"', end


def _open_comment(findings: Findings, start: int, end: int) -> Read:
    """`/*` that nothing closes: the rest of the file is a comment."""
    findings.add(
        codes.UNCLOSED_COMMENT,
        start,
        end,
        "this comment is never closed",
        label="everything from here to the end of the file is ignored",
        help="write `*/` where the comment ends",
    )
    findings.cut = True
    return "", "", len(findings.source.text)


def _merge_mark(findings: Findings, start: int, end: int) -> Read:
    """A mark of a failed merge. The first version is read, the others are passed over."""
    text, source = findings.source.text, findings.source
    first = text[start] == "<"
    if first or not _FIRST_MARK.search(text, 0, start):
        middle = _MIDDLE_MARK.search(text, end)
        notes = (Note(source.span(*middle.span()), "the other version"),) if middle else ()
        findings.add(
            codes.MERGE_MARK,
            start,
            end,
            "two versions of this file were never merged",
            label="one version begins here" if first else "the mark of a merge",
            notes=notes,
            help="keep one of the two versions and delete the marks",
        )
        return "", "", end
    last = _LAST_MARK.search(text, start)
    return "", "", last.end() if last else end


def _stray(findings: Findings, start: int, end: int) -> Read:
    """Any other character, with the ones behind it that mean as little; told by the parser."""
    text = findings.source.text
    follows = _MEANINGFUL.search(text, max(end, start + 1))
    end = follows.start() if follows else len(text)
    return "STRAY", text[start:end], end


def _hash_lines(findings: Findings, start: int, end: int) -> Read:
    """Lines that begin with `#`: comments of an older tool, or what a preprocessor left."""
    text = findings.source.text
    marks = (mark.end() for mark in _HASH.finditer(text, text.rfind("\n", 0, start) + 1, end))
    findings.add(
        codes.HASH_COMMENT,
        start,
        start + len(text[start:end].partition("\n")[0]),
        "a comment begins with `//`",
        label="ignored",
        fix=findings.fix("write `//`", *((at - 1, at, "//") for at in marks)),
    )
    return "", "", end


def _repeated_semicolon(findings: Findings, start: int, end: int) -> Read:
    """`;;`, also with space between."""
    findings.add(
        codes.EMPTY_STATEMENT,
        start + 1,
        end,
        "this `;` ends nothing",
        fix=findings.fix("delete it", (start + 1, end, "")),
    )
    return "_SEMI", ";", end


READ: Mapping[str, Callable[[Findings, int, int], Read]] = {
    "OTHER_QUOTES": _other_quotes,
    "OPEN_STRING": _open_string,
    "OPEN_COMMENT": _open_comment,
    "MERGE_MARK": _merge_mark,
    "HASH_LINES": _hash_lines,
    "_SEMI": _repeated_semicolon,
    "STRAY": _stray,
}
"""Group of the scanner to what understands it."""
