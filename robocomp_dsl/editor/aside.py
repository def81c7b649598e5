"""Checks of huge files in a thread of their own, so that everybody else is answered meanwhile.

In: a document. Out: its diagnostics, once the check is done and if its text is still the same. One
check runs at a time, in a twin of the session that no other thread looks at.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from contextlib import suppress
from threading import Thread
from time import perf_counter

from lsprotocol import types as lsp

from robocomp_dsl.check.files import identity
from robocomp_dsl.editor.diagnostics import diagnostics_of
from robocomp_dsl.editor.session import HUGE, Document, Session

Done = Callable[[Document, list[lsp.Diagnostic] | None, float], None]
"""Called with the document, its diagnostics (None: to be checked again), and how long it took."""

_logger = logging.getLogger(__name__)


class Aside:
    """The thread, if one runs, and the documents that wait for it."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._running = False
        self._waiting: dict[str, tuple[Document, Done]] = {}

    def is_huge(self, document: Document) -> bool:
        """Whether the check of a document would keep others waiting."""
        return len(self._session.files.read(document.path).text) >= HUGE

    def check(self, document: Document, done: Done) -> None:
        """Check a document, and call `done` in the thread that called this."""
        if self._running:
            self._waiting[identity(document.path)] = (document, done)
            return
        self._running = True
        loop = asyncio.get_running_loop()
        taken = self._session.files.read(document.path)
        twin = self._session.twin()
        begin = perf_counter()

        def work() -> None:
            found = _check(twin, document)
            with suppress(RuntimeError):  # the server has ended
                loop.call_soon_threadsafe(finish, found)

        def finish(found: list[lsp.Diagnostic]) -> None:
            self._running = False
            open_now = self._session.documents.get(identity(document.path)) is document
            same = open_now and self._session.files.read(document.path) is taken
            if same:
                self._session.adopt(document, twin)
            done(document, found if same else None, perf_counter() - begin)
            self._next()

        Thread(target=work, name="rcgen-aside", daemon=True).start()

    def _next(self) -> None:
        """Start with the next one that is still open."""
        while self._waiting and not self._running:
            key = next(iter(self._waiting))
            document, done = self._waiting.pop(key)
            if self._session.documents.get(key) is document:
                self.check(document, done)


def _check(twin: Session, document: Document) -> list[lsp.Diagnostic]:
    try:
        checked = twin.check(document.path)
        twin.documents[identity(document.path)].index = twin.index(document.path)
        return diagnostics_of(twin, checked)
    except Exception as error:
        what = f"{type(error).__name__}: {error}"
        _logger.warning("internal error in the check of %s: %s", document.path.name, what)
        return []
