"""A simulated fleet of robots: hosts, and many components with realistic connections.

Each host has the same 50 components by default: drivers (services and topics), perception, control,
and planning. Connections within a host are in groups; the missions of all robots report to the
first host, and its traffic planner calls the missions of all others.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

INTERFACES = """
module Fleet
{
    struct TPose { float x [mm]; float y [mm]; float alpha [rad]; };
    sequence<TPose> TPath;
    exception Unreachable { string reason; };
    interface Base { void setSpeed(float advance, float turn); TPose getPose(); };
    interface Scan { void newScan(TPath rays); };
    interface Image { void newImage(TPath points); };
    interface Pose { void newPose(TPose pose); };
    interface Objects { void newObjects(TPath objects); };
    interface Arm { void moveTo(TPose pose) throws Unreachable; };
    interface Plan { TPath plan(TPose from, TPose to) throws Unreachable; };
    interface Mission { void go(TPose to) throws Unreachable; bool isDone(); };
    interface Report { void newReport(string robot, TPose pose); };
};
"""

KINDS = {
    "base": "implements Base; publishes Pose;",
    "laser": "publishes Scan;",
    "camera": "publishes Image;",
    "localiser": "requires Base; subscribesTo Scan; publishes Pose;",
    "detector": "subscribesTo Image; publishes Objects;",
    "tracker": "subscribesTo Objects; publishes Objects as Tracks;",
    "joint": "implements Arm;",
    "arm": "requires Arm; implements Arm as Tool;",
    "planner": "requires Base; subscribesTo Pose; implements Plan;",
    "mission": "requires Plan, Arm; implements Mission; publishes Report;",
    "logger": "subscribesTo Report;",
    "traffic": "{missions} subscribesTo Report;",
}
COUNTS = {"laser": 4, "camera": 10, "detector": 10, "tracker": 10, "joint": 7}
"""How many components of a kind a robot has, if not one."""


def write_fleet(
    folder: Path, hosts: int = 20, components: int = 50, placed_by: str = "on {}"
) -> Path:
    """Write a fleet below `folder`; the path of its DDSL file. At least 46 components per host.

    Its interfaces are in `folder / "interfaces"`. `placed_by`: where the group of a robot runs;
    `{}` is its host; `by load`: on one of all hosts.
    """
    interfaces = folder / "interfaces"
    interfaces.mkdir()
    (interfaces / "Fleet.idsl").write_text(INTERFACES)
    for name, ports in KINDS.items():
        path = folder / name
        path.mkdir()
        missions = "".join(f"requires Mission as mission{i}; " for i in range(hosts))
        communications = ports.replace("{missions}", missions)
        (path / f"{name}.cdsl").write_text(
            f'import "Fleet.idsl";\nComponent {name}\n{{\n'
            f"    Communications {{ {communications} }};\n    language Python;\n}};\n"
        )
        (path / "main.py").write_text("")
    app = folder / "fleet.ddsl"
    app.write_text("\n".join(_deployment(hosts, components, placed_by)) + "\n")
    return app


def _deployment(hosts: int, components: int, placed_by: str) -> Iterator[str]:
    for name in KINDS:
        yield f'import "{name}/{name}.cdsl";'
    yield "Deployment fleet\n{"
    for host in range(hosts):
        yield f'    host h{host} {{ address "10.0.{host}.2"; labels robot; }};'
    for host in range(hosts):
        yield from _robot(host, components, placed_by)
    yield "    component traffic on h0;"
    for host in range(hosts):
        yield f"    connect traffic.mission{host} -> r{host}.Mission;"
        yield f"    connect r{host}.Report -> traffic.Report {{ priority high; }};"
    yield "};"


def _robot(host: int, components: int, placed_by: str) -> Iterator[str]:
    by_load = placed_by == "by load"
    on = "" if by_load else f" {placed_by.format(f'h{host}')}"
    yield f"    group r{host}{on}\n    {{"
    yield from ["        place by load;"] if by_load else []
    names: list[str] = []
    for kind in KINDS:
        if kind in ("traffic", "logger"):
            continue
        count = COUNTS.get(kind, 1)
        for number in range(count):
            name = kind if count == 1 else f"{kind}{number}"
            after = f" {{ after {names[-1]}; }}" if names and number == 0 else ""
            yield f"        component {name} : {kind}{after};"
            names.append(name)
    extra = components - len(names) - (host == 0)
    for number in range(extra):
        yield f"        component logger{number} : logger;"
    yield "        connect localiser.Base -> base.Base;"
    yield "        connect planner.Base -> base.Base;"
    for number in range(COUNTS["laser"]):
        qos = "{ best_effort; keep last 1; }"
        yield f"        connect laser{number}.Scan -> localiser.Scan {qos};"
    for number in range(COUNTS["camera"]):
        yield f"        connect camera{number}.Image -> detector{number}.Image over local;"
        yield f"        connect detector{number}.Objects -> tracker{number}.Objects;"
    yield "        connect arm.Arm -> joint0.Arm;"
    yield "        connect localiser.Pose -> planner.Pose { priority high; deadline 100 ms; };"
    yield "        connect mission.Plan -> planner.Plan;"
    yield "        connect mission.Arm -> arm.Tool;"
    for number in range(extra):
        yield f"        connect mission.Report -> logger{number}.Report;"
    yield "        export Mission from mission;"
    yield "        export Report from mission;"
    yield "    };"
