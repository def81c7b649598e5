"""What `rcgen explain` shows as wrong gives that finding; what it shows as right does not."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from robocomp_dsl.diagnostics import Code, Report
from robocomp_dsl.source import Source
from robocomp_dsl.syntax import (
    codes,
    parse_cdsl,
    parse_ddsl,
    parse_idsl,
    parse_innermodel,
    parse_pdsl,
    parse_smdsl,
)

HEADS = {
    r"^\s*ComponentParams\b": (".pdsl", parse_pdsl),
    r"^\s*Deployment\b": (".ddsl", parse_ddsl),
    r"\b(initial_state|transitions?)\b": (".smdsl", parse_smdsl),
    r"^\s*(Component|Communications)\b": (".cdsl", parse_cdsl),
    r"^\s*(module|Module|struct|interface|import)\b": (".idsl", parse_idsl),
    r"^\s*<": (".xml", parse_innermodel),
}
EXAMPLE = re.compile(r"^(Wrong|Right)[^\n]*:\n\n((?:    [^\n]*\n|\n)+)", re.MULTILINE)
CODES = sorted(
    (one for one in vars(codes).values() if isinstance(one, Code)), key=lambda one: one.id
)


def examples(code: Code) -> list[tuple[str, str]]:
    return [
        (kind, re.sub(r"^    ", "", text, flags=re.MULTILINE).strip() + "\n")
        for kind, text in EXAMPLE.findall(code.explanation)
    ]


def found(text: str) -> set[str]:
    for head, (suffix, parse) in HEADS.items():
        if re.search(head, text, re.MULTILINE | re.IGNORECASE):
            report = Report()
            parse(Source(Path(f"example{suffix}"), text), report)
            return {one.code.id for one in report}
    raise AssertionError(f"which language is this?\n{text}")


@pytest.mark.parametrize("code", [c for c in CODES if examples(c)], ids=lambda c: c.id)
def test_examples(code: Code) -> None:
    for kind, text in examples(code):
        if kind == "Wrong":
            assert code.id in found(text), text
        else:
            assert code.id not in found(text), text


def test_most_codes_have_examples() -> None:
    assert len([c for c in CODES if examples(c)]) >= 30


def test_ids_are_unique() -> None:
    ids = [one.id for one in CODES]
    assert len(ids) == len(set(ids))
