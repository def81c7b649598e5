"""Handlers of signals set no `threading.Event`.

A handler runs between two instructions of the main thread. If that waits for the event, it may hold
the lock of the event, and `set` waits for that lock forever.
"""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
SETS_EVENT = re.compile(r"signal\.signal\([^,]+,\s*lambda[^:]*:\s*\w+\.set\(\)")


def test_signal_handlers_set_no_event() -> None:
    files = [
        path
        for folder in ("robocomp_dsl", "components", "templates", "tests", "benchmarks")
        for path in (ROOT / folder).rglob("*")
        if path.suffix in (".py", ".jinja")
    ]
    assert len(files) > 1000
    found = [str(path) for path in files if SETS_EVENT.search(path.read_text(errors="replace"))]
    assert found == []
