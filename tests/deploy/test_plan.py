"""Plans: command lines, connections, clocks, quality of service and order."""

from __future__ import annotations

from graphlib import CycleError
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.deploy.plan import batches, plan
from robocomp_dsl.model.component import Component, Port, Role
from robocomp_dsl.model.deployment import Clock, Connection, Deployment, Host, Instance, Qos
from robocomp_dsl.model.interface import Interface
from robocomp_dsl.model.parameter import ParameterSet
from robocomp_dsl.model.qos_text import format_qos
from robocomp_dsl.runtime.component.qos_settings import parse_qos
from robocomp_dsl.runtime.connection.endpoint import Qos as RuntimeQos
from robocomp_dsl.source import Source

SPAN = Source(Path("x.ddsl"), "x").file_span
HERE = Host("", "127.0.0.1")
LASER = Interface("RoboCompLaser", "Laser", SPAN, "", ())
SCAN = Interface("RoboCompScan", "Scan", SPAN, "", ())


def component(name: str, *ports: Port, parameters: bool = False) -> Component:
    path = Path("/robot") / name / f"{name}.cdsl"
    own = ParameterSet(name, path, SPAN, ()) if parameters else None
    return Component(name, path, SPAN, "Python", (), ports, own)


def port(role: Role, interface: Interface, name: str = "") -> Port:
    return Port(role, interface, name or interface.name, SPAN)


def instance(name: str, of: Component, **fields: Any) -> Instance:
    return Instance(name, of, SPAN, HERE, **fields)


def wire(source: Instance, source_port: int, target: Instance, target_port: int, qos: Qos) -> Any:
    ends = (source.component.ports[source_port], target.component.ports[target_port])
    return Connection(source, ends[0], target, ends[1], SPAN, qos)


BASE = component(
    "base",
    port(Role.IMPLEMENTS, LASER, "front"),
    port(Role.IMPLEMENTS, LASER, "back"),
    port(Role.PUBLISHES, SCAN),
    parameters=True,
)
NAV = component("nav", port(Role.REQUIRES, LASER, "laser"), port(Role.SUBSCRIBES, SCAN))
ONE = component("one", port(Role.IMPLEMENTS, LASER))


def deployment(instances: list[Instance], *connections: Connection) -> Deployment:
    return Deployment("robot", Path("robot.ddsl"), SPAN, "zenoh", tuple(instances), connections)


def commands(deployment: Deployment) -> dict[str, tuple[str, ...]]:
    planned = plan(deployment, name="robot", domain="d-1", interpreter="/py")
    return {p.name: p.argv for p in planned.processes}


COMMON = ("--domain", "d-1", "--middleware", "zenoh", "--log-format", "json")


def test_plan_builds_command_lines() -> None:
    base = instance(
        "body",
        BASE,
        settings=(("rate", 20.5), ("on", True), ("name", "a b"), ("motors[1].id", 3)),
        port=7451,
    )
    nav = instance("nav", NAV, config=Path("/etc/nav.yaml"), executable="./nav --fast 'x y'")
    found = commands(deployment([base, nav], wire(nav, 0, base, 1, Qos())))
    assert found["body"] == (
        "/py", "main.py", "--name", "body", *COMMON,
        "--set", "rate=20.5", "--set", "on=true", "--set", "name=a b", "--set", "motors[1].id=3",
        "--listen-port", "7451",
    )  # fmt: skip
    assert found["nav"] == (
        "./nav", "--fast", "x y", "--name", "nav", *COMMON, "--config", "/etc/nav.yaml",
        "--connect", "laser=body.back",
    )  # fmt: skip


def test_plan_puts_prefix_before_names_and_peers() -> None:
    base = instance("base", BASE, prefix="left", after=("nav",))
    nav, far = instance("nav", NAV), instance("far", NAV, prefix="right")
    wires = [wire(user, 0, base, 0, Qos()) for user in (nav, far)]
    clock = Clock("sim", base, lockstep=True)
    robot = deployment([nav, base, far], *wires).replace(clock=clock)
    planned = plan(robot, name="robot", domain="d-1", interpreter="/py")
    argv = {process.name: process.argv for process in planned.processes}
    assert list(argv) == ["nav", "left/base", "right/far"]
    assert argv["left/base"][2:6] == ("--name", "base", "--prefix", "left")
    assert "laser=left/base.front" in argv["nav"]
    assert "laser=/left/base.front" in argv["right/far"]
    assert "lockstep,from=/left/base,with=/nav+/right/far,limit=10" in argv["left/base"]
    assert "lockstep,from=left/base,limit=10" in argv["nav"]
    assert planned.processes[1].after == ("nav",)
    assert planned.processes[1].stops_after == ("right/far",)
    assert planned.shutdown_batches() == [["right/far"], ["left/base"], ["nav"]]
    assert planned.clock.startswith("simulated, from left/base")


def test_plan_passes_context_and_config_name() -> None:
    base = instance("base", BASE, context="lab", config_name="left/base.yaml")
    assert commands(deployment([base]))["base"] == (
        "/py", "main.py", "--name", "base", *COMMON,
        "--context", "lab", "--config-name", "left/base.yaml",
    )  # fmt: skip


WORLD = component("world", port(Role.PUBLISHES, SCAN))


