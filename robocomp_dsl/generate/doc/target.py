"""The target of a link in the documentation."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Target:
    """A page, by its path without suffix, and an anchor in it; "" is the start of the page."""

    page: str
    anchor: str = ""
