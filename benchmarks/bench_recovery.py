"""How well one fault in a correct file is reported: one error, at its place, with the right fix.

Faults of one token in the interface library, the shipped components, the correct files of the tests
and the examples of the documents. A changed text that is still correct does not count. The share of
restored texts counts every text with an error, whether a fix is offered or not.
"""

from __future__ import annotations

import random
from typing import Any

from benchmarks.token_faults import KINDS, SUFFIXES, Outcome, faults, judge

COUNT = 250
"""Faults for each language and kind."""
SEED = 16
GOALS = {"one error": 97, "first error within a line": 99.5, "fix restores the text": 75}


def measure(suffix: str, kind: str, count: int = COUNT) -> list[Outcome]:
    """The outcomes of faults of one kind in one language."""
    rng = random.Random(f"{SEED}{suffix}{kind}")
    outcomes = (judge(fault) for fault in faults(suffix, kind, count, rng))
    return [outcome for outcome in outcomes if outcome]


def rows(name: str, outcomes: list[Outcome]) -> list[dict[str, Any]]:
    """The three rates of the outcomes, in percent."""
    total = max(len(outcomes), 1)
    counts = (
        sum(outcome.errors == 1 for outcome in outcomes),
        sum(outcome.near for outcome in outcomes),
        sum(outcome.restored for outcome in outcomes),
    )
    return [
        {
            "name": f"{name} ({len(outcomes)}): {rate}",
            "value": 100 * count / total,
            "unit": "%",
            "goal": goal,
            "better": "higher",
        }
        for (rate, goal), count in zip(GOALS.items(), counts, strict=True)
    ]


def run() -> list[dict[str, Any]]:
    """The rates of all faults, of each language and of each kind of fault."""
    outcomes = {(suffix, kind): measure(suffix, kind) for suffix in SUFFIXES for kind in KINDS}
    groups = {"all": list(outcomes)}
    groups |= {suffix: [key for key in outcomes if key[0] == suffix] for suffix in SUFFIXES}
    groups |= {kind: [key for key in outcomes if key[1] == kind] for kind in KINDS}
    return [
        figure
        for name, keys in groups.items()
        for figure in rows(name, [outcome for key in keys for outcome in outcomes[key]])
    ]
