"""A published port on one middleware."""

from __future__ import annotations

from dataclasses import dataclass

from robocomp_dsl.runtime.middleware.capabilities import Capabilities
from robocomp_dsl.runtime.middleware.transport import Publisher
from robocomp_dsl.runtime.presence.presence import PublicationNumbers


@dataclass(slots=True)
class PublishedPort:
    """The port on one middleware; `numbers` is None if its publications carry none."""

    middleware: str
    capabilities: Capabilities
    publisher: Publisher
    numbers: PublicationNumbers | None = None
