"""A client of the server with the operations of an editor."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from lsprotocol import types as lsp
from pygls.uris import from_fs_path
from pytest_lsp import LanguageClient

SERVER = [sys.executable, "-c", "from robocomp_dsl.cli.rcgen.main import main; main()", "lsp"]
DEADLINE_S = 120


class Editor:
    """An editor with open documents. `|` in a text marks a position."""

    def __init__(
        self, client: LanguageClient, folder: Path, offered: lsp.ServerCapabilities
    ) -> None:
        self.client = client
        self.folder = folder
        self.offered = offered
        self.versions: dict[str, int] = {}
        self.legend: list[str] = []

    def uri(self, name: str) -> str:
        return from_fs_path(str(self.folder / name)) or ""

    def write(self, name: str, text: str) -> None:
        (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
        (self.folder / name).write_text(text, encoding="utf-8")

    def open(self, name: str, text: str) -> str:
        uri = self.uri(name)
        self.versions[uri] = 0
        item = lsp.TextDocumentItem(uri, Path(name).suffix[1:], 0, text)
        self.client.text_document_did_open(lsp.DidOpenTextDocumentParams(item))
        return uri

    def change(self, name: str, *changes: lsp.TextDocumentContentChangeEvent) -> None:
        uri = self.uri(name)
        self.versions[uri] += 1
        document = lsp.VersionedTextDocumentIdentifier(self.versions[uri], uri)
        params = lsp.DidChangeTextDocumentParams(document, list(changes))
        self.client.text_document_did_change(params)

    def replace(self, name: str, text: str) -> None:
        self.change(name, lsp.TextDocumentContentChangeWholeDocument(text))

    def close(self, name: str) -> None:
        params = lsp.DidCloseTextDocumentParams(lsp.TextDocumentIdentifier(self.uri(name)))
        self.client.text_document_did_close(params)

    async def until(
        self, name: str, condition: Callable[[list[lsp.Diagnostic]], bool]
    ) -> list[lsp.Diagnostic]:
        """The diagnostics of a file, as soon as they satisfy `condition`."""
        async with asyncio.timeout(DEADLINE_S):
            while True:
                found = self.client.diagnostics.get(self.uri(name))
                if found is not None and condition(list(found)):
                    return list(found)
                await self.client.wait_for_notification(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)

    def place(self, name: str, marked: str) -> dict[str, Any]:
        """Document and position of the `|` in a text that was opened without it."""
        before = marked[: marked.index("|")]
        line = before.count("\n")
        assert before.rpartition("\n")[2].isascii()
        units = len(before.rpartition("\n")[2])
        document = lsp.TextDocumentIdentifier(self.uri(name))
        return {"text_document": document, "position": lsp.Position(line, units)}

    def at(self, name: str, marked: str) -> dict[str, Any]:
        """As `place`, and the file is opened with the text."""
        self.open(name, marked.replace("|", "", 1))
        return self.place(name, marked)


def edited(edits: list[lsp.TextEdit], text: str) -> str:
    """`text` after `edits`, whose columns are ASCII here."""
    assert text.isascii()
    starts = [0]
    for line in text.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    ordered = sorted(edits, key=lambda e: (e.range.start.line, e.range.start.character))
    for edit in reversed(ordered):
        start = starts[edit.range.start.line] + edit.range.start.character
        end = starts[edit.range.end.line] + edit.range.end.character
        text = text[:start] + edit.new_text + text[end:]
    return text
