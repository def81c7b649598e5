"""Publishers of a domain: their ids, and how many messages each has published.

A publisher announces a random id and the time of its creation with a liveliness token, and answers
how many messages it has published so far. Subscribers count their losses with it.
"""

from __future__ import annotations

import contextlib
import secrets
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from itertools import count
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import zenoh

from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.presence import keys
from robocomp_dsl.runtime.presence.domain_session import DomainSession
from robocomp_dsl.runtime.presence.sequence_format import SEQUENCE_FORMAT

COUNT_TIMEOUT_S = 0.2
"""A publisher replies within a millisecond; a hanging publisher is not waited for."""
REMOTE_COUNT_TIMEOUT_S = 1.0
"""As before, for publishers of other hosts: a link may have a long delay."""
_ALL_REPLIES: dict[str, Any] = {
    "target": zenoh.QueryTarget.ALL,
    "consolidation": zenoh.ConsolidationMode.NONE,
}


@cache
def clock_id() -> str:
    """Identifies the monotonic clock: it starts at the boot of the machine. "" if unknown."""
    try:
        return Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii").strip()[:8]
    except OSError:
        return ""


class PublicationCounter:
    """The publishing side of one port: its id, and a counter for each operation."""

    def __init__(self, session: zenoh.Session, domain: str, at: Endpoint) -> None:
        self.id = secrets.randbits(64)
        self._prefix = keys.port_key(domain, "n", at)
        self._counters: dict[str, count[int]] = {}
        created = time.monotonic_ns()
        token = keys.PublisherToken(at.component, at.port, self.id, created, clock_id())
        reply = zenoh.handlers.Callback(self._reply, indirect=False)
        self._queryable = session.declare_queryable(f"{self._prefix}/*", reply)
        self._token = session.liveliness().declare_token(token.key(domain))

    def counter(self, operation: str) -> count[int]:
        """The counter of an operation; `next` of it is safe in any thread."""
        return self._counters.setdefault(keys.escape_chunk(operation), count())

    def close(self) -> None:
        """Take back the announcement."""
        self._token.undeclare()
        self._queryable.undeclare()

    def _reply(self, query: zenoh.Query) -> None:
        with contextlib.suppress(zenoh.ZError):  # the session is closing
            for operation, counter in list(self._counters.items()):
                number = int(repr(counter)[len("count(") : -1])
                query.reply(f"{self._prefix}/{operation}", SEQUENCE_FORMAT.pack(self.id, number))
            query.drop()


class PublisherRegistry:
    """The publishers of a domain that have announced themselves.

    `created`: their ids, with the time of creation (monotonic clock of the machine, ns). Those in
    `remote` are on another machine, whose clock tells nothing here: theirs is that of discovery.
    """

    def __init__(self, opened: DomainSession, domain: str) -> None:
        self._session = opened.session
        self._domain = domain
        self.created: dict[int, int] = {}
        self.remote: set[int] = set()
        timeout = REMOTE_COUNT_TIMEOUT_S if opened.network else COUNT_TIMEOUT_S
        self._options = {**_ALL_REPLIES, "timeout": timeout}
        self.counts_at_discovery: dict[tuple[int, str], int] = {}
        opened.watch_tokens(f"{keys.domain_prefix(domain)}/a/**", self._on_token)

    def _on_token(self, key: str, exists: bool) -> None:
        token = keys.parse_publisher_token(key)
        if token is None or not exists:
            return  # messages of a publisher that exited may still be in a queue
        if token.clock == clock_id():
            self.created[token.id] = token.created
        elif token.id not in self.remote:
            self.remote.add(token.id)
            self.created[token.id] = time.monotonic_ns()
        counts = keys.counts_key(self._domain, token.component, token.port)
        with contextlib.suppress(zenoh.ZError):  # the session is closing
            self._session.get(counts, self._on_count, **self._options)

    def _on_count(self, reply: zenoh.Reply) -> None:
        for published in _published_counts((reply,)):
            key = (published.publisher, published.operation)
            self.counts_at_discovery.setdefault(key, published.number)

    def current_counts(self) -> list[PublishedCount]:
        """How many messages each publisher has published; hanging publishers are left out."""
        try:
            key = f"{keys.domain_prefix(self._domain)}/n/**"
            return list(_published_counts(self._session.get(key, **self._options)))
        except zenoh.ZError:  # the session is closing
            return []


@dataclass(frozen=True, slots=True)
class PublishedCount:
    """How many messages a publisher has published in one operation."""

    publisher: int
    interface: str
    hash: str
    component: str
    port: str
    operation: str
    number: int


def _published_counts(replies: Iterable[zenoh.Reply]) -> Iterator[PublishedCount]:
    """The number in each valid reply."""
    for reply in replies:
        sample = reply.ok
        if sample is None:
            continue
        data, chunks = sample.payload.to_bytes(), str(sample.key_expr).split("/")
        if len(data) == SEQUENCE_FORMAT.size and len(chunks) == 8:
            publisher, number = SEQUENCE_FORMAT.unpack(data)
            interface, hash_, component, port = map(unquote, chunks[3:7])
            yield PublishedCount(publisher, interface, hash_, component, port, chunks[7], number)
