"""Calls functions on a host: one process there answers several requests.

In: a connection and the Python of the host. Out: answers of the modules in `on_host`, which are
sent as source text.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from robocomp_dsl.deploy.hosts.connection import CommandResult, HostConnection, HostProcess
from robocomp_dsl.deploy.hosts.errors import HostError, HostTimeout, HostWriteError

MODULES = ("files", "environments", "garbage", "dispatch")
REQUEST_TIMEOUT_S = 600.0
_CLOSE_TIMEOUT_S = 10.0
_BOOTSTRAP = (
    "import sys;i=sys.stdin.buffer;"
    "n={'__name__':'robocomp_host'};exec(compile(i.read(int(i.readline())),'rcdeploy','exec'),n);"
    "n['main']()"
)
_FUTURE = "from __future__ import annotations\n"


class ContentError(HostError):
    """A request failed on the host; `kind` is that of `on_host`, or empty."""

    def __init__(self, message: str, kind: str = "") -> None:
        super().__init__(message)
        self.kind = kind


class HostSession:
    """A process on the host that answers requests, as an asynchronous context manager.

    `root` is the folder of the deployment, relative to the user's home.
    """

    def __init__(self, connection: HostConnection, root: str, python: str = "python3") -> None:
        self._connection = connection
        self.root = root
        self.python = python
        self._process: HostProcess | None = None

    async def __aenter__(self) -> Self:
        source = source_text()
        self._process = await self._connection.start([self.python, "-c", _BOOTSTRAP])
        try:
            await self._send(f"{len(source)}\n".encode() + source)
        except BaseException:
            await self._close()
            raise
        return self

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        await self._close()

    async def call(
        self, function: str, arguments: Mapping[str, Any] | None = None, payload: bytes = b""
    ) -> dict[str, Any]:
        """The answer of a function. Raises `HostError`."""
        request = {
            "function": function,
            "root": self.root,
            "payload_bytes": len(payload),
            **(arguments or {}),
        }
        try:
            async with asyncio.timeout(REQUEST_TIMEOUT_S):
                data = await self._exchange(json.dumps(request).encode() + b"\n" + payload)
        except TimeoutError:
            message = f"{self._host}: `{function}` did not end within {REQUEST_TIMEOUT_S:g} s"
            raise HostTimeout(message) from None
        if "answer" in data:
            answer: dict[str, Any] = data["answer"]
            return answer
        message = f"{self._host}: {data['error']}"
        if "errno" in data:
            raise HostWriteError(message)
        raise ContentError(message, data["kind"])

    @property
    def _host(self) -> str:
        return self._connection.host.name or "localhost"

    async def _exchange(self, request: bytes) -> dict[str, Any]:
        await self._send(request)
        assert self._process is not None  # noqa: S101 - it was sent to
        count = await self._process.readline()
        while count and not count.strip().isdigit():  # a login script may print something
            count = await self._process.readline()
        if not count:
            raise self._ended(await self._close())
        pieces = [await self._process.readline() for _ in range(int(count))]
        data: dict[str, Any] = json.loads(b"".join(piece.rstrip(b"\n") for piece in pieces))
        return data

    async def _send(self, data: bytes) -> None:
        assert self._process is not None  # noqa: S101 - it is entered
        try:
            await self._process.write(data)
        except HostError:
            result = await self._close()
            if result is None or not result.code:
                raise
            raise self._ended(result) from None

    async def _close(self) -> CommandResult | None:
        """How the process ended; None without one, or if the link is cut."""
        process, self._process = self._process, None
        if process is not None:
            with contextlib.suppress(HostError, TimeoutError):
                async with asyncio.timeout(_CLOSE_TIMEOUT_S):
                    return await process.close()
        return None

    def _ended(self, result: CommandResult | None) -> ContentError:
        lines = result.error.splitlines() if result else []
        code = f"exit code {result.code}" if result else "the connection was lost"
        reason = lines[-1] if lines else code
        return ContentError(f"{self._host}: {self.python} ended: {reason}")


@cache
def source_text() -> bytes:
    """The modules of `on_host` as one source text."""
    folder = Path(__file__).with_name("on_host")
    texts = [(folder / f"{name}.py").read_text("utf-8") for name in MODULES]
    return (_FUTURE + "\n".join(text.replace(_FUTURE, "") for text in texts)).encode()