@pytest.mark.parametrize(
    ("clock", "of_source", "of_other", "restart", "shown"),
    [
        ({}, None, None, "on-failure", "wall"),
        ({"kind": "sim"}, "sim,from=w", "sim,from=w", "on-failure", "simulated, from w"),
        (
            {"kind": "sim", "lockstep": True, "limit_s": 2.5},
            "lockstep,from=w,with=a+b,limit=2.5",
            "lockstep,from=w,limit=2.5",
            "on-failure",
            "simulated, from w, lock-step: at most 2.5 s per step,"
            " continues without the component on a time-out",
        ),
        (
            {"kind": "sim", "lockstep": True, "stop_on_timeout": True},
            "lockstep,from=w,with=a+b,limit=10,lost=stop",
            "lockstep,from=w,limit=10,lost=stop",
            "never",  # a restarted source would not match the state of the others
            "simulated, from w, lock-step: at most 10 s per step, stops on a time-out",
        ),
    ],
)
def test_plan_passes_clock_options(
    clock: dict[str, Any], of_source: str | None, of_other: str | None, restart: str, shown: str
) -> None:
    them = [instance("b", ONE), instance("w", WORLD), instance("a", ONE)]
    if clock:
        clock["source"] = them[1]
    planned = plan(
        deployment(them).replace(clock=Clock(**clock)), name="x", domain="d", interpreter="p"
    )
    clocks = {process.name: _flag(process.argv, "--clock") for process in planned.processes}
    assert clocks == {"b": of_other, "w": of_source, "a": of_other}
    assert [process.restart.policy for process in planned.processes] == [
        "on-failure",
        restart,
        "on-failure",
    ]
    assert planned.clock == shown


def _flag(argv: tuple[str, ...], name: str) -> str | None:
    return argv[argv.index(name) + 1] if name in argv else None


def test_plan_passes_connections_to_client_side() -> None:
    base, server, nav = instance("base", BASE), instance("one", ONE), instance("nav", NAV)
    best = Qos(reliable=False, depth=1, deadline_ms=40)
    found = commands(
        deployment(
            [base, server, nav],
            wire(nav, 0, server, 0, Qos(reliable=True)),
            wire(base, 2, nav, 1, best),
        )
    )
    tail = len(("/py", "main.py", "--name", "x", *COMMON))
    assert found["nav"][tail:] == (
        "--connect", "laser=one", "--connect", "Scan=base",
        "--qos", "laser=reliable", "--qos", "Scan=best_effort,depth=1,deadline=40",
    )  # fmt: skip
    assert found["base"][tail:] == (
        "--qos", "Scan=best_effort,depth=1,deadline=40",
    )  # fmt: skip
    assert found["one"][tail:] == ("--qos", "Laser=reliable")


def test_plan_stops_clients_before_servers() -> None:
    base, server, nav = instance("base", BASE), instance("one", ONE), instance("nav", NAV)
    spare = instance("spare", NAV, after=("base",))
    planned = plan(
        deployment(
            [base, server, nav, spare], wire(nav, 0, server, 0, Qos()), wire(base, 2, nav, 1, Qos())
        ),
        name="r", domain="d", interpreter="/py",
    )  # fmt: skip
    assert [p.stops_after for p in planned.processes] == [("nav", "spare"), ("nav",), (), ()]
    assert planned.shutdown_batches() == [["nav", "spare"], ["base", "one"]]
    assert [p.after for p in planned.processes] == [(), (), (), ("base",)]


@pytest.mark.parametrize(
    ("waits", "expected"),
    [
        ({}, []),
        ({"a": set(), "b": set()}, [["a", "b"]]),
        ({"a": {"b"}, "b": set(), "c": {"a"}}, [["b"], ["a"], ["c"]]),
        ({"a": {"elsewhere"}}, [["a"]]),
    ],
)
def test_batches_are_in_topological_order(
    waits: dict[str, set[str]], expected: list[list[str]]
) -> None:
    assert batches(waits) == expected


def test_batches_reject_a_cycle() -> None:
    with pytest.raises(CycleError):
        batches({"a": {"b"}, "b": {"a"}, "c": set()})


@pytest.mark.parametrize(
    ("qos", "expected"),
    [
        (Qos(), ""),
        (Qos(reliable=False, priority="low", depth=1, deadline_ms=40),
         "best_effort,depth=1,priority=low,deadline=40"),
        (Qos(reliable=True, keep_all=True, latched=True), "reliable,keep_all,latched"),
        (Qos(deadline_ms=12.5, liveliness_ms=500, thread_priority=3),
         "deadline=12.5,liveliness=500,thread_priority=3"),
    ],
)  # fmt: skip
def test_format_qos_is_text_that_components_read(qos: Qos, expected: str) -> None:
    assert format_qos(qos) == expected
    ports, _ = parse_qos([f"Laser={expected}"] if expected else [])
    assert ports.get("Laser", RuntimeQos()) == RuntimeQos(
        reliable=qos.reliable,
        depth=qos.depth,
        priority=qos.priority,
        deadline=qos.deadline_ms / 1000 if qos.deadline_ms else None,
        keep_all=qos.keep_all,
        latched=qos.latched,
        liveliness=qos.liveliness_ms / 1000 if qos.liveliness_ms else None,
        thread_priority=qos.thread_priority,
    )
