"""The errors of parameters: an invalid configuration, and a rejected change."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

from robocomp_dsl.finding import Finding


class ConfigError(Exception):
    """An invalid configuration; `findings` lists all problems, the text shows their locations."""

    def __init__(self, findings: Iterable[Finding]) -> None:
        self.findings = tuple(findings)
        super().__init__("\n\n".join(finding.render() for finding in self.findings))


class ParameterRejected(Exception):
    """A live change was rejected. Raised by `will_set` hooks and by `Parameters.set`."""

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(reason)


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """The label ``did you mean `x`?``, or an empty string."""
    names = list(known)
    lowered = {name.lower(): name for name in reversed(names)}
    near = get_close_matches(word.lower(), lowered, n=1, cutoff=0.6)
    return f"did you mean `{lowered[near[0]]}`?" if near else ""
