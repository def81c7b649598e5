"""A client that sends any bytes and reads all messages."""

from __future__ import annotations

import asyncio
import json
from asyncio.subprocess import PIPE, Process
from typing import Any

from tests.language_server.editor_client import DEADLINE_S, SERVER


class RawClient:
    """One server of its own on stdin and stdout."""

    def __init__(self, process: Process) -> None:
        self.process = process
        self.received: list[dict[str, Any]] = []

    @classmethod
    async def start(cls) -> RawClient:
        return cls(await asyncio.create_subprocess_exec(*SERVER, stdin=PIPE, stdout=PIPE))

    async def initialize(self) -> dict[str, Any]:
        answer = await self.request("initialize", {"capabilities": {}}, 0)
        self.notify("initialized", {})
        return answer

    def notify(self, method: str, params: Any = None, **more: Any) -> None:
        body = {"jsonrpc": "2.0", "method": method, **more}
        self.send(json.dumps(body if params is None else {**body, "params": params}).encode())

    def send(self, body: bytes) -> None:
        assert self.process.stdin is not None
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n%b" % (len(body), body))

    async def request(self, method: str, params: Any = None, number: int = 1) -> dict[str, Any]:
        """The response to a request; messages before it are appended to `received`."""
        self.notify(method, params, id=number)
        return await self.response(number)

    async def response(self, number: int | None) -> dict[str, Any]:
        async with asyncio.timeout(DEADLINE_S):
            while True:
                message = await self._read()
                if "method" not in message and message.get("id") == number:
                    return message
                self.received.append(message)

    async def _read(self) -> dict[str, Any]:
        assert self.process.stdout is not None
        header = await self.process.stdout.readuntil(b"\r\n\r\n")
        size = int(header.lower().split(b"content-length:")[1].split(b"\r\n")[0])
        message: dict[str, Any] = json.loads(await self.process.stdout.readexactly(size))
        return message

    async def exit_code(self) -> int:
        """The exit code of the server."""
        async with asyncio.timeout(DEADLINE_S):
            return await self.process.wait()

    async def end(self) -> None:
        if self.process.returncode is None:
            self.process.kill()
            await self.process.wait()
