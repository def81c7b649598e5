"""Programs as a script starts them in the background: with SIGINT ignored."""

from __future__ import annotations

IGNORING_INTERRUPT = ("sh", "-c", 'trap "" INT; exec "$@"', "sh")
"""Put in front of a command: it starts as a background job of a non-interactive shell does."""
