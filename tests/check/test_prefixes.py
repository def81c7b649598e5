"""The checks and the runtime accept the same prefixes and find the same peers."""

from __future__ import annotations

import random

import pytest

from robocomp_dsl.check.ddsl.prefixes import PREFIX, nearest, on_branch
from robocomp_dsl.runtime.component import naming
from robocomp_dsl.runtime.component.invalid_setting import InvalidSetting
from robocomp_dsl.runtime.component.settings import parse_prefix

PREFIXES = (
    "left", "left/hand", "_", "a.b-c_d", "1", "-a", "..", "a/../b", "a//b", "a b", "é", "a" * 100,
    "a" * 101, "/".join("abcdefgh"), "/".join("abcdefghi"),
)  # fmt: skip


@pytest.mark.parametrize("prefix", PREFIXES)
def test_prefix_pattern_equals_runtime(prefix: str) -> None:
    assert bool(PREFIX.fullmatch(prefix)) == _accepts(prefix)


def test_visible_peers_equal_runtime() -> None:
    rng = random.Random(7)
    for _ in range(500):
        mine, *others = ["/".join(rng.choices("ab", k=rng.randrange(4))) for _ in range(6)]
        names = [f"{diagnostic}/c".lstrip("/") for diagnostic in others]
        me = f"{mine}/me".lstrip("/")
        seen = on_branch(mine, names, naming.namespace_of)
        assert seen == [name for name in names if naming.on_same_branch(me, name)]
        assert nearest(mine, seen, naming.namespace_of) == naming.nearest(me, seen, str)


def _accepts(prefix: str) -> bool:
    try:
        parse_prefix(prefix)
    except InvalidSetting:
        return False
    return True
