"""Sets the command line and environment that `ps` and /proc show for this process (prctl(2)).

In: argv and environment. Out: /proc/self/cmdline and /proc/self/environ show them, as after an
exec. `PR_SET_MM_MAP` needs no privilege, but a kernel with `CONFIG_CHECKPOINT_RESTORE`, which
distributions have. Call it in a process with one thread: it sets the end of the heap to its present
value.
"""

from __future__ import annotations

import ctypes
import mmap
import os
from collections.abc import Mapping, Sequence
from pathlib import Path

_PR_SET_MM = 35
_PR_SET_MM_MAP = 14
_KEEP = 0xFFFFFFFF
"""As `exe_fd`: the executable stays the same."""
_SPARE_BYTES = 64 * 1024


class _MemoryMap(ctypes.Structure):
    """`struct prctl_mm_map` of <linux/prctl.h>."""

    _fields_ = (
        *((name, ctypes.c_uint64) for name in ("start_code", "end_code", "start_data", "end_data")),
        *((name, ctypes.c_uint64) for name in ("start_brk", "brk", "start_stack")),
        *((name, ctypes.c_uint64) for name in ("arg_start", "arg_end", "env_start", "env_end")),
        ("auxv", ctypes.c_uint64),
        ("auxv_size", ctypes.c_uint32),
        ("exe_fd", ctypes.c_uint32),
    )


_texts: list[mmap.mmap] = []
"""The memory that the kernel reads; it must stay mapped until the process ends."""


def set_command_line(argv: Sequence[str], environment: Mapping[str, str]) -> bool:
    """Show `argv` and `environment`; returns False where the kernel does not support it."""
    arguments = b"".join(os.fsencode(word) + b"\0" for word in argv)
    variables = b"".join(
        os.fsencode(name) + b"=" + os.fsencode(value) + b"\0" for name, value in environment.items()
    )
    try:
        fields = Path("/proc/self/stat").read_text("ascii").rpartition(")")[2].split()
        libc = ctypes.CDLL(None, use_errno=True)
        libc.sbrk.restype = libc.malloc.restype = ctypes.c_void_p
    except (OSError, AttributeError):
        return False
    size = len(arguments) + len(variables) + 1
    # The kernel shows private memory only.
    area = mmap.mmap(-1, size, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
    area.write(arguments + variables)
    start = ctypes.addressof(ctypes.c_char.from_buffer(area))
    middle = start + len(arguments)
    described = _MemoryMap(
        # The first field after the name of the program is number 3 in proc(5).
        *(int(fields[number - 3]) for number in (26, 27, 45, 46, 47, 47, 28)),
        *(start, middle, middle, middle + len(variables)),
        *(0, 0, _KEEP),
    )
    # So that nothing extends the heap between the two calls that follow.
    libc.free(ctypes.c_void_p(libc.malloc(_SPARE_BYTES)))
    described.brk = libc.sbrk(0)
    length = ctypes.c_ulong(ctypes.sizeof(described))
    failed = libc.prctl(
        _PR_SET_MM, _PR_SET_MM_MAP, ctypes.c_ulong(ctypes.addressof(described)), length, 0
    )
    if not failed:
        _texts.append(area)
    return not failed
