"""Findings in the forms that `--format` offers. In: diagnostics. Out: text for standard output."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from robocomp_dsl.cli import render
from robocomp_dsl.diagnostics import Diagnostic, Severity

_GITHUB = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "notice"}


def concise(findings: Sequence[Diagnostic]) -> str:
    """A line for each: `robot.cdsl:7:18: error[RC204]: message`."""
    return "".join(f"{_concise(one)}\n" for one in findings)


def _concise(one: Diagnostic) -> str:
    line, column = one.span.begin
    where = f"{_one_line(render.shown_path(one.span.source.path))}:{line}:{column}"
    label = f" ({_one_line(one.label)})" if one.label else ""
    return f"{where}: {one.severity}[{one.code.id}]: {_one_line(one.message)}{label}"


def _one_line(text: str) -> str:
    return render.harmless(text).replace("\n", " ")


def as_json(findings: Sequence[Diagnostic]) -> str:
    """One list; lines and columns from 1, the end column just behind the last character."""
    import json  # noqa: PLC0415 - the other forms start without it

    return json.dumps([_record(one) for one in findings], indent=1) + "\n"


def _record(one: Diagnostic) -> dict[str, str | int]:
    (line, column), (end_line, end_column) = one.span.begin, one.span.finish
    return {
        "code": one.code.id,
        "severity": str(one.severity),
        "message": one.message,
        "file": str(one.span.source.path),
        "line": line,
        "column": column,
        "end_line": end_line,
        "end_column": end_column,
    }


def github(findings: Sequence[Diagnostic]) -> str:
    """Workflow commands, which GitHub shows beside the changed lines of a pull request."""
    return "".join(f"{_github(one)}\n" for one in findings)


def _github(one: Diagnostic) -> str:
    record = _record(one)
    keys = {
        "file": "file", "line": "line", "col": "column",
        "endLine": "end_line", "endColumn": "end_column", "title": "code",
    }  # fmt: skip
    properties = ",".join(f"{key}={_property(str(record[name]))}" for key, name in keys.items())
    label = f": {one.label}" if one.label else ""
    return f"::{_GITHUB[one.severity]} {properties}::{_message(one.message + label)}"


def _message(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _message(text).replace(":", "%3A").replace(",", "%2C")


def as_sarif(findings: Sequence[Diagnostic]) -> str:
    """A log of SARIF 2.1.0."""
    from robocomp_dsl.cli.sarif import sarif  # noqa: PLC0415 - the other forms start without it

    return sarif(findings)


FORMATS: dict[str, Callable[[Sequence[Diagnostic]], str]] = {
    "full": render.full,
    "concise": concise,
    "json": as_json,
    "github": github,
    "sarif": as_sarif,
}
