"""Observes the running deployment as a client of its domain.

In: the name of a domain. Out: proxies of the introspection interface of every component, and of the
path logger's recording.
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
        """Fetches the `PathSummary` of the logger `name`."""
        summary: Callable[[], Any] = self.operations(
            load_generated_interfaces(LOGGER).PATHLOG, name, "PathLog"
        ).getSummary
        return summary
