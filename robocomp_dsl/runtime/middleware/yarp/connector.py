"""Connects ports of any programs of YARP, as `yarp connect` does.

In: names of ports. Out: administrative commands to the sending port.
"""

from __future__ import annotations

from typing import Any

from robocomp_dsl.runtime.codec.bottle.from_bottle import as_items
from robocomp_dsl.runtime.codec.bottle.values import vocab
from robocomp_dsl.runtime.middleware.external_connector import ConnectorError
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost
from robocomp_dsl.runtime.middleware.yarp.addresses import PortAddress
from robocomp_dsl.runtime.middleware.yarp.name_client import (
    NameClient,
    NameServerLost,
    name_server_address,
)
from robocomp_dsl.runtime.middleware.yarp.outgoing import ask_admin

TIMEOUT_S = 2.0
"""Limit of one question to a port."""
_SENDER = "admin"
_DEFAULT_CARRIER = "tcp"


class YarpConnector:
    """See `ExternalConnector`."""

    def __init__(self, names: NameClient) -> None:
        self._names = names

    def _find(self, name: str) -> PortAddress:
        try:
            found = self._names.query(name)
        except NameServerLost as error:
            raise ConnectorError(f"the name server cannot be reached: {error}") from None
        if found is None:
            raise ConnectorError(f"the name server knows no port {name}")
        return found

    def _ask(self, name: str, *command: Any) -> list[Any]:
        try:
            return as_items(ask_admin(self._find(name), _SENDER, list(command), TIMEOUT_S))
        except ConnectionLost as error:
            raise ConnectorError(f"{name} does not answer: {error}") from None

    def connected(self, source: str, targets: frozenset[str]) -> frozenset[str]:
        """See `ExternalConnector`."""
        return targets & {str(each) for each in self._ask(source, vocab("list"), vocab("out"))}

    def connect(self, source: str, target: str, carrier: str) -> None:
        """See `ExternalConnector`."""
        self._find(target)
        reply = self._ask(source, vocab("add"), target, carrier or _DEFAULT_CARRIER)
        if not reply or reply[0] != 0:
            text = reply[1].strip() if len(reply) > 1 and isinstance(reply[1], str) else ""
            raise ConnectorError(text or f"{source} refused the connection to {target}")

    def disconnect(self, source: str, target: str) -> None:
        """See `ExternalConnector`."""
        self._ask(source, vocab("del"), target)


def open_connector() -> YarpConnector:
    """A connector that uses the name server of `yarp.conf`."""
    return YarpConnector(NameClient(name_server_address("")))
