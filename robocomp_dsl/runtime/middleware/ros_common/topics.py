"""Which topics a subscribed port receives.

A subscriber receives from external publishers on their topics, from a publisher of a component that
a connection names on the topic that has its default name, and from all others on a topic of its
own: they publish there, too, when they are attached.
"""

from __future__ import annotations

import re

from robocomp_dsl.runtime.component.naming import ANY
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.middleware.ros_common.names import absolute_name

_SEPARATOR = ","
_NO_WORD = re.compile(r"[^A-Za-z0-9_]")


def subscribed_topics(at: Endpoint, middleware: str) -> tuple[str, ...]:
    """The topics of a subscribed port, its own first. Raises `MiddlewareError`."""
    names = [absolute_name(subscribed_name(at), at.port)]
    names += [
        absolute_name(record.address, at.port)
        for record in at.external
        if record.middleware == middleware
    ]
    for peer in at.peers:
        component, _, port = peer.partition(".")
        if component != ANY:
            names.append(absolute_name(f"{component}/{port or at.port}", at.port))
    return tuple(dict.fromkeys(names))


def subscribed_name(at: Endpoint) -> str:
    """The topic of a subscribed port of its own, without the leading `/`."""
    # A component may publish a port of the same name, and a port has a subscription for each peer.
    part = "_".join(("in", *(_NO_WORD.sub("_", peer) for peer in at.peers)))
    return f"{at.component}/{at.port}/{part}"


def topics_address(topics: tuple[str, ...]) -> str:
    """The address of a subscribed port, for its record."""
    return _SEPARATOR.join(topics)


def topic_to_attach(address: str, own: str) -> str:
    """The topic on which a publisher reaches a subscriber, besides its `own`; "" if on that."""
    topics = address.split(_SEPARATOR)
    return "" if own in topics else topics[0]
