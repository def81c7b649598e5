"""Logs what a router refused: connections, and uses of keys. Repetitions are counted, not logged.

In: denials and warnings of zenoh. Out: log lines; nobody can fill the disk with them.
"""

from __future__ import annotations

import logging
import re
import time
from collections import OrderedDict

from robocomp_dsl.runtime.router.denied_use import describe_denial
from robocomp_dsl.runtime.router.zenoh_log import Denial

log = logging.getLogger("robocomp.router")
REPEAT_S = 60.0
"""The same refusal is logged again after this time, with the number of its repetitions."""
MAX_KNOWN = 1000
MAX_LINES = 20
"""Lines of one program within `REPEAT_S`."""
_HANDSHAKES = "zenoh_link_tls"
_NUMBERS = re.compile(r"\d+")


class RefusalLog:
    """The refusals of one router; `add_name` says whose session has an id."""

    def __init__(self) -> None:
        self._names: OrderedDict[str, str] = OrderedDict()
        self._known: OrderedDict[str, tuple[float, int]] = OrderedDict()
        self._lines: dict[str, int] = {}
        self._begin = time.monotonic()

    def add_name(self, zid: str, name: str) -> None:
        """A session is connected."""
        self._names[zid] = name
        if len(self._names) > MAX_KNOWN:
            self._names.popitem(last=False)

    def on_denial(self, denial: Denial) -> None:
        """The access control has denied a message."""
        name = denial.name or self._names.get(denial.zid) or "a program with an unknown name"
        text, fields = describe_denial(name, denial)
        self._log(name, f"{name} {denial.action} {denial.key}", text, fields)

    def on_warning(self, module: str, text: str) -> None:
        """Zenoh has logged a warning."""
        if module.startswith(_HANDSHAKES):
            text = f"refused a connection: {text}"
        # Times in the text change with every attempt.
        self._log("", _NUMBERS.sub("", text), text, {})

    def _log(self, name: str, key: str, text: str, fields: dict[str, str]) -> None:
        now = time.monotonic()
        if now - self._begin > REPEAT_S:
            self._begin, self._lines = now, {}
        logged, repetitions = self._known.get(key, (-REPEAT_S, 0))
        if now - logged < REPEAT_S or self._lines.get(name, 0) >= MAX_LINES:
            self._known[key] = (logged, repetitions + 1)
        else:
            self._known[key] = (now, 0)
            self._lines[name] = self._lines.get(name, 0) + 1
            again = f" ({repetitions} more times before)" if repetitions else ""
            log.warning("%s%s", text, again, extra={"fields": fields})
        self._known.move_to_end(key)
        if len(self._known) > MAX_KNOWN:
            self._known.popitem(last=False)
