"""The deployer's end of the script that runs on a host: requests, replies and state changes.

In: a connection and the name of a deployment. Out: what the host reports. The script ends with the
connection; the units go on.
"""

from __future__ import annotations

import asyncio
import json
from collections import deque
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, TypeAlias

from robocomp_dsl.deploy.hosts.connection import HostConnection, HostProcess
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.deploy.hosts.host_report import HostReport, UnitState
from robocomp_dsl.deploy.units import names

REPLY_TIMEOUT_S = 60.0
END_TIMEOUT_S = 1.0
UNLOCK_TIMEOUT_S = 10.0
"""How long the end of a script is awaited that holds the lock: the next command needs it."""
PING_S = 5.0
SCRIPT = Path(__file__).with_name("agent_script.py")
StateListener: TypeAlias = Callable[[str, UnitState], None]


class HostAgent:
    """A running script on a host, from `open_agent` until `close`."""

    def __init__(self, connection: HostConnection, process: HostProcess) -> None:
        self.connection = connection
        self.host = connection.host
        self._process = process
        self._replies: deque[asyncio.Future[Any]] = deque()
        self._listener: StateListener | None = None
        self._failure: HostError | None = None
        self._has_lock = False
        self._sending = asyncio.Lock()
        loop = asyncio.get_running_loop()
        self._tasks = [loop.create_task(self._receive()), loop.create_task(self._ping())]

    async def close(self) -> None:
        """End the script."""
        for task in self._tasks:
            task.cancel()
        with suppress(HostError, TimeoutError):
            async with asyncio.timeout(UNLOCK_TIMEOUT_S if self._has_lock else END_TIMEOUT_S):
                await self._process.close()

    async def report(self, *, usage: bool = False) -> HostReport:
        """What is deployed on the host, and what runs; with `usage` also memory and CPU."""
        return HostReport.from_dict(await self._request("report", usage=usage))

    async def lock(self, who: str) -> str:
        """Lock the deployment on this host until `close`; returns the holder if it is locked."""
        holder = str((await self._request("acquire", who=who))["holder"])
        self._has_lock = not holder
        return holder

    async def systemctl(self, verb: str, units: Sequence[str]) -> None:
        """Run `systemctl --user`; `start` and `restart` only begin. Raises `HostError`."""
        if units or verb == "daemon-reload":
            reply = await self._request("control", operation=verb, units=list(units))
            if reply["code"] and verb != "reset-failed":
                text = f"{self.host.name}: `systemctl --user {verb}`: {reply['error']}"
                raise HostError(text)

    async def watch(self, units: Sequence[str], listener: StateListener) -> None:
        """Call `listener` with the state of each of `units` now, and whenever it changes."""
        self._listener = listener
        await self._request("watch", units=list(units))

    async def tail(self, component: str, size: int = 16384) -> str:
        """The last `size` bytes of the log of a component."""
        return str((await self._request("tail", component=component, size=size))["text"])

    async def create_folders(self, components: Sequence[str]) -> None:
        """Create the folders of logs."""
        await self._request("folders", components=list(components))

    async def remove_units(self, units: Sequence[str]) -> None:
        """Delete unit files of the deployment."""
        await self._request("remove", units=list(units))

    async def _request(self, verb: str, **fields: Any) -> Any:
        if self._failure:
            raise self._failure
        reply: asyncio.Future[Any] = asyncio.get_running_loop().create_future()
        async with self._sending:
            self._replies.append(reply)
            await self._process.write(json.dumps({"verb": verb, **fields}).encode() + b"\n")
        try:
            async with asyncio.timeout(REPLY_TIMEOUT_S):
                return await reply
        except TimeoutError:
            text = f"{self.host.name}: no reply within {REPLY_TIMEOUT_S:g} s"
            raise HostError(text) from None

    async def _receive(self) -> None:
        try:
            while line := await self._process.readline():
                if line.startswith(b"{"):  # a login script may print something
                    self._handle(json.loads(line))
            result = await self._process.close()
            reason = result.error.rpartition("\n")[2] or f"exit code {result.code}"
            failure = HostError(f"{self.host.name}: the connection or Python ended: {reason}")
        except HostError as error:
            failure = error
        except ValueError as error:
            failure = HostError(f"{self.host.name}: unreadable reply: {error}")
        self._failure = failure
        for reply in self._replies:
            if not reply.done():
                reply.set_exception(failure)
        self.on_failure(failure)

    def on_failure(self, failure: HostError) -> None:
        """Called when the script has ended; replaced by whoever watches."""

    def _handle(self, message: dict[str, Any]) -> None:
        if "states" in message:
            if self._listener:
                for unit, fields in message["states"].items():
                    self._listener(unit, UnitState.from_properties(fields, message["monotonic"]))
            return
        if not self._replies or "problem" in message:
            return
        reply = self._replies.popleft()
        if reply.done():
            return
        if "error" in message:
            reply.set_exception(HostError(f"{self.host.name}: {message['error']}"))
        else:
            reply.set_result(message["reply"])

    async def _ping(self) -> None:
        while True:
            await asyncio.sleep(PING_S)
            with suppress(HostError):
                await self._request("ping")


async def open_agent(connection: HostConnection, deployment: str) -> HostAgent:
    """Start the script on a host. Raises `HostError`."""
    prefix = names.service_name(deployment, "").removesuffix(".service")
    process = await connection.start(
        [
            *("python3", "-c", SCRIPT.read_text("utf-8")),
            *(names.root_folder(deployment), prefix, f"{prefix[:-1]}."),
        ]
    )
    return HostAgent(connection, process)
