"""How workers of RoboComp end their process: `sys.exit`, and `__del__` at the end.

In: `SystemExit` from `__init__`, `setParams`, slots, `compute` and handlers. Out: as with Qt and
Ice the component ends, with the code that the worker chose; `__del__` runs once.
"""

from __future__ import annotations

import logging
import sys
from collections.abc import Callable, Iterable
from functools import wraps
from typing import Any

from robocomp_dsl.runtime.component.lifecycle import Lifecycle
from robocomp_dsl.runtime.robocomp.event_loop import WorkerStopped

FAILED = 1
"""The exit code of `sys.exit("message")`."""
_DELETED = "_is_deleted"

log = logging.getLogger("robocomp")


def leave(life: Lifecycle, request_stop: Callable[[], None], error: SystemExit) -> None:
    """Stop the component for a `sys.exit`; `WorkerStopped` is part of a stop already."""
    if isinstance(error, WorkerStopped):
        code = 0
    else:
        code = exit_code_of(error)
        log.info("the worker called sys.exit(%s)", "" if error.code is None else error.code)
    life.exit(code)
    request_stop()


def exit_code_of(error: SystemExit) -> int:
    """The exit code of the process, as Python defines it; a message is written to stderr."""
    if error.code is None or isinstance(error.code, int):
        return (error.code or 0) & 0xFF
    sys.stderr.write(f"{error.code}\n")
    return FAILED


def end_process_on_exit(cls: type[Any], methods: Iterable[str]) -> None:
    """`sys.exit` in these methods, which other components call, ends the process, as with Ice."""
    for name in methods:
        method = getattr(cls, name, None)
        if callable(method):
            setattr(cls, name, _leaving(method))


def _leaving(method: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(method)
    def call(self: Any, *arguments: Any) -> Any:
        try:
            return method(self, *arguments)
        except SystemExit as error:
            self._leave(error)
            raise

    return call


def delete_once(cls: type[Any]) -> None:
    """Let `__del__` of a class have an effect once: at the end, not again for the garbage."""
    old = vars(cls).get("__del__")
    if old is None:
        return

    @wraps(old)
    def delete(self: Any) -> None:
        if not self.__dict__.get(_DELETED, False):
            self.__dict__[_DELETED] = True
            old(self)

    cls.__del__ = delete


def delete(worker: object) -> None:
    """Call `__del__` of a worker, which closes its devices."""
    method = getattr(type(worker), "__del__", None)
    if method is not None:
        method(worker)
