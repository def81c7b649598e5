"""Mutated texts of the repository: words replaced, removed, duplicated.

In: a random generator. Out: texts of one language.
"""

from __future__ import annotations

import random
from functools import cache
from pathlib import Path

from robocomp_dsl.check.languages import PARSERS
from robocomp_dsl.syntax.grammar.tables import load

ROOT = Path(__file__).parents[2]
FOLDERS = ("interfaces", "components", "tests/cases", "tests/format/cases", "tests/syntax")
LARGEST = 8_000
SIGNS = (
    "{",
    "}",
    ";",
    ",",
    '"',
    "/*",
    "*/",
    "//",
    "///",
    "/**",
    "<",
    ">",
    "::",
    "->",
    "=>",
    "[",
    "]",
    "(",
    ")",
    "=",
    "#",
    "é",
    "🤖",
    "\\",
    "'",
    "0x",
    "1e999",
    "-",
    ".",
    ":",
    "+",
    "&",
)
SIGNS += ("\n", "\t", "\r", "\0", "\u2028", "<<<<<<< x\n", "=======\n", "};", "<a>", "</a>", "/>")
SIGNS += (
    "<!--",
    "-->",
    "<![CDATA[",
    "]]>",
    "<?xml ",
    'a="b"',
    "[mm]",
    "99999999999999999999",
    "1:2",
)
TAGS = (
    "transform",
    "rotation",
    "translation",
    "mesh",
    "plane",
    "laser",
    "include",
    "joint",
    "rgbd",
)
TAGS += (
    "imu",
    "state",
    "transition",
    "parallel",
    "final",
    "history",
    "datamodel",
    "onentry",
    "target",
)

ROS_SUFFIXES = (".msg", ".srv", ".action")
ROS_WORDS = (
    *("int32", "uint8", "float64", "bool", "string", "string<=3", "wstring", "byte", "char"),
    *("Header", "std_msgs/Header", "time", "duration", "[3]", "[<=4]", "[]", "X=1", "---", "#"),
)
THRIFT_WORDS = (
    *("struct S {", "enum", "union", "service", "exception", "typedef", "const", "include"),
    *("namespace yarp", "extends", "throws (", "oneway", "void", "optional", "required", "list<"),
    *("map<", "set<", "i32", "double", "binary", "string", "1:", "yarp.name", "#", '"yarp::X"'),
)
BOTTLE_WORDS = (
    "int32",
    "float64",
    "string",
    "blob",
    "(",
    ")",
    "(x (int32 y))",
    "*",
    "…",
    "[m]",
    "#",
)
DEFINITION_WORDS = {
    **dict.fromkeys(ROS_SUFFIXES, ROS_WORDS),
    ".thrift": THRIFT_WORDS,
    ".bottle": BOTTLE_WORDS,
}


@cache
def seeds(suffix: str) -> tuple[str, ...]:
    """The texts of one language in this repository, the shorter half of a page each."""
    found = sorted(path for folder in FOLDERS for path in (ROOT / folder).rglob(f"*{suffix}"))
    texts = (path.read_text("utf-8", "replace") for path in found)
    remaining = tuple(text for text in texts if len(text) <= LARGEST)
    assert remaining, f"no file ends in {suffix}"
    return remaining


@cache
def words(suffix: str) -> tuple[str, ...]:
    """Keywords and punctuation of a language, and unknown characters."""
    if suffix in (".xml", ".scxml"):
        return (*TAGS, *SIGNS)
    if suffix in DEFINITION_WORDS:
        return (*DEFINITION_WORDS[suffix], *SIGNS)
    return (*sorted(load(suffix[1:]).keywords), *SIGNS, "int", "Near", "a", "x1")


def mutated(suffix: str, rng: random.Random, text: str | None = None) -> str:
    """A text of the language, mostly with mistakes in it."""
    text = rng.choice(seeds(suffix)) if text is None else text
    for _ in range(rng.randint(1, 8)):
        text = _changed(suffix, rng, text)
    return text[:LARGEST]


def _changed(suffix: str, rng: random.Random, text: str) -> str:
    start = rng.randint(0, len(text))
    end = min(len(text), start + rng.choice((0, 1, 1, 5, 60, 400)))
    match rng.randint(0, 6):
        case 0:
            return text[:start] + text[end:]
        case 1 | 2:
            return (
                f"{text[:start]}{rng.choice(('', ' '))}{rng.choice(words(suffix))} {text[start:]}"
            )
        case 3:
            return text[:end] + text[start:end] * rng.choice((1, 1, 30)) + text[end:]
        case 4:
            return text[:start] + text[start:end].swapcase() + text[end:]
        case 5:
            other = rng.choice(seeds(suffix))
            cut = rng.randint(0, len(other))
            return text[:start] + other[cut : cut + rng.choice((20, 200))] + text[end:]
        case _:
            return text[:start] + text[start:end][::-1] + text[end:]


SUFFIXES = tuple(sorted(PARSERS))
