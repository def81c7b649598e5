"""From every kind of edit of a file of 1000 lines to its findings, in the process of the server.

Each edit goes through the functions that handle `textDocument/didChange` and through the scheduler
of the checks, until the findings are published; then it is undone. Two rows a kind: the edit, and
the edit undone. The times are processor times, which a busy machine does not change; `bench_editor`
measures a real server process through the protocol.

`python -m benchmarks.bench_edits operations.idsl …` prints the figures of some files.
"""

from __future__ import annotations

import asyncio
import gc
import sys
import tempfile
import time
from collections.abc import Collection, Iterator
from pathlib import Path
from statistics import median, quantiles
from typing import Any

from lsprotocol import types as lsp

from benchmarks.edits import KINDS, TextEdit
from benchmarks.large_files import write_large_files
from robocomp_dsl.language_server.documents import synchronize
from robocomp_dsl.language_server.documents.diagnostics_scheduler import DiagnosticsScheduler
from robocomp_dsl.language_server.server import GC_THRESHOLDS
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.source import Source

PLACES = 20
"""Places in the file, from its first to its last line."""
GOAL = 25
"""Milliseconds, for the 95th percentile of each kind."""


class Editor:
    """One open file, its server and the time of each change."""

    def __init__(self, path: Path, text: str) -> None:
        self.text = text
        self._path = path
        self._version = 0
        self._published = asyncio.Event()
        self._session = Session(environ={})
        self._scheduler = DiagnosticsScheduler(self._session, lambda _: self._published.set())

    async def open(self) -> None:
        """Open the file and wait for its findings."""
        item = lsp.TextDocumentItem(self._path.as_uri(), "x", 0, self.text)
        document = synchronize.did_open(self._session, lsp.DidOpenTextDocumentParams(item))
        if document is None:
            raise AssertionError(f"{self._path} is in no language of the server")
        self._scheduler.document_changed(document)
        await self._published.wait()

    async def change(self, edit: TextEdit) -> float:
        """Apply an edit; milliseconds of the processor until its findings are published."""
        source = Source(self._path, self.text)
        start, end = (self._session.positions.position_at(source, o) for o in edit[:2])
        change = lsp.TextDocumentContentChangePartial(lsp.Range(start, end), edit.text)
        self._version += 1
        document = lsp.VersionedTextDocumentIdentifier(self._version, self._path.as_uri())
        params = lsp.DidChangeTextDocumentParams(document, [change])
        self.text = edit.apply(self.text)
        self._published.clear()
        begin = time.process_time()
        self._scheduler.document_changed(synchronize.did_change(self._session, params))
        await self._published.wait()
        return (time.process_time() - begin) * 1000


def edits_of(kind: str, text: str) -> Iterator[TextEdit]:
    """The edits of one kind at `PLACES` places, from the first line to the last."""
    for number in range(PLACES):
        yield KINDS[kind](text, len(text) * number // (PLACES - 1))


async def _measure(path: Path, text: str, kinds: Collection[str]) -> dict[str, list[float]]:
    """Kind of edit to the milliseconds of each, on one file."""
    editor = Editor(path, text)
    await editor.open()
    took: dict[str, list[float]] = {}
    for kind in kinds:
        for edit in edits_of(kind, text):
            undo = edit.inverse(text)
            took.setdefault(kind, []).append(await editor.change(edit))
            took.setdefault(f"{kind}, undone", []).append(await editor.change(undo))
    return took


def measure(
    names: Collection[str] = (), kinds: Collection[str] = tuple(KINDS)
) -> Iterator[tuple[str, dict[str, list[float]]]]:
    """Each file (all if there are no `names`) with the milliseconds of each edit by kind."""
    gc.set_threshold(*GC_THRESHOLDS)
    with tempfile.TemporaryDirectory() as folder:
        for name, (path, text) in write_large_files(Path(folder)).items():
            if not names or name in names:
                yield name, asyncio.run(_measure(path, text, kinds))


def run(names: Collection[str] = ()) -> list[dict[str, Any]]:
    """The 95th percentile of each kind of edit in ms, and the median of all edits of a file."""
    figures: list[dict[str, Any]] = []
    for name, took in measure(names):
        every = [milliseconds for times in took.values() for milliseconds in times]
        figures.append({"name": f"{name}, all edits, median", "value": median(every), "unit": "ms"})
        figures += [
            {
                "name": f"{name}, {kind}, p95 (median {median(times):.1f})",
                "value": quantiles(times, n=20, method="inclusive")[-1],
                "unit": "ms",
                "goal": GOAL,
            }
            for kind, times in took.items()
        ]
    return figures


if __name__ == "__main__":
    from benchmarks.__main__ import row

    for figure in run(sys.argv[1:]):
        print(row(figure))
