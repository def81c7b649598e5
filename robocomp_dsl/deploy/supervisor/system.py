"""What the supervisor needs from the operating system."""

from __future__ import annotations

import os


def unsupported_reason() -> str:
    """Why this system cannot supervise processes; empty if it can."""
    try:
        os.close(os.pidfd_open(os.getpid()))
    except (AttributeError, OSError):
        return "rcdeploy requires Linux 5.3 or newer (system call pidfd_open)"
    return ""
