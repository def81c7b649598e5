"""When files are checked: the changed one at once, then those that depend on it, one at a time.

In: documents that changed. Out: published diagnostics. Files whose check takes long (thousands of
lines) wait until the user pauses, so that no key waits for them.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from time import perf_counter

from lsprotocol import types as lsp

from robocomp_dsl.check.files import identity
from robocomp_dsl.editor.aside import Aside
from robocomp_dsl.editor.diagnostics import diagnostics_of
from robocomp_dsl.editor.session import Document, Session
from robocomp_dsl.source import UnreadableSource

Publish = Callable[[lsp.PublishDiagnosticsParams], None]

SLOW_S = 0.25
"""A check that took longer waits for a pause the next time: some ten thousand lines."""
LONGEST_WAIT_S = 1.0

_logger = logging.getLogger(__name__)


class Checking:
    """Documents that wait for their check, in order; `publish` sends what was found."""

    def __init__(self, session: Session, publish: Publish) -> None:
        self._session = session
        self._publish = publish
        self._waiting: dict[str, Document] = {}
        self._took: dict[str, float] = {}
        self._timer: asyncio.Handle | None = None
        self._aside = Aside(session)

    def changed(self, document: Document) -> None:
        """Check `document` and what depends on it, as soon as no key waits for it."""
        key = identity(document.path)
        dependants = _stale(self._dependants(key))
        self._waiting = {key: document, **dependants, **self._waiting}
        document.pending = self._aside.is_huge(document)
        took = self._took.get(key, 0.0)
        self._schedule(min(took, LONGEST_WAIT_S) if took > SLOW_S else 0.0)

    def closed(self, document: Document) -> None:
        """Take back what was said of `document`, and check what depends on it."""
        key = identity(document.path)
        self._waiting.pop(key, None)
        self._publish(lsp.PublishDiagnosticsParams(document.uri, []))
        self._waiting.update(_stale(self._dependants(key)))
        self._schedule(0.0)

    def everything(self) -> None:
        """Check all open documents: files that are not open have changed."""
        self._waiting.update(_stale(self._session.documents))
        self._schedule(0.0)

    def _dependants(self, key: str) -> dict[str, Document]:
        return {
            other: document
            for other, document in self._session.documents.items()
            if other != key and document.checked and key in document.checked.asked
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
        if self._aside.is_huge(document):
            document.pending = True
            self._aside.check(document, self._checked_aside)
            return
        begin = perf_counter()
        try:
            checked = self._session.check(document.path)
            found = diagnostics_of(self._session, checked)
        except UnreadableSource:
            return
        except Exception as error:
            # A file that cannot be checked keeps no other one from it.
            what = f"{type(error).__name__}: {error}"
            _logger.warning("internal error in the check of %s: %s", document.path.name, what)
            _logger.debug("%s", what, exc_info=True)
            return
        self._took[key] = perf_counter() - begin
        version = document.version
        self._publish(lsp.PublishDiagnosticsParams(document.uri, found, version))

    def _checked_aside(
        self, document: Document, found: list[lsp.Diagnostic] | None, took: float
    ) -> None:
        key = identity(document.path)
        self._took[key] = took
        if found is not None:
            self._publish(lsp.PublishDiagnosticsParams(document.uri, found, document.version))
        elif self._session.documents.get(key) is document:
            self._waiting.setdefault(key, document)
            self._schedule(min(took, LONGEST_WAIT_S))


def _stale(documents: dict[str, Document]) -> dict[str, Document]:
    """Say of `documents` that their last check is no longer true."""
    for one in documents.values():
        one.stale = True
    return documents
