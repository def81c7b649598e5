"""The checks and the runtime accept the same names of contexts and files."""

from __future__ import annotations

import pytest

from robocomp_dsl.check.ddsl.contexts import CONTEXT, is_searchable
from robocomp_dsl.runtime.config import InvalidName, validate_context, validate_file

NAMES = (
    "lab", "lab/night", "1", "a.b-c_d", "x.yaml", "left/x.yaml", "", ".", "..", "../x", "/x",
    "a//b", "a/../b", "a/", "a b", "é", "a" * 101, "/".join("abcdefgh"), "/".join("abcdefghi"),
)  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
def test_context_pattern_equals_runtime(name: str) -> None:
    assert bool(CONTEXT.fullmatch(name)) == _accepts(validate_context, name)
    assert is_searchable(name) == _accepts(validate_file, name)


def _accepts(check: object, name: str) -> bool:
    try:
        check(name)  # type: ignore[operator]
    except InvalidName:
        return False
    return True
