"""Some seconds of fuzzing with fixed seeds, and regressions found by `make fuzz`."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from tests.fuzz.mutation import SUFFIXES, mutated, seeds
from tests.fuzz.oracle import judge, judge_tree

FOUND = sorted(Path(__file__).with_name("found").glob("*.*"))


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_fuzz_seeds(suffix: str) -> None:
    for text in seeds(suffix):
        judge(suffix, text)


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize("number", range(4))
def test_fuzz_mutations(suffix: str, number: int) -> None:
    rng = random.Random(number)
    for _ in range(60):
        judge(suffix, mutated(suffix, rng))


@pytest.mark.parametrize("path", FOUND, ids=lambda path: path.name)
def test_fuzz_regressions(path: Path) -> None:
    judge(path.suffix, path.read_bytes().decode("utf-8", "replace"))


def test_oracle_detects_lost_content() -> None:
    # The oracle itself: a tree that leaves a word out in silence does not pass.
    from robocomp_dsl.check.languages import PARSERS  # noqa: PLC0415
    from robocomp_dsl.syntax.parse import parse_idsl  # noqa: PLC0415

    def forgetful(source: object, report: object) -> object:
        tree = parse_idsl(source, report)  # type: ignore[arg-type]
        return type(tree)(tree.span, tree.imports, (), tree.complete)

    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(PARSERS, ".idsl", forgetful)  # type: ignore[arg-type]
        with pytest.raises(AssertionError, match="lost in silence"):
            judge_tree(".idsl", "module Lost { struct A { int a; }; };\n")
