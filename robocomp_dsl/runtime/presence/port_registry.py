"""Registry of the ports of a domain, kept up to date by liveliness tokens.

In: a session. Out: the ports that exist now, and a wait until a port exists.
"""

from __future__ import annotations

import threading
from collections.abc import Callable

import zenoh

from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.peer_selection import log
from robocomp_dsl.runtime.presence.keys import PortToken, domain_prefix, parse_port_token


class PortRegistry:
    """The ports of a domain; `version` changes with every change."""

    def __init__(self, session: zenoh.Session, domain: str) -> None:
        self._ports: dict[str, PortToken] = {}
        self._cancellation_tokens: dict[PortToken, zenoh.CancellationToken] = {}
        self._expected_peers: dict[tuple[str, str], Endpoint] = {}
        self._changed = threading.Condition()
        self.version = 0
        self.closed = False
        self._subscriber = session.liveliness().declare_subscriber(
            f"{domain_prefix(domain)}/p/**", self._on_token, history=True
        )

    def _on_token(self, sample: zenoh.Sample) -> None:
        key = str(sample.key_expr)
        ended = None
        with self._changed:
            if sample.kind == zenoh.SampleKind.DELETE:
                gone = self._ports.pop(key, None)
                ended = self._cancellation_tokens.pop(gone, None) if gone else None
            else:
                found = parse_port_token(key)
                if found:
                    self._ports[key] = found
                    self._check_version(found)
            self.version += 1
            self._changed.notify_all()
        if ended:
            ended.cancel()

    def warn_on_mismatch(self, role: str, at: Endpoint) -> None:
        """Log a warning when a port of the other side of a topic has another interface version.

        Its messages would not arrive, without any error.
        """
        with self._changed:
            self._expected_peers[role, at.interface.name] = at
            for token in self._matching(role, at.interface.name):
                self._check_version(token)

    def _check_version(self, token: PortToken) -> None:
        at = self._expected_peers.get((token.role, token.interface))
        if at and token.hash != at.interface.hash.hex():
            log.warning(
                "%s and %s cannot communicate: they were generated from different versions of"
                " %s (InterfaceMismatch); generate both from the same IDSL file",
                at.component,
                token.component,
                token.interface,
            )

    def invalidate(self) -> None:
        """Let all calls search their server again."""
        with self._changed:
            self.version += 1

    def cancellation_token(self, token: PortToken) -> zenoh.CancellationToken:
        """The token that cancels calls of a port when it exits; zenoh would wait for a time-out.

        The token of a port that has already exited is cancelled.
        """
        with self._changed:
            if token in self._ports.values():
                return self._cancellation_tokens.setdefault(token, zenoh.CancellationToken())
        ended = zenoh.CancellationToken()
        ended.cancel()
        return ended

    def find(self, role: str, interface: str) -> list[PortToken]:
        """The ports with a role and an interface."""
        with self._changed:
            return self._matching(role, interface)

    def _matching(self, role: str, interface: str) -> list[PortToken]:
        every = self._ports.values()
        return [token for token in every if token.role == role and token.interface == interface]

    def wait(
        self, role: str, interface: str, fits: Callable[[PortToken], bool], seconds: float
    ) -> list[PortToken]:
        """The matching ports, waiting at most `seconds` for the first one."""

        def fitting() -> list[PortToken]:
            return [token for token in self._matching(role, interface) if fits(token)]

        with self._changed:
            self._changed.wait_for(lambda: fitting() or self.closed, max(seconds, 0.0))
            return fitting()

    def interrupt(self) -> None:
        """Wake all waiting threads and cancel all calls."""
        with self._changed:
            self.closed = True
            ends = list(self._cancellation_tokens.values())
            self._changed.notify_all()
        for end in ends:
            end.cancel()
