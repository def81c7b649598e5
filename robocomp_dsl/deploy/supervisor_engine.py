"""The engine of one machine: requests to the rcdeploy that supervises a deployment."""

from __future__ import annotations

import os
import select
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from typing import Any

from robocomp_dsl.deploy import control, instances
from robocomp_dsl.deploy.engine import DeploymentStatus, EngineError, StopResult
from robocomp_dsl.deploy.external_connection import ConnectionStatus
from robocomp_dsl.deploy.external_program import ExternalProgram
from robocomp_dsl.deploy.status import ProcessStatus, SimulatedTime, format_duration

EXIT_TIMEOUT_S = 5.0
"""Maximum time for rcdeploy to exit after all its components have exited."""


class SupervisorEngine:
    """A deployment that an rcdeploy of this user runs in the foreground. See `Engine`."""

    def __init__(self, running: instances.RunningDeployment) -> None:
        self.running = running
        self.name, self.path, self.domain = running.name, running.path, running.domain

    def summary(self) -> str:
        """See `Engine`."""
        since = format_duration(time.time() - self.running.since)
        return f"pid {self.running.pid}, domain {self.domain}, up {since}"

    def as_dict(self) -> dict[str, Any]:
        """See `Engine`."""
        return asdict(self.running)

    def components(self) -> list[str]:
        """See `Engine`; raises `EngineError`."""
        rows = self._status()["rows"]
        return [name for row in rows for name in (str(row["name"]), *_members(row))]

    def answering_components(self) -> list[str]:
        """See `Engine`."""
        status = self._status()
        names = [name for row in status["rows"] for name in _members(row) or (str(row["name"]),)]
        return [name for name in names if name not in status.get("programs", ())]

    def status(self) -> DeploymentStatus:
        """See `Engine`."""
        answer = self._status()
        return DeploymentStatus(
            [ProcessStatus.from_dict(row) for row in answer["rows"]],
            SimulatedTime(**answer["clock"]) if answer["clock"] else None,
            [ExternalProgram.from_dict(fields) for fields in answer.get("externals", ())],
            [ConnectionStatus(**link) for link in answer.get("connections", ())],
        )

    def change(self, verb: str, names: Sequence[str], report: Callable[[str], object]) -> int:
        """See `Engine`."""
        code = None
        try:
            for reply in control.send_request(self.name, {"verb": verb, "components": list(names)}):
                code = reply.get("code", code)
                if "text" in reply:
                    report(reply["text"])
        except instances.Unavailable as error:
            raise EngineError(str(error)) from None
        if code is None:
            raise EngineError(f"`{self.name}` ended before it had done so")
        return int(code)

    def stop(self, report: Callable[[str], object]) -> StopResult:
        """See `Engine`."""
        del report
        ended = _handle(self.running.pid)
        try:
            answer = next(control.send_request(self.name, {"verb": "stop"}), None)
        except instances.Unavailable as error:
            raise EngineError(str(error)) from None
        if answer is None:
            raise EngineError(f"`{self.name}` ended without a word; it may have been killed")
        if ended is not None:
            select.select([ended], [], [], EXIT_TIMEOUT_S)  # so that its name is free afterwards
        return StopResult(int(answer["code"]), str(answer["reason"]))

    def _status(self) -> dict[str, Any]:
        try:
            return next(control.send_request(self.name, {"verb": "status"}))
        except (instances.Unavailable, StopIteration):
            raise EngineError(f"`{self.name}` does not answer; it may be ending") from None


def _handle(pid: int) -> int | None:
    try:
        return os.pidfd_open(pid)
    except OSError:
        return None


def _members(row: Mapping[str, Any]) -> list[str]:
    """The components of a group that is one process."""
    return [name for name, _ in row.get("members", ())]
