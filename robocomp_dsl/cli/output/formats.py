"""Findings in the forms that `--format` offers. In: diagnostics. Out: text for standard output."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from robocomp_dsl.cli.output import render
from robocomp_dsl.diagnostics import Diagnostic, Severity

_GITHUB = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "notice"}


def concise(findings: Sequence[Diagnostic]) -> str:
    """A line for each: `robot.cdsl:7:18: error[RC204]: message`."""
    return "".join(f"{_concise(finding)}\n" for finding in findings)


def _concise(finding: Diagnostic) -> str:
    line, column = finding.span.start_position
    where = f"{_one_line(render.display_path(finding.span.source.path))}:{line}:{column}"
    label = f" ({_one_line(finding.label)})" if finding.label else ""
    return f"{where}: {finding.severity}[{finding.code.id}]: {_one_line(finding.message)}{label}"


def _one_line(text: str) -> str:
    return render.strip_control_chars(text).replace("\n", " ")


def as_json(findings: Sequence[Diagnostic]) -> str:
    """One list; lines and columns from 1, the end column is one after the last character."""
    import json  # noqa: PLC0415 - the other forms start without it

    return json.dumps([_record(finding) for finding in findings], indent=1) + "\n"


def _record(finding: Diagnostic) -> dict[str, str | int]:
    (line, column), (end_line, end_column) = finding.span.start_position, finding.span.end_position
    return {
        "code": finding.code.id,
        "severity": str(finding.severity),
        "message": finding.message,
        "file": str(finding.span.source.path),
        "line": line,
        "column": column,
        "end_line": end_line,
        "end_column": end_column,
    }


def github(findings: Sequence[Diagnostic]) -> str:
    """Workflow commands, which GitHub shows beside the changed lines of a pull request."""
    return "".join(f"{_github(finding)}\n" for finding in findings)


def _github(finding: Diagnostic) -> str:
    record = _record(finding)
    keys = {
        "file": "file", "line": "line", "col": "column",
        "endLine": "end_line", "endColumn": "end_column", "title": "code",
    }  # fmt: skip
    properties = ",".join(f"{key}={_property(str(record[name]))}" for key, name in keys.items())
    label = f": {finding.label}" if finding.label else ""
    return f"::{_GITHUB[finding.severity]} {properties}::{_message(finding.message + label)}"


def _message(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _message(text).replace(":", "%3A").replace(",", "%2C")


def as_sarif(findings: Sequence[Diagnostic]) -> str:
    """A log of SARIF 2.1.0."""
    from robocomp_dsl.cli.output.sarif import sarif  # noqa: PLC0415 - the other forms start without it

    return sarif(findings)


FORMATS: dict[str, Callable[[Sequence[Diagnostic]], str]] = {
    "full": render.full,
    "concise": concise,
    "json": as_json,
    "github": github,
    "sarif": as_sarif,
}
