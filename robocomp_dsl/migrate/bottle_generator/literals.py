"""Reads the constants of a configuration: texts in quotes, numbers, true and false."""

from __future__ import annotations

import re
from collections.abc import Iterator

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate.bottle_generator import codes
from robocomp_dsl.migrate.bottle_generator.configuration import IniConstant
from robocomp_dsl.migrate.bottle_generator.ini_file import IniValue
from robocomp_dsl.source import Span

_TEXT = re.compile(r'"((?:[^"\\]|\\.)*)"')
_INT = re.compile(r"[+-]?\d+")
_FLOAT = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?[fF]?")
_ESCAPES = {"n": "\n", "t": "\t", "r": "\r"}
_INT64 = range(-(2**63), 2**63)


def read_constant(value: IniValue, report: Report) -> IniConstant | None:
    """The constant of `single_value`; None, with a finding, for another text."""
    if not value.text:
        help_ = 'an empty text is `""`'
        report.add(codes.INVALID_LITERAL, value.key_span, "the constant is missing", help=help_)
        return None
    return _constant(value.text, value.span, report)


def read_constants(value: IniValue, report: Report) -> tuple[IniConstant, ...] | None:
    """The constants of `list`, which may be empty; None, with findings, for another text."""
    if not value.text:
        return ()
    constants = []
    complete = True
    for start, end in _elements(value.text):
        text = value.text[start:end]
        begin = value.span.start + start + len(text) - len(text.lstrip())
        span = value.span.subspan(begin, begin + len(text.strip()))
        if not text.strip():
            at = value.span.subspan(value.span.start + max(start - 1, 0), value.span.start + end)
            message = "an element is missing beside this comma"
            report.add(codes.INVALID_LITERAL, at, message, help="delete the comma")
            complete = False
            continue
        constant = _constant(text.strip(), span, report)
        complete = complete and constant is not None
        if constant:
            constants.append(constant)
    return tuple(constants) if complete else None


def _elements(text: str) -> Iterator[tuple[int, int]]:
    """The ranges between the commas outside of quotes."""
    start, quoted, escaped = 0, False, False
    for index, letter in enumerate(text):
        if escaped:
            escaped = False
        elif letter == "\\" and quoted:
            escaped = True
        elif letter == '"':
            quoted = not quoted
        elif letter == "," and not quoted:
            yield start, index
            start = index + 1
    yield start, len(text)


def _constant(text: str, span: Span, report: Report) -> IniConstant | None:
    found = _TEXT.fullmatch(text)
    if found:
        value = re.sub(r"\\(.)", lambda m: _ESCAPES.get(m[1], m[1]), found[1])
        return IniConstant(value, span)
    if text in {"true", "false"}:
        return IniConstant(text == "true", span)
    if _INT.fullmatch(text):
        if len(text) < 25 and int(text) in _INT64:
            return IniConstant(int(text), span)
        report.add(codes.INVALID_LITERAL, span, f"`{text:.30}` does not fit into 64 bits")
        return None
    if _FLOAT.fullmatch(text):
        return IniConstant(float(text.rstrip("fF")), span)
    if '"' in text:
        message, help_ = f"the quotes of `{text:.40}` are not balanced", 'write `\\"` for a quote'
    else:
        message, help_ = f"`{text:.40}` is no constant", f'write a text in quotes: `"{text:.40}"`'
    report.add(codes.INVALID_LITERAL, span, message, help=help_)
    return None
