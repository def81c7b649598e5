"""Connections of tests to simulated hosts."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from typing import Any

import pytest

from robocomp_dsl.deploy.hosts.connection import connect
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.model.deployment import Host
from tests.hosts.rig.machine import SimulatedHost

TEST_TIMEOUT_S = 120.0


def run(task: Coroutine[Any, Any, Any]) -> Any:
    """The result of `task`, which must not hang."""
    return asyncio.run(asyncio.wait_for(task, TEST_TIMEOUT_S))


def host_of(machine: SimulatedHost, address: str = "", user: str = "", port: int = 0) -> Host:
    name = machine.name
    return Host(name, address or machine.address, user or machine.user, ssh_port=port)


def failure(host: Host) -> HostError:
    """Why a connection is refused."""

    async def attempt() -> HostError:
        with pytest.raises(HostError) as caught:
            await connect(host)
        return caught.value

    return run(attempt())
