"""Which middlewares and which cases of the suite run."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from robocomp_dsl.runtime.middleware.capabilities import QOS_ITEMS, Capabilities
from robocomp_dsl.runtime.middleware.registry import (
    description_of,
    middleware_names,
    missing_modules,
)

_WHY = {
    "between_processes": "it connects components of one process only (between_processes)",
    "services": "it has no services (services)",
    "topics": "it has no topics (topics)",
    "sequence_numbers": "its publications carry no numbers (sequence_numbers)",
    "reports_source": "it does not tell the publisher of a message (reports_source)",
}


def tested_middlewares(chosen: Sequence[str]) -> list[str]:
    """The chosen middlewares, by default all whose required modules are installed.

    Those that carry ROS types only have a suite of their own, in `tests/middleware/ros2`. Raises
    `pytest.UsageError` for a name that cannot be tested.
    """
    names = chosen or [name for name in middleware_names() if not missing(name)]
    for name in names:
        if reason := missing(name):
            raise pytest.UsageError(reason)
    return list(names)


def missing(name: str) -> str:
    """Why a middleware cannot be tested, and how to install it; empty if it can."""
    description = description_of(name)
    if description and description.capabilities.ros_types_only:
        return (
            f"`{name}` carries ROS types only, which this suite has not: see tests/middleware/ros2"
        )
    if description is None:
        return f"unknown middleware `{name}`; installed: {', '.join(middleware_names())}"
    modules = missing_modules(description)
    return f"`{name}` needs {', '.join(modules)}; {description.install}" if modules else ""


def missing_capability(capabilities: Capabilities, need: str) -> str:
    """Why a case that needs `need` is skipped; empty if it is not.

    `need` is an item of `QOS_ITEMS`, a field of `Capabilities` that must be true, or a message
    size in bytes.
    """
    if need.isdigit():
        limit = capabilities.max_message_bytes
        return f"messages have at most {limit} bytes" if 0 < limit < int(need) else ""
    available = need in capabilities.qos if need in QOS_ITEMS else getattr(capabilities, need)
    return "" if available else _WHY.get(need, f"it has no `{need}`")
