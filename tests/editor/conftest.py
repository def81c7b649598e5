"""A server of its own for each test, in a process of its own."""

from __future__ import annotations

from collections.abc import AsyncIterator, Callable
from pathlib import Path
from typing import Any

import pytest_asyncio
from editor_client import SERVER, Editor
from lsprotocol import types as lsp
from pygls.uris import from_fs_path
from pytest_lsp import LanguageClient, client_capabilities, make_test_lsp_client


@pytest_asyncio.fixture
async def start() -> AsyncIterator[Callable[..., Any]]:
    """Start a server for a folder, as the editor with the given capabilities would."""
    running: list[LanguageClient] = []

    async def started(
        folder: Path,
        capabilities: str = "visual-studio-code",
        change: Callable[[lsp.ClientCapabilities], None] = lambda _: None,
        listen: Callable[[LanguageClient], None] = lambda _: None,
    ) -> Editor:
        can = client_capabilities(capabilities)
        change(can)
        client = make_test_lsp_client()
        listen(client)
        await client.start_io(*SERVER)
        running.append(client)
        uri = from_fs_path(str(folder)) or ""
        params = lsp.InitializeParams(
            capabilities=can,
            workspace_folders=[lsp.WorkspaceFolder(uri, "test")],
        )
        offered = (await client.initialize_session(params)).capabilities
        editor = Editor(client, folder, offered)
        if offered.semantic_tokens_provider:
            editor.legend = list(offered.semantic_tokens_provider.legend.token_types)
        return editor

    yield started
    for client in running:
        if not client.stopped:
            await client.shutdown_session()
            await client.stop()


@pytest_asyncio.fixture
async def editor(start: Callable[..., Any], tmp_path: Path) -> Editor:
    """An editor on an empty folder."""
    made: Editor = await start(tmp_path)
    return made
