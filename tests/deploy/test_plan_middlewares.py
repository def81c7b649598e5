"""Plans: middlewares, external programs, quality of service per connection, and monitors."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli.rcdeploy.plan import as_data, as_text
from robocomp_dsl.deploy.plan import Plan, plan
from robocomp_dsl.deploy.selection import select_group
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Deployment
from tests.check.other_middlewares import OTHER_MIDDLEWARES

COMPONENTS = {
    "body": "implements Laser; publishes LaserPub;",
    "reflex": "requires Laser; subscribesTo LaserPub;",
    "marked": "requires Laser(rpc, zenoh); subscribesTo LaserPub(shm);",
}


def deployment_of(folder: Path, text: str, component_settings: str = "") -> Deployment:
    """The deployment of the statements `text`, which has no errors."""
    imports = ""
    for name, ports in COMPONENTS.items():
        (folder / f"{name}.cdsl").write_text(
            'import "Laser.idsl"; import "LaserPub.idsl";\n'
            f"Component {name} {{ Communications {{ {ports} }}; language Python;"
            f" {component_settings} }};\n"
        )
        imports += f'import "{name}.cdsl";\n'
    path = folder / "app.ddsl"
    path.write_text(f"{imports}Deployment app {{ {text} }};\n")
    report = Report()
    workspace = Workspace(environ={}, middlewares=OTHER_MIDDLEWARES)
    deployment = check_ddsl(path, workspace, report)
    assert deployment is not None
    assert [f"{d.code.id} {d.message}" for d in report.sorted()] == []
    return deployment


def plan_of(deployment: Deployment) -> Plan:
    return plan(deployment, name="app", domain="d", interpreter="python3")


def flags(folder: Path, text: str, name: str, settings: str = "") -> list[str]:
    """The options of a process after `--domain d`, without `--log-format json`."""
    planned = plan_of(deployment_of(folder, text, settings))
    argv = list(next(p.argv for p in planned.processes if p.name == name))
    rest = argv[argv.index("--domain") + 2 :]
    at = rest.index("--log-format")
    return rest[:at] + rest[at + 2 :]


CONNECT = ["--connect", "Laser=body", "--connect", "LaserPub=body"]


def test_plan_without_words_keeps_middleware_of_component(tmp_path: Path) -> None:
    text = "component body; component reflex;"
    assert flags(tmp_path, text, "reflex") == CONNECT
    assert flags(tmp_path, text, "reflex", "middleware shm;") == CONNECT
    assert flags(tmp_path, text, "body", "middleware shm;") == []
    planned = plan_of(deployment_of(tmp_path, text, "middleware shm;"))
    assert planned.middlewares == ("shm",)


@pytest.mark.parametrize(
    ("text", "settings", "expected"),
    [
        ("middleware shm; component body;", "", ["--middleware", "shm"]),
        ("middleware shm; component body;", "middleware zenoh;", []),
        ("component body { middleware shm; };", "middleware zenoh;", ["--middleware", "shm"]),
        (
            'component body { port Laser over rpc at "tcp -p 1"; };',
            "",
            ["--middleware", "Laser=rpc", "--address", "Laser=rpc:tcp -p 1"],
        ),
    ],
)
def test_middleware_flags_of_component_words(
    tmp_path: Path, text: str, settings: str, expected: list[str]
) -> None:
    assert flags(tmp_path, text, "body", settings) == expected


def test_middleware_flags_of_marks_and_connections(tmp_path: Path) -> None:
    text = """
        component body; component marked { middleware shm; }; component reflex;
        connect marked.Laser -> body.Laser over rpc;
        connect reflex.Laser -> body.Laser over shm;
        connect body.LaserPub -> marked.LaserPub over zenoh;
        connect body.LaserPub -> reflex.LaserPub;
    """
    assert flags(tmp_path, text, "body") == ["--middleware", "Laser=rpc,shm"]
    assert flags(tmp_path, text, "marked") == [
        *("--middleware", "shm", "--middleware", "Laser=rpc", "--middleware", "LaserPub=zenoh"),
        *CONNECT,
    ]
    assert flags(tmp_path, text, "reflex") == ["--middleware", "Laser=shm", *CONNECT]


def test_port_without_words_follows_other_end(tmp_path: Path) -> None:
    text = """
        component body; component marked; component reflex;
        connect marked.Laser -> body.Laser;
    """
    assert flags(tmp_path, text, "marked") == CONNECT
    assert flags(tmp_path, text, "body") == [
        *("--middleware", "Laser=rpc,zenoh", "--middleware", "LaserPub=shm,zenoh"),
    ]
    assert flags(tmp_path, text, "reflex") == CONNECT


EXTERNALS = """
    component body { port Laser over rpc at "tcp -p 1"; }; component reflex;
    /// The old robot.
    extern laser over rpc at "laser:tcp -h 10.0.0.2 -p 10001" implements Laser;
    extern scan over bus at "/scan" publishes LaserPub;
    extern viewer over bus at "/view" subscribesTo LaserPub;
    extern gui over rpc requires Laser;
    connect reflex.Laser -> laser.Laser;
    connect scan.LaserPub -> reflex.LaserPub;
    connect body.LaserPub -> reflex.LaserPub;
    connect body.LaserPub -> viewer.LaserPub;
    connect gui.Laser -> body.Laser;
