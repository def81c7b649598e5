"""What zenoh's own log says of a router: who was refused, and which use of a key was denied.

In: the lines that zenoh writes to standard output, through a pipe. Out: calls with a `Denial`, or
with the text of a warning. zenoh reports denials only in its trace of the access control, where
each message is a line; measured 5 us for each message that the router forwards.
"""

from __future__ import annotations

import os
import re
import threading
from collections.abc import Callable
from dataclasses import dataclass

import zenoh

_FILTER = "warn,zenoh::net::routing::interceptor::access_control=trace"
_CACHE_LINES = 9
"""zenoh decides about all kinds of messages when it first sees a key; nothing is denied by that."""
_THREAD = re.compile(rb" ThreadId\((\d+)\) ")
_DENIED = re.compile(
    rb"(?:Using cached result: )?(?P<zid>[0-9a-f]+)(?: on (?P<subject>\S+))? is unauthorized to"
    rb" (?P<action>[A-Za-z ]+) \(ingress\) on (?P<key>.+)$"
)
_WARNING = re.compile(rb"^\S+ +(?:WARN|ERROR) .*?ThreadId\(\d+\) (?P<module>[\w:]+): (?P<text>.*)$")
_STRANGER = re.compile(rb"(?P<zid>[0-9a-f]+) did not match any configured ACL subject")
_COMMON_NAME = re.compile(rb"CertCommonName\(([^)]*)\)")
_HINT = re.compile(r"\.? ?Hint: .*")
_READ_BYTES = 1 << 18


@dataclass(frozen=True, slots=True)
class Denial:
    """A message that the access control did not let in.

    `zid` is the session; `name` the common name of its certificate, or empty if the line has none.
    `action` is zenoh's word, such as `Put` or `Declare Queryable`; with an empty action and key the
    name is not in the rules, and everything is denied.
    """

    zid: str
    name: str
    action: str
    key: str


class ZenohLog:
    """Reads the log of zenoh in a thread. Must be created before the first session of the process.

    It takes over standard output of the process.
    """

    def __init__(
        self, on_denial: Callable[[Denial], None], on_warning: Callable[[str, str], None]
    ) -> None:
        self._parser = LogParser(on_denial, on_warning)
        self._descriptor, write_end = os.pipe()
        os.dup2(write_end, 1)
        os.close(write_end)
        os.environ["RUST_LOG"] = _FILTER
        os.environ["NO_COLOR"] = "1"
        initialise: Callable[[], None] = zenoh.try_init_log_from_env
        initialise()
        threading.Thread(target=self._read, name="zenoh.log", daemon=True).start()

    def _read(self) -> None:
        rest = b""
        while data := os.read(self._descriptor, _READ_BYTES):
            lines = (rest + data).split(b"\n")
            rest = lines.pop()
            for line in lines:
                self._parser.feed(line)


class LogParser:
    """Finds denials and warnings; `feed` takes one line."""

    def __init__(
        self, on_denial: Callable[[Denial], None], on_warning: Callable[[str, str], None]
    ) -> None:
        self._on_denial = on_denial
        self._on_warning = on_warning
        self._cache_lines: dict[bytes, int] = {}

    def feed(self, line: bytes) -> None:
        """One line of the log."""
        if b" TRACE " in line:
            if b"is authorized to" not in line or self._cache_lines:
                self._feed_trace(line)
        elif match := _STRANGER.search(line):
            self._on_denial(Denial(match["zid"].decode(), "", "", ""))
        elif match := _WARNING.match(line):
            text = _HINT.sub("", match["text"].decode("utf-8", "replace"))
            self._on_warning(match["module"].decode(), text)

    def _feed_trace(self, line: bytes) -> None:
        found = _THREAD.search(line)
        thread = found[1] if found else b""
        if b": caching permissions for " in line:
            self._cache_lines[thread] = _CACHE_LINES
            return
        if b"Using cached result" not in line and (left := self._cache_lines.pop(thread, 0)):
            if left > 1:
                self._cache_lines[thread] = left - 1
            return
        self._cache_lines.pop(thread, None)
        if match := _DENIED.search(line):
            name = _COMMON_NAME.search(match["subject"] or b"")
            self._on_denial(
                Denial(
                    match["zid"].decode(),
                    name[1].decode("utf-8", "replace") if name else "",
                    match["action"].decode(),
                    match["key"].decode("utf-8", "replace").strip(),
                )
            )
