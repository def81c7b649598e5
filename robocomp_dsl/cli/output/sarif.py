"""Findings as a log of SARIF 2.1.0 (OASIS standard), which code scanners and editors read.

In: diagnostics. Out: the JSON text. Columns count characters, as everywhere in this project.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any
from urllib.parse import quote

from robocomp_dsl import __version__
from robocomp_dsl.diagnostics import Code, Diagnostic, Fix
from robocomp_dsl.source import Span

VERSION = "2.1.0"
SCHEMA = (
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
)

Record = dict[str, Any]


def sarif(findings: Sequence[Diagnostic]) -> str:
    """A log with one run; its rules are the codes that were found, sorted."""
    codes = {finding.code.id: finding.code for finding in findings}
    rules = sorted(codes)
    run = {
        "tool": {
            "driver": {
                "name": "rcgen",
                "version": __version__,
                "rules": [_rule(codes[rule]) for rule in rules],
            }
        },
        "columnKind": "unicodeCodePoints",
        "results": [_result(finding, rules.index(finding.code.id)) for finding in findings],
    }
    return json.dumps({"$schema": SCHEMA, "version": VERSION, "runs": [run]}, indent=1) + "\n"


def _rule(code: Code) -> Record:
    return {
        "id": code.id,
        "shortDescription": {"text": code.title},
        "help": {"text": code.explanation},
        "defaultConfiguration": {"level": str(code.severity)},
    }


def _result(finding: Diagnostic, rule: int) -> Record:
    message = "\n".join(part for part in (finding.message, finding.label, finding.help) if part)
    result: Record = {
        "ruleId": finding.code.id,
        "ruleIndex": rule,
        "level": str(finding.severity),
        "message": {"text": message},
        "locations": [_location(finding.span)],
    }
    if finding.notes:
        result["relatedLocations"] = [
            _location(note.span) | {"id": number, "message": {"text": note.message}}
            for number, note in enumerate(finding.notes)
        ]
    if finding.fix:
        result["fixes"] = [_fix(finding.fix)]
    return result


def _location(span: Span) -> Record:
    artifact = {"uri": _uri(span.source.path)}
    return {"physicalLocation": {"artifactLocation": artifact, "region": _region(span)}}


def _region(span: Span) -> Record:
    (line, column), (end_line, end_column) = span.start_position, span.end_position
    return {
        "startLine": line,
        "startColumn": column,
        "endLine": end_line,
        "endColumn": end_column,
    }


def _fix(fix: Fix) -> Record:
    paths = dict.fromkeys(edit.span.source.path for edit in fix.edits)
    return {
        "description": {"text": fix.title},
        "artifactChanges": [
            {
                "artifactLocation": {"uri": _uri(path)},
                "replacements": list(_replacements(fix, path)),
            }
            for path in paths
        ],
    }


def _replacements(fix: Fix, path: Path) -> Iterable[Record]:
    for edit in fix.edits:
        if edit.span.source.path == path:
            yield {
                "deletedRegion": _region(edit.span),
                "insertedContent": {"text": edit.text},
            }


def _uri(path: Path) -> str:
    """A path as given, so that a relative one stays relative to the working folder (RFC 3986)."""
    # Through bytes, because file names need not be valid text.
    return path.as_uri() if path.is_absolute() else quote(os.fsencode(path.as_posix()))
