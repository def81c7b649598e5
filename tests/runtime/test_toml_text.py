"""Reading TOML configuration that tomllib rejects without a location."""

from __future__ import annotations

import pytest

from robocomp_dsl.finding import Finding, SourceText
from robocomp_dsl.runtime.parameters.toml_text import read_toml


@pytest.mark.parametrize("number", ["9" * 5000, "1_2" * 2500])
def test_read_toml_locates_number_with_too_many_digits(number: str) -> None:
    source = f"mode = 'a'\nrate = {number} # Hz\n"
    findings: list[Finding] = []
    assert read_toml(SourceText("a.toml", tuple(source.splitlines())), source, findings) is None
    [finding] = findings
    assert (finding.location.line, finding.location.column) == (2, len("rate = ") + 1)
    assert "digits; the limit is 4300" in finding.message
