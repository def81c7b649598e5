"""kill -9 of components and routers under load, over two hosts with mutual TLS; a reboot."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from statistics import median

import pytest

from robocomp_dsl.deploy.units import names
from tests.hosts.faults.loaded_app import (
    UNDER_LOAD,
    LoadedApp,
    kill_unit,
    percentile,
    show_unit,
)
from tests.support.waiting import wait_until

ROUNDS = int(os.environ.get("FAULT_ROUNDS", "2"))
"""How often each component is killed."""
READY_GOAL_S = 1.0
OFTEN = "restart always max 1000 in 1 s;"
PLACES = {"ledger": "robot", "caller": "base", "source": "base", "sink": "robot"}
EFFECTS = {
    "ledger": ("caller", "acknowledged"),
    "caller": ("caller", "acknowledged"),
    "source": ("sink", "received"),
    "sink": ("sink", "received"),
}
"""The component, and its journal, that goes on when a component does."""
Record = Callable[[str, object], None]


@pytest.fixture
def loaded(app: LoadedApp) -> LoadedApp:
    """Calls from `base` to `robot`, and publications on the same way."""
    app.describe({name: f"{host} {OFTEN}" for name, host in PLACES.items()})
    assert not app.up().failed, app.lines
    return app


def test_killed_components_lose_no_acknowledged_call(
    loaded: LoadedApp, record_property: Record
) -> None:
    ready: list[float] = []
    used: list[float] = []
    for component in UNDER_LOAD * ROUNDS:
        others = {name: pid for name, pid in loaded.unit_pids().items() if name != component}
        killed = loaded.kill(component)
        seconds = loaded.ready_again(component, killed)
        ready.append(seconds)
        used.append(loaded.first_after(*EFFECTS[component], killed + seconds) - killed)
        after = loaded.unit_pids()
        assert {name: after[name] for name in others} == others
    assert loaded.lost_calls() == set()
    record_property("kill -9 of each component: kills", len(ready))
    record_property("kill -9: acknowledged calls", len(loaded.journal("caller", "acknowledged")))
    record_property("kill -9: acknowledged calls lost", 0)
    record_property("kill -9: calls executed twice", loaded.doubled_calls())
    for label, times in (("ready", ready), ("in use by its peers", used)):
        shares = f"{median(times):.2f}, {percentile(times, 0.99):.2f}, {max(times):.2f}"
        record_property(f"kill -9 → {label}: p50, p99, max [s]", shares)


@pytest.mark.parametrize("host", ["robot", "base"])
def test_killed_router_restarts_nothing_else(
    loaded: LoadedApp, host: str, record_property: Record
) -> None:
    router = names.router_name(loaded.name)
    machine = loaded.hosts.by_name[host]
    before, old = loaded.units(), show_unit(machine, router)
    assert old.active == "active"
    killed = kill_unit(machine, old.pid)
    wait_until(lambda: show_unit(machine, router).pid not in (0, old.pid), "no new router")
    restarted = wait_until(
        lambda: unit.ready_at if (unit := show_unit(machine, router)).ready_at > killed else 0.0,
        "the router is not ready",
    )
    calls = loaded.first_after("caller", "acknowledged", restarted) - killed
    publications = loaded.first_after("sink", "received", restarted) - killed
    after = loaded.units()
    assert {name: (u.pid, u.restarts) for name, u in after.items()} == {
        name: (u.pid, u.restarts) for name, u in before.items()
    }
    assert loaded.lost_calls() == set()
    text = f"{restarted - killed:.2f}, {calls:.2f}, {publications:.2f}"
    record_property(f"router of {host} killed: listens, calls, publications after [s]", text)


@pytest.mark.parametrize("host", ["robot", "base"])
def test_rebooted_host_comes_up_by_itself(
    loaded: LoadedApp, host: str, record_property: Record
) -> None:
    own = [name for name, place in PLACES.items() if place == host]
    others = [name for name in UNDER_LOAD if name not in own]
    before = loaded.units()
    machine = loaded.hosts.by_name[host]
    start = time.monotonic()
    machine.reboot()
    booted = time.monotonic()
    ready = start + max(loaded.ready_again(name, start) for name in own)
    calls = loaded.first_after("caller", "acknowledged", ready)
    publications = loaded.first_after("sink", "received", ready)
    after = loaded.units()
    assert all(after[name].pid == before[name].pid for name in others)
    assert loaded.lost_calls() == set()
    assert not loaded.diff()
    text = f"{ready - booted:.2f}, {calls - booted:.2f}, {publications - booted:.2f}"
    record_property(f"{host} rebooted: ready, calls, publications after boot [s]", text)
