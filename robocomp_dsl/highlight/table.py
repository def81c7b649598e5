"""The words of each language, as made from the grammars.

In: `grammars/words.json`. Out: `Words` of one language.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache

from robocomp_dsl.resources import GRAMMARS

FILE = GRAMMARS / "words.json"
LANGUAGES = ("idsl", "cdsl", "pdsl", "ddsl", "smdsl")


@dataclass(frozen=True, slots=True)
class Statement:
    """A kind of statement: its first word, and what that says about the rest.

    `opens`: a block follows. `inner`: keywords behind the first. `values`: words that the checks
    know in the place of a name. `legacy`: the statement has no effect any more.
    """

    word: str
    opens: bool
    legacy: bool
    inner: tuple[str, ...]
    values: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Words:
    """One language. `keywords` maps each to what may stand behind it: a kind of word or a sign.

    `plain` are the keywords of statements that begin with a name; `patterns` and `units` stand in
    brackets; `durations` are units behind a number.
    """

    language: str
    any_case: bool
    keywords: dict[str, tuple[str, ...]]
    statements: tuple[Statement, ...]
    plain: tuple[str, ...]
    types: tuple[str, ...]
    truth: tuple[str, ...]
    patterns: tuple[str, ...]
    durations: tuple[str, ...]
    units: tuple[str, ...]


@cache
def words(language: str) -> Words:
    """The words of `language`, one of `LANGUAGES`."""
    data = json.loads(FILE.read_text(encoding="utf-8"))[language]
    lists = ("plain", "types", "truth", "patterns", "durations", "units")
    return Words(
        language=language,
        any_case=data["any_case"],
        keywords={word: tuple(behind) for word, behind in data["keywords"].items()},
        statements=tuple(
            Statement(word, one["opens"], one["legacy"], tuple(one["inner"]), tuple(one["values"]))
            for word, one in data["statements"].items()
        ),
        **{name: tuple(data[name]) for name in lists},
    )
