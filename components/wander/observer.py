"""A look at the running deployment from outside, as any program of the domain can take it.

In: the name of a domain. Out: proxies of the introspection interface that every component serves,
and of what the path logger has recorded.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from robocomp_dsl.runtime.client import DomainClient, load_generated_interfaces

LOGGER = Path(__file__).parents[1] / "path_logger"


class Observer(DomainClient):
    """Proxies of one domain; `close` it at the end."""

    def path(self, name: str = "path_logger") -> Callable[[], Any]:
        """Asks the logger called `name` for the `PathSummary` of what it has recorded."""
        summary: Callable[[], Any] = self.operations(
            load_generated_interfaces(LOGGER).PATHLOG, name, "PathLog"
        ).getSummary
        return summary
