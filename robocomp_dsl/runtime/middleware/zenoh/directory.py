"""Who is there: the ports of a domain, kept up to date by liveliness tokens.

In: a session. Out: the ports that are served at this moment, and waiting for one to appear.
"""

from __future__ import annotations

import threading
from collections.abc import Callable

import zenoh

from robocomp_dsl.runtime.middleware.base import Endpoint
from robocomp_dsl.runtime.middleware.calling import log
from robocomp_dsl.runtime.middleware.zenoh.keys import Present, parse_present, root


class Directory:
    """The ports of a domain; `version` is another number after every change."""

    def __init__(self, session: zenoh.Session, domain: str) -> None:
        self._present: dict[str, Present] = {}
        self._ends: dict[Present, zenoh.CancellationToken] = {}
        self._expected: dict[tuple[str, str], Endpoint] = {}
        self._changed = threading.Condition()
        self.version = 0
        self.over = False
        self._subscriber = session.liveliness().declare_subscriber(
            f"{root(domain)}/p/**", self._hear, history=True
        )

    def _hear(self, sample: zenoh.Sample) -> None:
        key = str(sample.key_expr)
        ended = None
        with self._changed:
            if sample.kind == zenoh.SampleKind.DELETE:
                gone = self._present.pop(key, None)
                ended = self._ends.pop(gone, None) if gone else None
            else:
                found = parse_present(key)
                if found:
                    self._present[key] = found
                    self._compare(found)
            self.version += 1
            self._changed.notify_all()
        if ended:
            ended.cancel()

    def expect(self, role: str, at: Endpoint) -> None:
        """Tell when a port of the other side of a topic has the interface in another shape.

        Nothing of it would arrive, and nobody would know why.
        """
        with self._changed:
            self._expected[role, at.interface.name] = at
            for one in self._matching(role, at.interface.name):
                self._compare(one)

    def _compare(self, one: Present) -> None:
        at = self._expected.get((one.role, one.interface))
        if at and one.hash != at.interface.hash.hex():
            log.warning(
                "%s and %s do not hear each other: they were generated from different versions of"
                " %s (InterfaceMismatch); generate both from the same IDSL file",
                at.component,
                one.component,
                one.interface,
            )

    def renew(self) -> None:
        """Let all calls look again."""
        with self._changed:
            self.version += 1

    def end_of(self, one: Present) -> zenoh.CancellationToken:
        """What ends calls of this port when it goes: zenoh alone would wait for their timeout.

        Of one that has gone meanwhile they have ended before they began.
        """
        with self._changed:
            if one in self._present.values():
                return self._ends.setdefault(one, zenoh.CancellationToken())
        ended = zenoh.CancellationToken()
        ended.cancel()
        return ended

    def find(self, role: str, interface: str) -> list[Present]:
        """The ports of a role with an interface."""
        with self._changed:
            return self._matching(role, interface)

    def _matching(self, role: str, interface: str) -> list[Present]:
        every = self._present.values()
        return [one for one in every if one.role == role and one.interface == interface]

    def wait(
        self, role: str, interface: str, fits: Callable[[Present], bool], seconds: float
    ) -> list[Present]:
        """Those that fit, waiting at most `seconds` for the first one."""

        def fitting() -> list[Present]:
            return [one for one in self._matching(role, interface) if fits(one)]

        with self._changed:
            self._changed.wait_for(lambda: fitting() or self.over, max(seconds, 0.0))
            return fitting()

    def interrupt(self) -> None:
        """Let all who wait go on."""
        with self._changed:
            self.over = True
            ends = list(self._ends.values())
            self._changed.notify_all()
        for one in ends:
            one.cancel()
