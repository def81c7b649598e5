"""A server of its own for each test, in a process of its own."""

from __future__ import annotations

from collections.abc import AsyncIterator, Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import pytest_asyncio
from lsprotocol import types as lsp
from pygls.uris import from_fs_path
from pytest_lsp import LanguageClient, client_capabilities, make_test_lsp_client

from tests.language_server.editor_client import Editor
from tests.support.forked_commands import forked_commands

SERVER: list[str] = []
"""The command, where a test needs another than `forked_rcgen`."""


@pytest.fixture(scope="session")
def forked_rcgen() -> Iterator[list[str]]:
    """The command `rcgen`, which has imported the language server already.

    `raw_client` starts the real one.
    """
    modules = ("robocomp_dsl.language_server.server", "robocomp_dsl.cli.rcgen.lsp")
    with forked_commands(*modules) as command:
        yield command


@pytest_asyncio.fixture
async def start(forked_rcgen: list[str]) -> AsyncIterator[Callable[..., Any]]:
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
        await client.start_io(*(SERVER or [*forked_rcgen, "lsp"]))
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
    editors: Editor = await start(tmp_path)
    return editors
