"""Runs a Python program in a forked process as `python3 PROGRAM …` does in a new one.

In: command line, folder and environment of the program, its standard output and error. Out: the
program runs as `__main__` and ends the process.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
import time
import types
from collections.abc import Sequence
from importlib.machinery import SourceFileLoader
from typing import Any

from robocomp_dsl.runtime.fork_server.command_line import set_command_line

_STANDARD = (0, 1, 2)
_MAX_DESCRIPTORS = 1 << 20


def become(request: dict[str, Any], descriptors: Sequence[int], pipe: int) -> None:
    """Give this process its session, folder, environment, descriptors and command line.

    `descriptors` are standard output, standard error and the heartbeat; `pipe` stays open, too.
    Raises `OSError`.
    """
    os.setsid()
    # Python's own handlers are installed again below; a signal before ends the process.
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGCHLD):
        signal.signal(number, signal.SIG_DFL)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.pthread_sigmask(signal.SIG_SETMASK, [])
    os.chdir(request["cwd"])
    output, errors, heartbeat = descriptors
    null = os.open(os.devnull, os.O_RDONLY)
    for source, target in zip((null, output, errors), _STANDARD, strict=True):
        os.dup2(source, target)
    _close_except({*_STANDARD, heartbeat, pipe})
    environment: dict[str, str] = request["env"]
    heartbeat_variable: str = request["heartbeat"]
    environment = {**environment, heartbeat_variable: str(heartbeat)}
    os.environ.clear()
    os.environ.update(environment)
    time.tzset()
    set_command_line(request["argv"], environment)


def run(argv: Sequence[str]) -> None:
    """Run the program `argv[1]` as `__main__`; raises `SystemExit`, as the program does."""
    path = os.path.abspath(argv[1])  # noqa: PTH100 - as Python does, for a file that may be missing
    sys.argv, sys.orig_argv = list(argv[1:]), list(argv)
    if not sys.flags.safe_path:
        # The server is a program, too: its own folder is first.
        sys.path[0] = os.path.dirname(os.path.realpath(path))  # noqa: PTH120 - as Python writes it
    _seed_again()
    gc.enable()
    module = types.ModuleType("__main__")
    module.__file__ = path
    module.__loader__ = SourceFileLoader("__main__", path)
    module.__dict__["__builtins__"] = __builtins__
    sys.modules["__main__"] = module
    try:
        with open(path, "rb") as stream:  # noqa: PTH123 - its error names the path as it is written
            code = compile(stream.read(), path, "exec")
        exec(code, module.__dict__)  # noqa: S102 - the program itself
    except SystemExit:
        raise
    except BaseException as error:
        # Without the frames of the fork server, as in a program of its own.
        own = error.__traceback__
        error.__traceback__ = own.tb_next if own else None
        sys.excepthook(type(error), error, error.__traceback__)
        raise SystemExit(1) from None
    raise SystemExit(0)


def _seed_again() -> None:
    """Forked processes would have the same random numbers; Python's own generator is seeded."""
    random = sys.modules.get("numpy.random")
    if random is not None:
        random.seed()


def _close_except(keep: set[int]) -> None:
    low = 0
    for descriptor in sorted(keep):
        if low < descriptor:  # an empty range up to 0 would be taken for one without end
            os.closerange(low, descriptor)
        low = descriptor + 1
    os.closerange(low, _MAX_DESCRIPTORS)
