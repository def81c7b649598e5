"""Files of rcmanager and of its successor are migrated to valid deployments."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate.manager import read_manager
from robocomp_dsl.source import Source


def node(name: str, *inner: str, endpoint: str = "") -> str:
    where = f' endpoint="{endpoint}"' if endpoint else ""
    return f'<node alias="{name}"{where}>{"".join(inner)}</node>\n'


def needs(name: str) -> str:
    return f'<dependence alias="{name}"/>'


def up(command: str) -> str:
    return f'<upCommand command="{command}"/>'


CASES: dict[str, tuple[str, list[tuple[str, str, int, tuple[str, ...]]], list[tuple[str, int]]]] = {
    "a cycle": (
        node("a", needs("b")) + node("b", needs("a")) + node("c", needs("c"), needs("a")),
        [("b", "", 0, ()), ("a", "", 0, ("b",)), ("c", "", 0, ("a",))],
        [("RC973", 3), ("RC973", 4)],
    ),
    "names": (
        node("my-arm") + node("my arm") + node("1st") + node("my-arm") + node(""),
        [("my_arm", "", 0, ()), ("my_arm_", "", 0, ()), ("_1st", "", 0, ())],
        [("RC972", 5), ("RC972", 6)],
    ),
    "an unknown dependency": (
        node("a", needs("nobody"), needs("is"))
        + node("is", endpoint="IceStorm/TopicManager:default -p 9999"),
        [("a", "", 0, ())],
        [("RC973", 2)],
    ),
    "duplicate ports": (
        node("a", endpoint="laser:tcp -h localhost -p 10003")
        + node("b", endpoint="laser:tcp -p 10003")
        + node("c", endpoint="laser:tcp -h 10.0.0.7 -p 10003")
        + node("d", endpoint="laser:tcp -p 99999")
        + node("e", endpoint="laser:tcp -p 80"),
        [
            ("a", "", 10003, ()),
            ("b", "", 0, ()),
            ("c", "10.0.0.7", 10003, ()),
            ("d", "", 0, ()),
            ("e", "", 0, ()),
        ],
        [],
    ),
    "commands": (
        node("a", up("rcremote 10.0.0.5 tab /home/x &quot;bin/a b&quot; etc/c"))
        + node("b", up("bin/b 'unclosed // comment"))
        + node("c", up("rcremote"))
        + node("d", up("ssh x@y ls */ ; rm")),
        [("a", "10.0.0.5", 0, ()), ("b", "", 0, ()), ("c", "", 0, ()), ("d", "", 0, ())],
        [],
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_migrate_manager_checks_clean(rcgen, tmp_path: Path, name: str) -> None:
    body, expected, expected_findings = CASES[name]
    file = tmp_path / "old.xml"
    file.write_text(f"<rcmanager>\n{body}</rcmanager>\n")
    done = rcgen("migrate", file, "--format", "concise")
    assert "internal" not in done.err
    report = Report()
    deployment = check_ddsl(tmp_path / "old-migrated/old.ddsl", Workspace(), report)
    assert not report.has_errors, list(report)
    assert deployment is not None
    rows = []
    for instance in deployment.instances:
        address = "" if instance.host.is_local else instance.host.address
        rows.append((instance.name, address, instance.port, instance.after))
    assert sorted(rows) == sorted(expected)
    for code, line in expected_findings:
        assert any(f"old.xml:{line}:" in row and code in row for row in done.err.splitlines())
    assert done.code == 1
    assert "error[RC945]" in done.err  # no folder of a component was named


SUB = """[[components]]
name = "bridge"
cwd = "~/robocomp/components/bridge"
cmd = "bin/bridge etc/config"
ice_name = "Laser:tcp -h localhost -p 10006"

[[components]]
name = "joy"
cwd = "~/x"
cmd = "src/joy.py etc/config"
"""


def test_migrate_sub_toml(rcgen, tmp_path: Path) -> None:
    file = tmp_path / "sub.toml"
    file.write_text(SUB)
    assert "RC945" in rcgen("migrate", file).err
    deployment = check_ddsl(tmp_path / "sub-migrated/sub.ddsl", Workspace(), Report())
    assert deployment is not None
    assert [(instance.name, instance.port) for instance in deployment.instances] == [
        ("bridge", 10006),
        ("joy", 0),
    ]
    served = [port.interface.name for port in deployment.instances[0].component.ports]
    assert served == ["Laser"]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("x.xml", ""),
        ("x.xml", "<innermodel/>"),
        ("x.xml", "no xml at all"),
        ("x.xml", "<rcmanager"),
        ("x.xml", "\0"),
        ("x.toml", "a ="),
        ("x.toml", "components = 3"),
        ("x.toml", "[[components]]\ncmd = 'x'"),
        ("x.xml", '<!DOCTYPE a [<!ENTITY b "c">]><rcmanager>&b;</rcmanager>'),
        ("x.xml", "<rcmanager><node alias='a'><rcmanager>"),
    ],
)
def test_migrate_reports_broken_manager_file(rcgen, tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / name).write_text(text)
    done = rcgen("migrate", tmp_path / name)
    assert done.code == 1
    assert "error[RC" in done.err
    assert "internal" not in done.err


def test_read_manager_nodes_have_position() -> None:
    text = "<rcmanager>\n" + node("a", endpoint="laser:tcp -h h -p 5") + "</rcmanager>"
    nodes = read_manager(Source(Path("m.xml"), text), Report())
    assert nodes is not None
    (first,) = nodes
    assert (first.name, first.host, first.span.start_position[0]) == ("a", "h", 2)


CHAIN = """[[components]]
name = "front"
cwd = "~/x/filter"
cmd = "bin/filter etc/config_front"

[[components]]
name = "back"
cwd = "~/x/filter"
cmd = "bin/filter etc/config_back"
"""


def test_migrate_does_not_connect_same_components_in_cycle(rcgen, tmp_path: Path) -> None:
    (tmp_path / "sub.toml").write_text(CHAIN)
    etc = tmp_path / "filter" / "etc"
    etc.mkdir(parents=True)
    (tmp_path / "filter" / "filter.cdsl").write_text(
        'import "Laser.idsl";\nComponent filter\n{\n'
        "    Communications { implements Laser; requires Laser; };\n    language Python;\n};\n"
    )
    # Both call an unknown server; then one calls the other.
    for called, connections in (
        (10008, {"front": "laser", "back": "laser"}),
        (11991, {"back": "laser"}),
    ):
        for name, port in (("front", 11990), ("back", 11991)):
            to = 10008 if name == "back" else called
            (etc / f"config_{name}").write_text(
                f"Laser.Endpoints=tcp -p {port}\nLaserProxy=laser:tcp -h localhost -p {to}\n"
            )
        out = tmp_path / f"out{called}"
        rcgen("migrate", tmp_path / "sub.toml", tmp_path / "filter", "-o", out)
        deployment = check_ddsl(out / "sub.ddsl", Workspace(), Report())
        assert deployment is not None
        connected = {
            connection.source.name: connection.target.name for connection in deployment.connections
        }
        assert connected == {"front": "back", **connections}
