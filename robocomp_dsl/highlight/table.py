"""The keywords of each language, generated from the grammars.

In: `grammars/words.json`. Out: `Words` of one language.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache

from robocomp_dsl.resources import GRAMMARS

FILE = GRAMMARS / "words.json"
LANGUAGES = ("idsl", "cdsl", "pdsl", "ddsl", "smdsl", "bdsl")


@dataclass(frozen=True, slots=True)
class StatementKeywords:
    """A kind of statement, identified by its first keyword.

    `opens`: a block follows. `inner`: further keywords. `values`: words that the checks accept
    instead of a name. `legacy`: the statement has no effect.
    """

    word: str
    opens: bool
    legacy: bool
    inner: tuple[str, ...]
    values: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Words:
    """The words of a language. `keywords` maps each keyword to what may follow it.

    `plain` are the keywords of statements that start with a name; `patterns` and `units` appear in
    brackets; `durations` are units after a number.
    """

    language: str
    any_case: bool
    keywords: dict[str, tuple[str, ...]]
    statements: tuple[StatementKeywords, ...]
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
        keywords={word: tuple(followers) for word, followers in data["keywords"].items()},
        statements=tuple(
            StatementKeywords(
                word, item["opens"], item["legacy"], tuple(item["inner"]), tuple(item["values"])
            )
            for word, item in data["statements"].items()
        ),
        **{name: tuple(data[name]) for name in lists},
    )
