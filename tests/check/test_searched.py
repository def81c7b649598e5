"""The checks and the running component take the same names for a search."""

from __future__ import annotations

import pytest

from robocomp_dsl.check.contexts import CONTEXT, is_searchable
from robocomp_dsl.runtime.config import WrongName, checked_context, checked_file

NAMES = (
    "lab", "lab/night", "1", "a.b-c_d", "x.yaml", "left/x.yaml", "", ".", "..", "../x", "/x",
    "a//b", "a/../b", "a/", "a b", "é", "a" * 101, "/".join("abcdefgh"), "/".join("abcdefghi"),
)  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
def test_names(name: str) -> None:
    assert bool(CONTEXT.fullmatch(name)) == _takes(checked_context, name)
    assert is_searchable(name) == _takes(checked_file, name)


def _takes(check: object, name: str) -> bool:
    try:
        check(name)  # type: ignore[operator]
    except WrongName:
        return False
    return True
