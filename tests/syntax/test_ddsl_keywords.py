"""Keywords of DDSL are names wherever the grammar has no place for the keyword."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from robocomp_dsl.check.languages import check_syntax
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.resources import GRAMMARS

WORDS = sorted(json.loads((GRAMMARS / "words.json").read_text())["ddsl"]["keywords"])
TEXT = """
Deployment {word}
{{
    host {word} {{ address "127.0.0.1"; }};
    component {word} : {word} on {word}
    {{
        after {word}, {word};
        set {word}.{word}[0] = {word};
        env {word} = {word};
        port {word} over {word} at "x";
        device {word} : {word} {{ set {word} = 1; }};
    }};
    extern {word} over {word} at "x" implements {word}::{word};
    connect {word}.{word} -> {word}.{word} over {word}
    {{
        monitor "x.py" {word} {{ {word} = {word}; }} at sender on failure close;
    }};
    arbitrate {word}.{word} {{ from {word}.{word} when {word} && a; }};
    group {word} on {word} {{ component {word}; export {word} from {word} as {word}; }};
}};
"""
OPERATORS = {"and", "not", "or"}


@pytest.mark.parametrize("word", WORDS)
def test_keyword_of_ddsl_may_be_a_name(tmp_path: Path, word: str) -> None:
    text = TEXT.format(word=word)
    if word in OPERATORS:  # an event cannot be called like an operator
        text = text.replace(f"when {word} && a", "when a")
    path = tmp_path / "app.ddsl"
    path.write_text(text)
    report = Report()
    check_syntax(path, Workspace(environ={}), report)
    assert [f"{f.span.start_position[0]}: {f.message}" for f in report] == []
