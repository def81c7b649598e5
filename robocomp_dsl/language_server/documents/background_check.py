"""Background checks of large files, so that the server stays responsive.

In: a document. Out: its diagnostics, if the document did not change during the check. One check
runs at a time in its own thread, on a snapshot of the session that no other thread uses.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from contextlib import suppress
from threading import Thread
from time import perf_counter

from lsprotocol import types as lsp

from robocomp_dsl.check.workspace.source_cache import canonical_path
from robocomp_dsl.language_server.diagnostics import diagnostics_of
from robocomp_dsl.language_server.session import BACKGROUND_CHECK_CHARS, Document, Session

Done = Callable[[Document, list[lsp.Diagnostic] | None, float], None]
"""Called with the document, its diagnostics (None: check it again), and the duration in seconds."""

_logger = logging.getLogger(__name__)


class BackgroundChecker:
    """Runs one check at a time; other documents wait in a queue."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._running = False
        self._waiting: dict[str, tuple[Document, Done]] = {}

    def is_large(self, document: Document) -> bool:
        """Whether the check of a document takes long enough to block other requests."""
        return len(self._session.files.read(document.path).text) >= BACKGROUND_CHECK_CHARS

    def check(self, document: Document, done: Done) -> None:
        """Check a document; `done` is called in the caller's thread."""
        if self._running:
            self._waiting[canonical_path(document.path)] = (document, done)
            return
        self._running = True
        loop = asyncio.get_running_loop()
        source = self._session.files.read(document.path)
        snapshot = self._session.snapshot()
        begin = perf_counter()

        def work() -> None:
            diagnostics = _check(snapshot, document)
            with suppress(RuntimeError):  # the event loop is closed: the server has exited
                loop.call_soon_threadsafe(finish, diagnostics)

        def finish(diagnostics: list[lsp.Diagnostic]) -> None:
            self._running = False
            is_open = self._session.documents.get(canonical_path(document.path)) is document
            unchanged = is_open and self._session.files.read(document.path) is source
            if unchanged:
                self._session.merge(document, snapshot)
            done(document, diagnostics if unchanged else None, perf_counter() - begin)
            self._start_next()

        Thread(target=work, name="rcgen-background-check", daemon=True).start()

    def _start_next(self) -> None:
        """Check the next waiting document that is still open."""
        while self._waiting and not self._running:
            key = next(iter(self._waiting))
            document, done = self._waiting.pop(key)
            if self._session.documents.get(key) is document:
                self.check(document, done)


def _check(snapshot: Session, document: Document) -> list[lsp.Diagnostic]:
    try:
        checked = snapshot.check(document.path)
        snapshot.documents[canonical_path(document.path)].index = snapshot.index(document.path)
        return diagnostics_of(snapshot, checked)
    except Exception as error:
        reason = f"{type(error).__name__}: {error}"
        _logger.warning("internal error in the check of %s: %s", document.path.name, reason)
        return []
