"""The examples of `rcgen explain`: the wrong one gives the code, the correct one does not."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from robocomp_dsl.cli.rcgen.explain import stage_codes
from robocomp_dsl.diagnostics import Code, Report
from robocomp_dsl.source import Source
from robocomp_dsl.syntax.parse import (
    parse_bdsl,
    parse_bottle,
    parse_cdsl,
    parse_ddsl,
    parse_idsl,
    parse_innermodel,
    parse_pdsl,
    parse_ros,
    parse_smdsl,
    parse_thrift,
)

HEADS = {
    r"^\s*\d+:|^\s*(service|union)\b|\byarp\.name\b": (".thrift", parse_thrift),
    r"^\((\w+ )+": (".bottle", parse_bottle),
    r"^\s*ComponentParams\b": (".pdsl", parse_pdsl),
    r"^\s*Deployment\b": (".ddsl", parse_ddsl),
    r"^\s*Bridge\b": (".bdsl", parse_bdsl),
    r"\b(initial_state|transitions?)\b": (".smdsl", parse_smdsl),
    r"^\s*(Component|Communications)\b": (".cdsl", parse_cdsl),
    r"^\s*(module|Module|struct|interface|import)\b": (".idsl", parse_idsl),
    r"^\s*<": (".xml", parse_innermodel),
    r"^(float32|w?string)\b": (".msg", parse_ros),
}
EXAMPLE = re.compile(r"^(Wrong|Right)[^\n]*:\n\n((?:    [^\n]*\n|\n)+)", re.MULTILINE)
CODES = sorted(stage_codes("syntax"), key=lambda code: code.id)


def examples(code: Code) -> list[tuple[str, str]]:
    return [
        (kind, re.sub(r"^    ", "", text, flags=re.MULTILINE).strip() + "\n")
        for kind, text in EXAMPLE.findall(code.explanation)
    ]


def reported_codes(text: str) -> set[str]:
    for head, (suffix, parse) in HEADS.items():
        if re.search(head, text, re.MULTILINE | re.IGNORECASE):
            report = Report()
            parse(Source(Path(f"example{suffix}"), text), report)
            return {diagnostic.code.id for diagnostic in report}
    raise AssertionError(f"unknown language:\n{text}")


@pytest.mark.parametrize("code", [c for c in CODES if examples(c)], ids=lambda c: c.id)
def test_explanation_examples(code: Code) -> None:
    for kind, text in examples(code):
        if kind == "Wrong":
            assert code.id in reported_codes(text), text
        else:
            assert code.id not in reported_codes(text), text


def test_most_explanations_have_examples() -> None:
    assert len([c for c in CODES if examples(c)]) >= 30


def test_code_ids_are_unique() -> None:
    ids = [code.id for code in CODES]
    assert len(ids) == len(set(ids))
