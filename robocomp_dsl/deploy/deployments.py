"""The deployments that this user runs, with their engines.

In: what runs on this machine, and the registry of deployments over hosts. Out: engines.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.deploy import instances
from robocomp_dsl.deploy.engine import Engine, EngineError
from robocomp_dsl.deploy.supervisor_engine import SupervisorEngine


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


def is_meant(engine: Engine, which: str) -> bool:
    """Whether `which` is its name or its file."""
    return which == engine.name or str(Path(which).resolve()) == engine.path