"""


def test_plan_connects_external_programs(tmp_path: Path) -> None:
    assert flags(tmp_path, EXTERNALS, "reflex") == [
        *("--middleware", "Laser=rpc", "--middleware", "LaserPub=bus,zenoh"),
        *("--connect", "Laser=laser@rpc:laser:tcp -h 10.0.0.2 -p 10001"),
        *("--connect", "LaserPub=scan@bus:/scan", "--connect", "LaserPub=body"),
    ]
    assert flags(tmp_path, EXTERNALS, "body") == [
        *("--middleware", "Laser=rpc", "--middleware", "LaserPub=zenoh,bus"),
        *("--address", "Laser=rpc:tcp -p 1", "--connect", "LaserPub=viewer@bus:/view"),
    ]


def test_plan_shows_external_programs(tmp_path: Path) -> None:
    planned = plan_of(deployment_of(tmp_path, EXTERNALS))
    assert [process.name for process in planned.processes] == ["body", "reflex"]
    text = "\n".join(as_text(planned))
    assert text.startswith("app: 2 components over rpc, zenoh, bus\n")
    assert "\nexternal laser: implements RoboCompLaser::Laser\n" in text
    assert '   over rpc at "laser:tcp -h 10.0.0.2 -p 10001", used by reflex\n' in text
    assert "\nexternal gui: requires RoboCompLaser::Laser\n   over rpc, used by body\n" in text
    data = as_data(planned)
    assert data["middlewares"] == ["rpc", "zenoh", "bus"]
    assert [(p["name"], p["users"]) for p in data["externals"]] == [
        ("laser", ["reflex"]),
        ("scan", ["reflex"]),
        ("viewer", ["body"]),
        ("gui", ["body"]),
    ]


def test_plan_shows_connections_between_external_programs(tmp_path: Path) -> None:
    text = 'connect bus "/a:o" -> "/b:i" carrier fast; connect bus "/a:o" -> "/c:i";'
    planned = plan_of(deployment_of(tmp_path, text))
    shown = "\n".join(as_text(planned))
    assert "   /a:o -> /b:i over bus (fast)\n   /a:o -> /c:i over bus" in shown
    assert as_data(planned)["external_connections"] == [
        {"middleware": "bus", "source": "/a:o", "target": "/b:i", "carrier": "fast"},
        {"middleware": "bus", "source": "/a:o", "target": "/c:i", "carrier": ""},
    ]


def test_select_group_keeps_its_external_programs(tmp_path: Path) -> None:
    text = """
        extern laser over rpc at "a" implements Laser;
        extern other over rpc at "b" implements Laser;
        component body;
        component reflex;
        connect reflex.Laser -> other.Laser;
        group arm
        {
            component inner : reflex;
            component source : body;
            connect inner.Laser -> laser.Laser;
        };
    """
    selected = select_group(deployment_of(tmp_path, text), "arm")
    planned = plan_of(selected)
    assert [(p.name, p.users) for p in planned.externals] == [("laser", ("arm-inner",))]
    argv = next(p.argv for p in planned.processes if p.name == "arm-inner")
    assert "Laser=laser@rpc:a" in argv


def test_plan_passes_qos_of_each_connection_if_they_differ(tmp_path: Path) -> None:
    text = """
        component body; component reflex; component second : reflex; component third : reflex;
        connect reflex.Laser -> body.Laser { priority high; thread priority 7; };
        connect body.LaserPub -> reflex.LaserPub over bus { latched; keep last 3; };
        connect body.LaserPub -> second.LaserPub over bus { liveliness 500 ms; keep last 5; };
        connect body.LaserPub -> third.LaserPub over bus;
    """
    found = flags(tmp_path, text, "body")
    qos = [found[i + 1] for i, flag in enumerate(found) if flag == "--qos"]
    assert qos == [
        "Laser/reflex.Laser=priority=high,thread_priority=7",
        "LaserPub/reflex.LaserPub=depth=3,latched",
        "LaserPub/second.LaserPub=depth=5,liveliness=500",
    ]
    found = flags(tmp_path, text, "reflex")
    assert found[-4:] == [
        *("--qos", "Laser=priority=high,thread_priority=7"),
        *("--qos", "LaserPub=depth=3,latched"),
    ]


MONITOR = """
from robocomp_dsl.runtime import Monitor

