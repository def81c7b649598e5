"""How the demo fails: with a sentence that says what did not happen."""

from __future__ import annotations


class DemoFailed(Exception):
    """The demo cannot go on; the message says why."""
