"""The page of the middlewares agrees with their descriptions, and tells all that a run found."""

from __future__ import annotations

from robocomp_dsl.runtime.middleware.registry import BUILT_IN
from tests.middleware.conformance_table import PAGE, Results, capabilities, page, summaries

RUN: Results = {
    "zenoh": {"Shutdown": {"passed": 3, "failed": 1, "skipped": []}},
    "inproc": {
        "Shutdown": {"passed": 2, "failed": 0, "skipped": []},
        "Processes": {"passed": 0, "failed": 0, "skipped": ["it has no processes"]},
    },
}


def test_middleware_page_has_capabilities_of_all_descriptions() -> None:
    text = PAGE.read_text()
    help_text = "the page is old: run `make conformance`"
    assert summaries() in text, help_text
    assert capabilities() in text, help_text
    for name in BUILT_IN:
        assert f"- `{name}`: " in text


def test_middleware_page_shows_no_failed_case() -> None:
    results = PAGE.read_text().partition("## Conformance")[2]
    assert "| Queries and commands |" in results
    assert "**" not in results, "a failed case is printed in bold"


def test_conformance_table_shows_failures_and_reasons() -> None:
    text = page(RUN)
    assert "| Shutdown | 2 | **3 of 4** |" in text
    assert "| Processes | - | - |" in text
    assert "- `inproc` skips cases: it has no processes." in text
    assert "Not installed in this run: " in text
