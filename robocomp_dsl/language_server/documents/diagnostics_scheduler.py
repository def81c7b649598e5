"""Schedules checks: the changed document first, then its dependants, one at a time.

In: documents that changed. Out: published diagnostics. A document whose check is slow (thousands of
lines) is checked when the user stops typing.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from time import perf_counter

from lsprotocol import types as lsp

from robocomp_dsl.check.workspace.source_cache import canonical_path
from robocomp_dsl.language_server.diagnostics import diagnostics_of
from robocomp_dsl.language_server.documents.background_check import BackgroundChecker
from robocomp_dsl.language_server.session import Document, Session
from robocomp_dsl.source import UnreadableSource

Publish = Callable[[lsp.PublishDiagnosticsParams], None]

SLOW_CHECK_S = 0.25
"""A document whose last check took longer is checked with a delay (about ten thousand lines)."""
MAX_DELAY_S = 1.0

_logger = logging.getLogger(__name__)


class DiagnosticsScheduler:
    """The queue of documents to check; `publish` sends their diagnostics to the client."""

    def __init__(self, session: Session, publish: Publish) -> None:
        self._session = session
        self._publish = publish
        self._waiting: dict[str, Document] = {}
        self._durations: dict[str, float] = {}
        self._timer: asyncio.Handle | None = None
        self._background = BackgroundChecker(session)

    def document_changed(self, document: Document) -> None:
        """Schedule checks of `document` and of its dependants."""
        key = canonical_path(document.path)
        dependants = _mark_outdated(self._dependants(key))
        self._waiting = {key: document, **dependants, **self._waiting}
        document.check_pending = self._background.is_large(document)
        duration = self._durations.get(key, 0.0)
        self._schedule(min(duration, MAX_DELAY_S) if duration > SLOW_CHECK_S else 0.0)

    def document_closed(self, document: Document) -> None:
        """Clear the diagnostics of `document` and schedule checks of its dependants."""
        key = canonical_path(document.path)
        self._waiting.pop(key, None)
        self._publish(lsp.PublishDiagnosticsParams(document.uri, []))
        self._waiting.update(_mark_outdated(self._dependants(key)))
        self._schedule(0.0)

    def recheck_all(self) -> None:
        """Schedule checks of all open documents, because other files have changed."""
        self._waiting.update(_mark_outdated(self._session.documents))
        self._schedule(0.0)

    def _dependants(self, key: str) -> dict[str, Document]:
        return {
            other: document
            for other, document in self._session.documents.items()
            if other != key and document.checked and key in document.checked.dependencies
        }

    def _schedule(self, delay: float) -> None:
        if self._timer:
            self._timer.cancel()
        self._timer = asyncio.get_running_loop().call_later(delay, self._next)

    def _next(self) -> None:
        self._timer = None
        if not self._waiting:
            return
        key = next(iter(self._waiting))
        document = self._waiting.pop(key)
        if self._waiting:
            self._schedule(0.0)
        if self._background.is_large(document):
            document.check_pending = True
            self._background.check(document, self._on_background_check)
            return
        begin = perf_counter()
        try:
            checked = self._session.check(document.path)
            diagnostics = diagnostics_of(self._session, checked)
        except UnreadableSource:
            return
        except Exception as error:
            # One failed check does not prevent the others.
            reason = f"{type(error).__name__}: {error}"
            _logger.warning("internal error in the check of %s: %s", document.path.name, reason)
            _logger.debug("%s", reason, exc_info=True)
            return
        self._durations[key] = perf_counter() - begin
        version = document.version
        self._publish(lsp.PublishDiagnosticsParams(document.uri, diagnostics, version))

    def _on_background_check(
        self, document: Document, diagnostics: list[lsp.Diagnostic] | None, duration: float
    ) -> None:
        key = canonical_path(document.path)
        self._durations[key] = duration
        if diagnostics is not None:
            self._publish(lsp.PublishDiagnosticsParams(document.uri, diagnostics, document.version))
        elif self._session.documents.get(key) is document:
            self._waiting.setdefault(key, document)
            self._schedule(min(duration, MAX_DELAY_S))


def _mark_outdated(documents: dict[str, Document]) -> dict[str, Document]:
    """Mark the last check of each of `documents` as outdated; returns `documents`."""
    for document in documents.values():
        document.outdated = True
    return documents
