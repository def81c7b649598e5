"""From every kind of edit of a file of 1000 lines to its findings, in the process of the server.

Each edit goes through the functions that handle `textDocument/didChange` and through the scheduler
of the checks, until the findings are published; then it is undone. Two rows a kind: the edit, and
the edit undone. The times are processor times, which a busy machine changes little. Some kinds are
repeated with a real server process, through the protocol: the time on the clock, and the processor
time of the server, which includes reading and writing messages.

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

from benchmarks.bench_editor import open_server, processor_time
from benchmarks.edits import KINDS, TextEdit
from benchmarks.large_files import write_large_files
from robocomp_dsl.language_server.documents import synchronize
from robocomp_dsl.language_server.documents.diagnostics_scheduler import DiagnosticsScheduler
from robocomp_dsl.language_server.positions import PositionCodec
from robocomp_dsl.language_server.server import GC_THRESHOLDS
from robocomp_dsl.language_server.session import Session
from robocomp_dsl.source import Source

PLACES = 20
"""Places in the file, from its first to its last line."""
PROTOCOL_FILES = ("structs.idsl", "operations.idsl")
PROTOCOL_KINDS = ("letter in a name", "`;` deleted", "stray `}`", "50 lines pasted")
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
        self._version += 1
        params = _change_params(self._path, self.text, edit, self._version)
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


async def _measure_protocol(names: Collection[str]) -> list[dict[str, Any]]:
    """Time on the clock and processor time of a real server."""
    client, arrived = await open_server()
    figures: list[dict[str, Any]] = []
    with tempfile.TemporaryDirectory() as folder:
        for name, (path, text) in write_large_files(Path(folder)).items():
            if name not in (names or PROTOCOL_FILES):
                continue
            uri = path.as_uri()
            item = lsp.TextDocumentItem(uri, path.suffix[1:], 0, text)
            client.text_document_did_open(lsp.DidOpenTextDocumentParams(item))
            await arrived.get()
            used, took = processor_time(client), list[float]()
            for kind in PROTOCOL_KINDS:
                for edit in edits_of(kind, text):
                    for step, before in ((edit, text), (edit.inverse(text), edit.apply(text))):
                        params = _change_params(path, before, step, len(took) + 1)
                        begin = time.perf_counter()
                        client.text_document_did_change(params)
                        while await arrived.get() != (uri, len(took) + 1):
                            pass
                        took.append((time.perf_counter() - begin) * 1000)
            used = (processor_time(client) - used) / len(took)
            label = f"{name}, through the protocol"
            p95 = quantiles(took, n=20, method="inclusive")[-1]
            figures += [
                {"name": f"{label}, median", "value": median(took), "unit": "ms"},
                {"name": f"{label}, p95", "value": p95, "unit": "ms", "goal": GOAL},
                {"name": f"{label}, processor time of the server", "value": used, "unit": "ms"},
            ]
        await client.shutdown_async(None)
        client.exit(None)
        await client.stop()
    return figures


def _change_params(
    path: Path, text: str, edit: TextEdit, version: int
) -> lsp.DidChangeTextDocumentParams:
    """The notification of an edit of `text`."""
    source, positions = Source(path, text), PositionCodec()
    start, end = (positions.position_at(source, offset) for offset in edit[:2])
    change = lsp.TextDocumentContentChangePartial(lsp.Range(start, end), edit.text)
    document = lsp.VersionedTextDocumentIdentifier(version, path.as_uri())
    return lsp.DidChangeTextDocumentParams(document, [change])


def run(names: Collection[str] = ()) -> list[dict[str, Any]]:
    """The 95th percentile of each kind of edit in ms, and the median of all edits of a file."""
    figures = asyncio.run(_measure_protocol(names))
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
