"""The deployments that this user runs, with their engines.

In: what runs on this machine, and the registry of deployments over hosts. Out: engines.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from robocomp_dsl.deploy import instances
from robocomp_dsl.deploy.engine import Engine, EngineError
from robocomp_dsl.deploy.supervisor_engine import SupervisorEngine

if TYPE_CHECKING:
    from robocomp_dsl.deploy.plan import Plan
    from robocomp_dsl.model.deployment import Deployment


def running_deployments() -> list[Engine]:
    """The engines of all running deployments, by name. Raises `EngineError`."""
    supervised = _supervised()
    names = {engine.name for engine in supervised}
    return [*supervised, *(e for e in _hosted() if e.name not in names)]


def _hosted() -> list[Engine]:
    """The deployments over hosts that were not stopped."""
    from robocomp_dsl.deploy.hosts import registry  # noqa: PLC0415 - seldom any

    entries = [entry for entry in registry.registered() if not entry.is_stopped]
    if not entries:
        return []
    from robocomp_dsl.deploy.hosts.host_engine import HostEngine  # noqa: PLC0415 - for them

    return [HostEngine(entry) for entry in entries]


def _supervised() -> list[SupervisorEngine]:
    try:
        return [SupervisorEngine(deployment) for deployment in instances.running()]
    except instances.Unavailable as error:
        raise EngineError(str(error)) from None


def find_hosted(which: str) -> Engine | None:
    """The deployment over hosts with that name or file, also if it was stopped."""
    from robocomp_dsl.deploy.hosts import registry  # noqa: PLC0415 - seldom any

    file = str(Path(which).resolve())
    entry = next((e for e in registry.registered() if which == e.name or file == e.path), None)
    if entry is None:
        return None
    from robocomp_dsl.deploy.hosts.host_engine import HostEngine  # noqa: PLC0415 - loads asyncssh

    return HostEngine(entry)


def described_engine(deployment: Deployment, plan: Plan) -> Engine:
    """The engine of a deployment over hosts that this user has not started."""
    from robocomp_dsl.deploy.hosts.description import described_entry  # noqa: PLC0415
    from robocomp_dsl.deploy.hosts.host_engine import HostEngine  # noqa: PLC0415 - loads asyncssh

    return HostEngine(described_entry(deployment, plan))


def is_meant(engine: Engine, which: str) -> bool:
    """Whether `which` is its name or its file."""
    return which == engine.name or str(Path(which).resolve()) == engine.path
