"""Calls functions on a host: one process there answers several requests.

In: a connection and the Python of the host. Out: answers of the modules in `on_host`, which are
sent as source text.
"""

from __future__ import annotations

import asyncio
import json
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from robocomp_dsl.deploy.hosts.connection import HostConnection, HostProcess
from robocomp_dsl.deploy.hosts.errors import HostError, HostTimeout, HostWriteError

MODULES = ("files", "environments", "garbage", "dispatch")
REQUEST_TIMEOUT_S = 600.0
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
        await self._process.write(f"{len(source)}\n".encode() + source)
        return self

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if self._process is not None:
            await self._process.close()

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
        assert self._process is not None  # noqa: S101 - it is entered
        await self._process.write(request)
        count = await self._process.readline()
        if not count:
            process, self._process = self._process, None
            result = await process.close()
            lines = result.stderr.decode("utf-8", "replace").strip().splitlines()
            reason = lines[-1] if lines else f"exit code {result.code}"
            raise ContentError(f"{self._host}: {self.python} ended: {reason}")
        pieces = [await self._process.readline() for _ in range(int(count))]
        data: dict[str, Any] = json.loads(b"".join(piece.rstrip(b"\n") for piece in pieces))
        return data


@cache
def source_text() -> bytes:
    """The modules of `on_host` as one source text."""
    folder = Path(__file__).with_name("on_host")
    texts = [(folder / f"{name}.py").read_text("utf-8") for name in MODULES]
    return (_FUTURE + "\n".join(text.replace(_FUTURE, "") for text in texts)).encode()
