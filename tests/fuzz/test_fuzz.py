"""Some seconds of fuzzing with fixed seeds, and regressions found by `make fuzz`."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from tests.fuzz.mutation import SUFFIXES, mutated, seeds
from tests.fuzz.oracle import assert_properties, assert_tree_is_valid

FOUND = sorted(Path(__file__).with_name("found").glob("*.*"))


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_fuzz_seeds(suffix: str) -> None:
    for text in seeds(suffix):
        assert_properties(suffix, text)


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize("number", range(4))
def test_fuzz_mutations(suffix: str, number: int) -> None:
    rng = random.Random(number)
    for _ in range(60):
        assert_properties(suffix, mutated(suffix, rng))


@pytest.mark.parametrize("path", FOUND, ids=lambda path: path.name)
def test_fuzz_regressions(path: Path) -> None:
    assert_properties(path.suffix, path.read_bytes().decode("utf-8", "replace"))


def test_oracle_detects_lost_content() -> None:
    # A tree that lacks a word of the text violates a property.
    from robocomp_dsl.check.languages import PARSERS  # noqa: PLC0415
    from robocomp_dsl.syntax.parse import parse_idsl  # noqa: PLC0415

    def parse_without_declarations(source: object, report: object) -> object:
        tree = parse_idsl(source, report)  # type: ignore[arg-type]
        return type(tree)(tree.span, tree.imports, (), tree.complete)

    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(PARSERS, ".idsl", parse_without_declarations)  # type: ignore[arg-type]
        with pytest.raises(AssertionError, match="lost silently"):
            assert_tree_is_valid(".idsl", "module Lost { struct A { int a; }; };\n")
