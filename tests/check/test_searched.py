"""The checks and the running component take the same names for a search."""

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
    assert bool(CONTEXT.fullmatch(name)) == _takes(validate_context, name)
    assert is_searchable(name) == _takes(validate_file, name)


def _takes(check: object, name: str) -> bool:
    try:
        check(name)  # type: ignore[operator]
    except InvalidName:
        return False
    return True
