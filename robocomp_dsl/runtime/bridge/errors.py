"""A value that does not fit into the message that a bridge builds."""

from __future__ import annotations


class DoesNotFit(ValueError):
    """A value with the wrong length or range; the context knows the field of the message."""
