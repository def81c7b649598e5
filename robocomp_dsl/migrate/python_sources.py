"""Read the Python files of an old component, in Python 3.

In: paths. Out: modules with their syntax trees. If a module of the component is Python 2, all are:
they are converted, and every conversion is reported.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.regeneration import user_module
from robocomp_dsl.generate.regeneration.python_module import decode_module, read_bytes
from robocomp_dsl.generate.regeneration.user_module import UserModule
from robocomp_dsl.migrate import codes, worker_codes
from robocomp_dsl.migrate.original_lines import ConvertedSource
from robocomp_dsl.migrate.python2 import CannotConvert, convert, looks_like_python2
from robocomp_dsl.source import Source, Span, UnreadableSource

_OLD_QT = re.compile(r"^(?:from|import)[ \t]+(?:PySide|PyQt4)\b(?!\d)", re.MULTILINE)
"""Versions of Qt's bindings that RoboComp used with Python 2 only."""
_NEW = re.compile(r"python3|\bPySide[26]\b|\bf[\"']|\bsuper\(\)|^\s*async\s|->", re.MULTILINE)
"""What only Python 3 has."""


def read_modules(paths: Sequence[Path], report: Report) -> dict[Path, UserModule | None]:
    """The modules at `paths`; None, with a finding, for a file that cannot be used."""
    texts = {path: _read(path, report) for path in paths}
    known = [entry[2] for entry in texts.values() if entry]
    is_old = any(looks_like_python2(text) and not _parses(text) for text in known) or any(
        (looks_like_python2(text) or _OLD_QT.search(text)) and not _NEW.search(text)
        for text in known
    )
    return {
        path: _module(path, *entry, report, is_old=is_old) if entry else None
        for path, entry in texts.items()
    }


def _read(path: Path, report: Report) -> tuple[bytes, str, str] | None:
    """The bytes, the encoding and the text of a file; None, with a finding, without a text."""
    try:
        data = read_bytes(path)
        if data is None:
            return None
        return (data, *_decode(data))
    except UnreadableSource as error:
        message = f"the file cannot be used: {error}"
        report.add(codes.UNREADABLE_PYTHON, Source(path, "").file_span, message)
        return None


def _decode(data: bytes) -> tuple[str, str]:
    """The encoding and the text; Python 2 read files without a declaration byte by byte."""
    try:
        return decode_module(data)
    except UnreadableSource:
        text = data.decode("iso-8859-1")
        if b"\0" in data or not looks_like_python2(text):
            raise
        return "utf-8", text


def _parses(text: str) -> bool:
    try:
        user_module.parsed(Source(Path("module.py"), text))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return False
    return True


def _module(
    path: Path, data: bytes, encoding: str, text: str, report: Report, *, is_old: bool
) -> UserModule | None:
    """The module of a text; None, with a finding, if Python cannot parse it."""
    if is_old:
        return _converted(path, data, encoding, text, report)
    try:
        return user_module.parsed(Source(path, text), data, encoding)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        span = _line_span(Source(path, text), getattr(error, "lineno", None) or 0)
        reason = getattr(error, "msg", None) or str(error)
        message = f"Python cannot read `{path.name}`: {reason}"
        report.add(codes.UNREADABLE_PYTHON, span, message)
        return None


def _converted(
    path: Path, data: bytes, encoding: str, text: str, report: Report
) -> UserModule | None:
    """The module in Python 3; None, with a finding, if it cannot be converted."""
    try:
        result = convert(text)
    except CannotConvert as error:
        if _parses(text):
            return user_module.parsed(Source(path, text), data, encoding)
        span = _line_span(Source(path, text), error.line)
        report.add(codes.UNREADABLE_PYTHON, span, f"Python cannot read `{path.name}`: {error}")
        return None
    source = ConvertedSource(path, result.text, original=Source(path, text))
    if result.text != text:
        message = f"`{path.name}` is Python 2 and was converted to Python 3"
        report.add(worker_codes.PYTHON_2, source.span(0, 0), message)
    for line, doubt in result.doubts:
        report.add(worker_codes.DIFFERENT_PROCESS, _line_span(source, line), doubt)
    return user_module.parsed(source, data, encoding)


def _line_span(source: Source, line: int) -> Span:
    """The span of a line; of the file for a line that does not exist."""
    if not 1 <= line <= len(source.line_starts):
        return source.file_span
    start = source.line_starts[line - 1]
    return source.span(start, start + len(source.line(line)))
