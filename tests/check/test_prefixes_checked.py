"""The checks and running components take the same prefixes, and see the same neighbours."""

from __future__ import annotations

import random

import pytest

from robocomp_dsl.check.prefixes import PREFIX, nearest, on_branch
from robocomp_dsl.runtime import naming
from robocomp_dsl.runtime.settings import WrongSetting, parse_prefix

PREFIXES = (
    "left", "left/hand", "_", "a.b-c_d", "1", "-a", "..", "a/../b", "a//b", "a b", "é", "a" * 100,
    "a" * 101, "/".join("abcdefgh"), "/".join("abcdefghi"),
)  # fmt: skip


@pytest.mark.parametrize("prefix", PREFIXES)
def test_prefixes(prefix: str) -> None:
    assert bool(PREFIX.fullmatch(prefix)) == _takes(prefix)


def test_neighbours() -> None:
    chance = random.Random(7)
    for _ in range(500):
        mine, *others = ["/".join(chance.choices("ab", k=chance.randrange(4))) for _ in range(6)]
        names = [f"{one}/c".lstrip("/") for one in others]
        me = f"{mine}/me".lstrip("/")
        seen = on_branch(mine, names, naming.prefix_of)
        assert seen == [one for one in names if naming.related(me, one)]
        assert nearest(mine, seen, naming.prefix_of) == naming.nearest(me, seen, str)


def _takes(prefix: str) -> bool:
    try:
        parse_prefix(prefix)
    except WrongSetting:
        return False
    return True
