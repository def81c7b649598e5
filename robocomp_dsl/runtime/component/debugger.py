"""Whether a debugger holds the threads of this process.

In: the frames of a thread. Out: whether a debugger is attached; a thread at a breakpoint is not a
thread that hangs.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from types import FrameType

_DEBUGGER_MODULES = ("bdb", "pdb", "pydevd", "_pydevd_bundle", "debugpy", "IPython")
_STATUS = Path("/proc/self/status")


def is_attached(frame: FrameType | None) -> bool:
    """Whether a debugger traces the process, or `frame` or a caller of it."""
    return (
        tracer_of(_STATUS) != 0
        or _uses_monitoring()
        or _is_client_connected()
        or any(_is_traced(caller) for caller in _callers(frame))
    )


def tracer_of(status: Path) -> int:
    """The process that traces (ptrace) the one of `status` (/proc/PID/status); 0: none."""
    try:
        text = status.read_text(encoding="utf-8")
    except OSError:
        return 0
    _, found, rest = text.partition("TracerPid:")
    return int(rest.split(None, 1)[0]) if found else 0


def _uses_monitoring() -> bool:
    """Whether a debugger uses PEP 669, from Python 3.12 on."""
    monitoring = getattr(sys, "monitoring", None)
    return monitoring is not None and monitoring.get_tool(monitoring.DEBUGGER_ID) is not None


def _is_client_connected() -> bool:
    """Whether an editor is connected to debugpy in this process."""
    debugpy = sys.modules.get("debugpy")
    connected = getattr(debugpy, "is_client_connected", None)
    return bool(connected and connected())


def _callers(frame: FrameType | None) -> Iterator[FrameType]:
    while frame is not None:
        yield frame
        frame = frame.f_back


def _is_traced(frame: FrameType) -> bool:
    """Whether a debugger runs in `frame` or has set a trace function there (coverage does, too)."""
    module = getattr(frame.f_trace, "__module__", None) or type(frame.f_trace).__module__
    running = str(frame.f_globals.get("__name__", ""))
    return any(name.partition(".")[0] in _DEBUGGER_MODULES for name in (module, running))
