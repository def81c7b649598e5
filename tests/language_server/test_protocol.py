"""The protocol with invalid messages, and the end of a session."""

from __future__ import annotations

from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

import pytest
import pytest_asyncio
from pygls.uris import from_fs_path

from tests.language_server.project import FILES
from tests.language_server.raw_client import RawClient

pytestmark = pytest.mark.asyncio

INVALID_REQUEST, METHOD_NOT_FOUND, INVALID_PARAMS = -32600, -32601, -32602
NOT_INITIALIZED, CANCELLED = -32002, -32800


@pytest_asyncio.fixture
async def client() -> AsyncIterator[RawClient]:
    started = await RawClient.start()
    yield started
    await started.end()


@pytest_asyncio.fixture
async def ready(client: RawClient) -> RawClient:
    await client.initialize()
    return client


def opened(client: RawClient, uri: str, text: str) -> None:
    item = {"uri": uri, "languageId": "x", "version": 0, "text": text}
    client.notify("textDocument/didOpen", {"textDocument": item})


def change(client: RawClient, uri: str, *changes: dict[str, Any]) -> None:
    params = {"textDocument": {"uri": uri, "version": 1}, "contentChanges": list(changes)}
    client.notify("textDocument/didChange", params)


def span(start: tuple[int, int], end: tuple[int, int]) -> dict[str, Any]:
    (a, b), (c, d) = start, end
    return {"start": {"line": a, "character": b}, "end": {"line": c, "character": d}}


async def is_alive(client: RawClient) -> None:
    response = await client.request("workspace/symbol", {"query": ""}, 4711)
    assert "result" in response, response


async def text_of(client: RawClient, uri: str) -> str:
    """The text that the server has, read from the outline: the name of the parameter set."""
    response = await client.request(
        "textDocument/documentSymbol", {"textDocument": {"uri": uri}}, 99
    )
    return " ".join(message_["name"] for message_ in response["result"])


HOVER = "textDocument/hover"
PLACE = {"line": 0, "character": 0}
ODD: list[tuple[str, Any]] = [
    (HOVER, {"textDocument": {"uri": "{}"}, "position": {"line": -1, "character": 0}}),
    (HOVER, {"textDocument": {"uri": "{}"}, "position": {"line": 0, "character": -5}}),
    (HOVER, {"textDocument": {"uri": "{}"}, "position": {"line": "x", "character": 0}}),
    (HOVER, {"textDocument": {"uri": "{}"}, "position": {"line": 2**40, "character": 0}}),
    (HOVER, {"textDocument": {"uri": "{}"}}),
    (HOVER, {"textDocument": {"uri": 7}, "position": PLACE}),
    (HOVER, [1, 2]),
    (HOVER, None),
    ("textDocument/foldingRange", {"textDocument": {"uri": "untitled:Untitled-1"}}),
    ("textDocument/foldingRange", {"textDocument": {"uri": "git:/a/b.cdsl?{\"ref\":\"~\"}"}}),
    ("textDocument/foldingRange", {"textDocument": {"uri": ""}}),
    ("textDocument/foldingRange", {"textDocument": {"uri": "file:///a%00b.cdsl"}}),
    ("textDocument/foldingRange", {"textDocument": {"uri": "file://[half/a.cdsl"}}),
    ("textDocument/foldingRange", {"textDocument": {"uri": "{}/folder.cdsl"}}),
    ("textDocument/foldingRange", {"textDocument": {"uri": "{}/latin1.cdsl"}}),
    ("textDocument/codeAction", {"textDocument": {"uri": "{}"}, "context": {"diagnostics": []},
     "range": span((0, 0), (99, 0))}),
    ("workspace/executeCommand", {"command": "rcgen.generate", "arguments": [{"a": 1}]}),
    ("callHierarchy/incomingCalls", {"item": {"name": "x", "kind": 5, "uri": "nowhere:x",
     "range": span((0, 0), (0, 0)), "selectionRange": span((0, 0), (0, 0))}}),
]  # fmt: skip


def filled(value: Any, uri: str, folder: str) -> Any:
    if isinstance(value, dict):
        return {key: filled(message_, uri, folder) for key, message_ in value.items()}
    if not isinstance(value, str) or not value.startswith("{}"):
        return value
    return uri if value == "{}" else folder + value[2:]


async def test_malformed_requests_get_error_responses(ready: RawClient, tmp_path: Path) -> None:
    (tmp_path / "folder.cdsl").mkdir()
    (tmp_path / "latin1.cdsl").write_bytes("Component gr\xfc {};".encode("latin-1"))
    folder = from_fs_path(str(tmp_path)) or ""
    uri = f"{folder}/a.pdsl"
    opened(ready, uri, "ComponentParams a { };")
    for number, (method, params) in enumerate(ODD, 1):
        response = await ready.request(method, filled(params, uri, folder), number)
        assert "error" in response, (method, params, response)
        assert "Traceback" not in response["error"]["message"], response
    await is_alive(ready)


