"""Connects ports of programs that are no components. Protocol; transports implement it."""

from __future__ import annotations

from typing import Protocol


class ConnectorError(Exception):
    """A port cannot be asked, or a connection cannot be made; the message tells why."""


class ExternalConnector(Protocol):
    """Asks and connects the ports of programs over one middleware. Each call ends within 5 s."""

    def connected(self, source: str, targets: frozenset[str]) -> frozenset[str]:
        """Those of `targets` to which `source` is connected. Raises `ConnectorError`."""

    def connect(self, source: str, target: str, carrier: str) -> None:
        """Connect two ports; `carrier` "": the default. Raises `ConnectorError`."""

    def disconnect(self, source: str, target: str) -> None:
        """Remove a connection; none is no error. Raises `ConnectorError`."""
