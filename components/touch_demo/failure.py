"""The error of the demo, with a message for the user."""

from __future__ import annotations


class DemoFailed(Exception):
    """The demo cannot continue; the message gives the reason."""