async def test_unknown_methods_get_error_responses(ready: RawClient) -> None:
    response = await ready.request("textDocument/tea", {})
    assert response["error"]["code"] == METHOD_NOT_FOUND
    ready.notify("textDocument/tea", {})
    ready.notify("$/tea", {})
    await is_alive(ready)


async def test_invalid_bytes_are_ignored(ready: RawClient) -> None:
    for body in (b"{", b"[]", b"null", b'"x"', b"\xff\xfe", b"{}", b'{"jsonrpc": "2.0", "id": 7}'):
        ready.send(body)
    await is_alive(ready)


async def test_unsupported_documents_are_ignored(ready: RawClient) -> None:
    for uri in ("untitled:Untitled-1", "git:/a/b.cdsl", "vscode-notebook-cell:/a.cdsl#1", "x", ""):
        opened(ready, uri, "Component")
        change(ready, uri, {"text": "Component x"})
        ready.notify("textDocument/didClose", {"textDocument": {"uri": uri}})
    await is_alive(ready)
    assert not [
        message_
        for message_ in ready.received
        if message_.get("method", "").endswith("publishDiagnostics")
    ]


async def test_overlapping_edits_are_applied_in_order(ready: RawClient, tmp_path: Path) -> None:
    uri = from_fs_path(str(tmp_path / "a.pdsl")) or ""
    opened(ready, uri, "ComponentParams first { };")
    change(
        ready,
        uri,
        {"range": span((0, 16), (0, 21)), "text": "second"},
        {"range": span((0, 16), (0, 19)), "text": "be"},
        {"range": span((0, 0), (0, 0)), "text": ""},
    )
    assert await text_of(ready, uri) == "beond"


async def test_second_open_replaces_text(ready: RawClient, tmp_path: Path) -> None:
    uri = from_fs_path(str(tmp_path / "a.pdsl")) or ""
    opened(ready, uri, "ComponentParams first { };")
    opened(ready, uri, "ComponentParams second { };")
    assert await text_of(ready, uri) == "second"
    ready.notify("textDocument/didClose", {"textDocument": {"uri": uri}})
    ready.notify("textDocument/didClose", {"textDocument": {"uri": uri}})
    await is_alive(ready)


async def test_text_with_lone_surrogate(ready: RawClient, tmp_path: Path) -> None:
    uri = from_fs_path(str(tmp_path / "a.pdsl")) or ""
    opened(ready, uri, 'ComponentParams a { text string "\ud83d"; };')
    change(ready, uri, {"range": span((0, 0), (0, 0)), "text": "\udc00"})
    params = {"textDocument": {"uri": uri}, "position": {"line": 0, "character": 22}}
    assert "result" in await ready.request(HOVER, params)
    await is_alive(ready)


async def test_cancelled_request_gets_cancelled_error(ready: RawClient, tmp_path: Path) -> None:
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    uri = from_fs_path(str(tmp_path / "reader.cdsl")) or ""
    params = {"command": "rcgen.generate", "arguments": [uri]}
    ready.notify("workspace/executeCommand", params, id=5)
    ready.notify("$/cancelRequest", {"id": 5})
    response = await ready.response(5)
    assert response["error"]["code"] == CANCELLED
    ready.notify("$/cancelRequest", {"id": 5})
    ready.notify("$/cancelRequest", {"id": "unheard of"})
    await is_alive(ready)


async def test_requests_before_initialize_are_rejected(client: RawClient) -> None:
    response = await client.request("workspace/symbol", {"query": ""})
    assert response["error"]["code"] == NOT_INITIALIZED
    opened(client, "file:///a.pdsl", "x")
    await client.initialize()
    await is_alive(client)


async def test_second_initialize_is_rejected(ready: RawClient) -> None:
    response = await ready.request("initialize", {"capabilities": {}})
    assert response["error"]["code"] == INVALID_REQUEST
    await is_alive(ready)


async def test_requests_after_shutdown_are_rejected(ready: RawClient) -> None:
    assert (await ready.request("shutdown"))["result"] is None
    response = await ready.request("workspace/symbol", {"query": ""}, 2)
    assert response["error"]["code"] == INVALID_REQUEST
    ready.notify("exit")
    assert await ready.exit_code() == 0


async def test_exit_without_shutdown_has_code_1(ready: RawClient) -> None:
    ready.notify("exit")
    assert await ready.exit_code() == 1


async def test_exit_before_initialize_ends_server(client: RawClient) -> None:
    client.notify("exit")
    assert await client.exit_code() == 1


async def test_disconnect_of_client_ends_server(ready: RawClient) -> None:
    assert ready.process.stdin is not None
    ready.process.stdin.close()
    assert await ready.exit_code() in (0, 1)