class Limit(Monitor):
    def __init__(self, most: float = 1.0, name: str = "") -> None:
        self.most = most

    def accept(self, operation, arguments):
        self.set_event("seen", 0.5)
        return True
"""


def monitors_of(folder: Path, text: str, name: str) -> list[dict[str, object]]:
    """The value of `--monitors` of a process."""
    (folder / "limits.py").write_text(MONITOR)
    found = flags(folder, text, name)
    if "--monitors" not in found:
        return []
    entries: list[dict[str, object]] = json.loads(found[found.index("--monitors") + 1])
    return entries


def test_plan_passes_monitors_to_the_end_where_they_run(tmp_path: Path) -> None:
    text = """
        component body { prefix left; }; component reflex { prefix left; };
        connect body.LaserPub -> reflex.LaserPub
        {
            monitor "limits.py" Limit { most = 3; name = front; } on failure close;
            monitor "limits.py" Limit at sender;
        };
        connect reflex.Laser -> body.Laser
        {
            monitor "limits.py" Limit;
            monitor "limits.py" Limit { most = 2.5; } at receiver;
        };
    """
    file = str((tmp_path / "limits.py").resolve())
    plain = {"file": file, "class": "Limit", "parameters": {}, "on_failure": "bypass"}
    most = plain | {"parameters": {"most": 3, "name": "front"}, "on_failure": "close"}
    half = plain | {"parameters": {"most": 2.5}}
    assert monitors_of(tmp_path, text, "left/body") == [
        {"port": "LaserPub", "at": "sender", "peer": "/left/reflex.LaserPub", "monitors": [plain]},
        {"port": "Laser", "at": "receiver", "peer": "/left/reflex.Laser", "monitors": [half]},
    ]
    assert monitors_of(tmp_path, text, "left/reflex") == [
        {"port": "LaserPub", "at": "receiver", "peer": "/left/body.LaserPub", "monitors": [most]},
        {"port": "Laser", "at": "sender", "peer": "/left/body.Laser", "monitors": [plain]},
        {"port": "Laser", "at": "identify", "peer": "/left/body.Laser"},
    ]


def test_plan_passes_conditions_of_arbitration_to_receiver(tmp_path: Path) -> None:
    text = """
        component body; component explorer : body; component reflex;
        connect reflex.Laser -> body.Laser;
        connect body.LaserPub -> reflex.LaserPub { monitor "limits.py" Limit; };
        arbitrate reflex.LaserPub
        {
            from body.LaserPub when seen /* the face */ ;
            from explorer.LaserPub when ! seen;
        };
    """
    assert monitors_of(tmp_path, text, "body") == []
    entries = monitors_of(tmp_path, text, "reflex")
    assert [(e["peer"], e["at"], e["when"]) for e in entries] == [
        ("body.LaserPub", "receiver", "seen"),
        ("explorer.LaserPub", "receiver", "! seen"),
    ]
    assert entries[1]["monitors"] == []


def test_port_with_peer_on_other_host_uses_middlewares_that_connect_hosts(tmp_path: Path) -> None:
    for name, ports in (
        ("both", "implements Laser(local, zenoh); publishes LaserPub(local, zenoh);"),
        ("user", "requires Laser(local, zenoh); subscribesTo LaserPub(local, zenoh);"),
    ):
        (tmp_path / f"{name}.cdsl").write_text(
            'import "Laser.idsl"; import "LaserPub.idsl";\n'
            f"Component {name} {{ Communications {{ {ports} }}; language Python; }};\n"
        )
    path = tmp_path / "app.ddsl"
    path.write_text(
        'import "both.cdsl"; import "user.cdsl";\nDeployment app\n{\n'
        '    host robot { address "10.0.0.2"; };\n    component both on robot;\n'
        "    component near : user on robot;\n    component far : user;\n};\n"
    )
    report = Report()
    deployment = check_ddsl(path, Workspace(environ={}), report)
    assert deployment is not None
    assert not report.has_errors
    argv = {process.name: process.argv for process in plan_of(deployment).processes}
    assert "Laser=zenoh" in argv["far"]
    assert "LaserPub=zenoh" in argv["far"]
    for name in ("near", "both"):
        assert not [word for word in argv[name] if word.endswith("=zenoh")]
