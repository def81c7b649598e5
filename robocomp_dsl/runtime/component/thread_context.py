"""For which component of a process a thread works: its name and its working folder.

In: components of a group in one process. Out: the context of the current thread. Threads inherit it
from the thread that starts them; a call within the process changes it until the call returns.

On Linux the threads of a component share a working folder of their own (`unshare(2)` with
`CLONE_FS`), so that relative paths mean the same as in a process of its own. Where a container does
not allow that, all have the working folder of the process.
"""

from __future__ import annotations

import ctypes
import os
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

_CLONE_FS = 0x200
_contexts: dict[str, ThreadContext] = {}
_local = threading.local()


@dataclass(slots=True, eq=False)
class ThreadContext:
    """The context of one component; `folder` is a descriptor of `path`.

    `builtins` are those of its modules: they import from its folder first.
    """

    name: str
    path: Path
    folder: int
    builtins: dict[str, Any] = field(default_factory=dict)


def create_context(name: str, path: Path) -> ThreadContext:
    """The context of component `name` with the working folder `path`. Raises `OSError`."""
    folder = os.open(path, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    context = _contexts[name] = ThreadContext(name, path, folder)
    return context


def context_of(name: str) -> ThreadContext | None:
    """The context of a component; None if it is alone in its process, or elsewhere."""
    return _contexts.get(name)


def current_context() -> ThreadContext | None:
    """The context of the current thread."""
    found: ThreadContext | None = getattr(_local, "context", None)
    return found


def own_folder(context: ThreadContext) -> bool:
    """Give the current thread the context, and its threads a folder of their own.

    Returns False where that is not allowed.
    """
    _local.context = context
    if not _unshare():
        return False
    os.fchdir(context.folder)
    return True


def enter(context: ThreadContext) -> ThreadContext | None:
    """Change the context of the current thread; returns the former one, for `leave`."""
    former = current_context()
    _local.context = context
    if former is not None and former.path != context.path:
        # Other threads of the former component keep their folder.
        if not getattr(_local, "is_private", False):
            _local.is_private = _unshare()
        if _local.is_private:
            os.fchdir(context.folder)
    return former


def leave(former: ThreadContext | None) -> None:
    """Change the context back."""
    context = current_context()
    _local.context = former
    if former is None or context is None or former.path == context.path:
        return
    if _local.is_private:
        os.fchdir(former.folder)


def within(
    call: Callable[[tuple[Any, ...]], Any], server: str, client: str
) -> Callable[[tuple[Any, ...]], Any]:
    """`call` of component `client` with the context of `server`; as it is in other processes."""
    context = context_of(server)
    if context is None or context is context_of(client):
        return call

    def call_within(arguments: tuple[Any, ...]) -> Any:
        former = enter(context)
        try:
            return call(arguments)
        finally:
            leave(former)

    return call_within


def inherit_contexts() -> None:
    """Let every thread that is started from now on inherit the context of its starter."""
    start = threading.Thread.start

    def start_in_context(self: threading.Thread) -> None:
        context = current_context()
        if context is not None:
            is_shared = getattr(_local, "is_private", False)
            run = self.run

            def run_in_context() -> None:
                _local.context = context
                if is_shared:  # with a thread that changes its folder for each call
                    _local.is_private = _unshare()
                    os.fchdir(context.folder)
                run()

            self.run = run_in_context  # type: ignore[method-assign]
        start(self)

    threading.Thread.start = start_in_context  # type: ignore[method-assign]


def _unshare() -> bool:
    try:
        return bool(ctypes.CDLL(None).unshare(_CLONE_FS) == 0)
    except (OSError, AttributeError):  # no Linux
        return False
