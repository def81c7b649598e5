"""What a ROS master knows, for tools and generators: types and publishers of topics.

In: the URI of a master. Out: names; `MiddlewareError` when the master does not reply, or does not
know the topic.
"""

from __future__ import annotations

import os
from typing import Any

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.ros1.settings import master_uri
from robocomp_dsl.runtime.middleware.ros1.xmlrpc import RosApi, RosApiError

TIMEOUT_S = 2.0
CALLER = "/robocomp_dsl"
ANY_TYPE = "*"
"""The type of a topic to which only subscribers of any type are connected."""


def topic_types(master: str = "", timeout: float = TIMEOUT_S) -> dict[str, str]:
    """The types of all topics, as `std_msgs/String`; unknown ones (`*`) are left out.

    `master` is its URI; empty: ROS_MASTER_URI, else that of this machine. `timeout` in s.
    """
    pairs = _ask(master, timeout, "getTopicTypes")
    return {str(name): str(type_) for name, type_ in pairs if type_ != ANY_TYPE}


def topic_type(master: str, topic: str, timeout: float = TIMEOUT_S) -> str:
    """The type of a topic, as `std_msgs/String`. Raises `MiddlewareError`."""
    types = topic_types(master, timeout)
    name = f"/{topic.lstrip('/')}"
    if name in types:
        return types[name]
    known = ", ".join(sorted(types)[:10]) or "none"
    raise MiddlewareError(
        f"the ROS master {master_uri(master, os.environ)} knows no type of the topic {name}: start"
        f" its publisher first; known topics: {known}"
    )


def topic_publishers(topic: str, master: str = "", timeout: float = TIMEOUT_S) -> list[str]:
    """The names of the nodes that publish a topic."""
    publishers, _, _ = _ask(master, timeout, "getSystemState")
    return [str(node) for name, nodes in publishers for node in nodes if name == topic]


def _ask(master: str, timeout: float, method: str) -> Any:
    api = RosApi(master_uri(master, os.environ), timeout)
    try:
        return api.call(method, CALLER)
    except RosApiError as error:
        hint = "; start it with `roscore`" if error.is_unreachable else ""
        raise MiddlewareError(f"the ROS master {error}{hint}") from None
    finally:
        api.close()
