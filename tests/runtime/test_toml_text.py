"""Reading TOML configuration that tomllib rejects without a location."""

from __future__ import annotations

import random
import tomllib

import pytest

from robocomp_dsl.finding import Finding, Location, SourceText
from robocomp_dsl.runtime.parameters.toml_arrays import element_places
from robocomp_dsl.runtime.parameters.toml_text import read_toml


@pytest.mark.parametrize("number", ["9" * 5000, "1_2" * 2500])
def test_read_toml_locates_number_with_too_many_digits(number: str) -> None:
    source = f"mode = 'a'\nrate = {number} # Hz\n"
    findings: list[Finding] = []
    assert read_toml(SourceText("a.toml", tuple(source.splitlines())), source, findings) is None
    [finding] = findings
    assert (finding.location.line, finding.location.column) == (2, len("rate = ") + 1)
    assert "digits; the limit is 4300" in finding.message


def random_array(rng: random.Random, depth: int = 0) -> str:
    """An array with comments, strings with brackets, and arrays and tables in it."""
    leaves = ["7", '"a]b, #\\" c"', "'x,[ '", "true"]
    if depth < 2:
        leaves += [random_array(rng, depth + 1), "{a = [1, 2], b = 'x'}"]
    gaps = ("", " ", "\n  ", "\n # c, [\n")
    text = ""
    for _ in range(rng.randrange(5)):
        text += f"{rng.choice(gaps)}{rng.choice(leaves)}{rng.choice(gaps)},"
    return f"[{text if rng.random() < 0.5 else text[:-1]}{rng.choice(gaps)}]"


def test_element_places_finds_each_element_of_random_arrays() -> None:
    rng = random.Random(5)
    for _ in range(300):
        text = f"x = {random_array(rng)}\n"
        elements = tomllib.loads(text)["x"]
        array = Location(SourceText.of_text("x.toml", text), 1, 5)
        places = list(element_places(array))
        assert len(places) == len(elements), text
        firsts = {place.excerpt[place.column - 1] for place in places}
        assert firsts <= set("7\"'t[{"), text
