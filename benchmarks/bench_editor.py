"""From a key to the findings on the screen: a real server process, a real client, 100 open files.

Every round changes one letter of the file and waits for the diagnostics of that version. The memory
is that of the server at the end.
"""

from __future__ import annotations

import asyncio
import os
import sys
import tempfile
import time
from pathlib import Path
from statistics import median, quantiles
from typing import Any

from lsprotocol import types as lsp
from pygls.lsp.client import LanguageClient

SERVER = [sys.executable, "-c", "from robocomp_dsl.cli.rcgen.main import main; main()", "lsp"]
ROUNDS = 200
WARM_UP = 20
OTHERS = 98
GOALS = {60: 10, 1000: 25}
"""Lines of the file to milliseconds, for the 95th percentile."""


def interface(lines: int) -> str:
    """An IDSL file of about that many lines: structs, sequences and operations on them."""
    parts = [
        f"    /** Number {number}. */\n    struct S{number}\n    {{\n"
        f"        float x{number} = 0 [mm];\n    }};\n    sequence<S{number}> L{number};\n"
        for number in range((lines - 12) // 6)
    ]
    calls = "".join(f"        L{n} get{n}(S{n} given);\n" for n in range(4))
    return f"module Big\n{{\n{''.join(parts)}    interface Big\n    {{\n{calls}    }};\n}};\n// \n"


async def open_server() -> tuple[LanguageClient, asyncio.Queue[Any]]:
    """A client of a server process, and the files and versions whose findings arrived."""
    client = LanguageClient("bench", "1")
    arrived: asyncio.Queue[tuple[str, int | None]] = asyncio.Queue()

    @client.feature(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
    def _(params: lsp.PublishDiagnosticsParams) -> None:
        arrived.put_nowait((params.uri, params.version))

    await client.start_io(*SERVER)
    await client.initialize_async(lsp.InitializeParams(lsp.ClientCapabilities()))
    client.initialized(lsp.InitializedParams())
    return client, arrived


async def _measure() -> list[dict[str, Any]]:
    client, arrived = await open_server()
    figures: list[dict[str, Any]] = []
    with tempfile.TemporaryDirectory() as folder:
        texts = {f"o{n}.idsl": interface(60).replace("Big", f"O{n}") for n in range(OTHERS)}
        texts |= {f"big{lines}.idsl": interface(lines) for lines in GOALS}
        for name, text in texts.items():
            item = lsp.TextDocumentItem(Path(folder, name).as_uri(), "idsl", 0, text)
            client.text_document_did_open(lsp.DidOpenTextDocumentParams(item))
        for lines, goal in GOALS.items():
            name = f"big{lines}.idsl"
            uri = Path(folder, name).as_uri()
            for number in range(WARM_UP):
                await _change(client, arrived, uri, texts[name], number)
            begin, rounds = processor_time(client), range(WARM_UP, WARM_UP + ROUNDS)
            took = [await _change(client, arrived, uri, texts[name], n) for n in rounds]
            used = (processor_time(client) - begin) / ROUNDS
            figures += _figures(f"change to findings, {lines} lines", took, goal)
            name = f"change, {lines} lines, processor time of the server"
            figures.append({"name": name, "value": used, "unit": "ms"})
        figures.append(_memory(client))
        await client.shutdown_async(None)
        client.exit(None)
        await client.stop()
    return figures


async def _change(
    client: LanguageClient, arrived: asyncio.Queue[Any], uri: str, text: str, number: int
) -> float:
    """Change a digit in the middle of the file; milliseconds until its findings are here."""
    middle = text[: text.index("= 0", len(text) // 3)]
    line, column = middle.count("\n"), len(middle.rpartition("\n")[2]) + 2
    place = lsp.Range(lsp.Position(line, column), lsp.Position(line, column + 1))
    change = lsp.TextDocumentContentChangePartial(place, str(number % 10))
    document = lsp.VersionedTextDocumentIdentifier(number + 1, uri)
    begin = time.perf_counter()
    client.text_document_did_change(lsp.DidChangeTextDocumentParams(document, [change]))
    while await arrived.get() != (uri, number + 1):
        pass
    return (time.perf_counter() - begin) * 1000


def _figures(name: str, took: list[float], goal: float) -> list[dict[str, Any]]:
    slow = quantiles(took, n=20)[-1]
    return [
        {"name": f"{name}, median", "value": median(took), "unit": "ms"},
        {"name": f"{name}, p95", "value": slow, "unit": "ms", "goal": goal},
    ]


def processor_time(client: LanguageClient) -> float:
    """Milliseconds that the server has computed, which a busy machine does not change."""
    process: Any = client._server
    fields = (
        Path(f"/proc/{process.pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
    )
    return (int(fields[11]) + int(fields[12])) * 1000 / os.sysconf("SC_CLK_TCK")


def _memory(client: LanguageClient) -> dict[str, Any]:
    process: Any = client._server  # pygls has no other way to its process
    status = Path(f"/proc/{process.pid}/status").read_text(encoding="ascii")
    kilobytes = int(next(line for line in status.splitlines() if "VmRSS" in line).split()[1])
    return {"name": "server, 100 files open", "value": kilobytes / 1024, "unit": "MB", "goal": 200}


def run() -> list[dict[str, Any]]:
    """Median and 95th percentile in ms, memory in MB."""
    return asyncio.run(_measure())
