"""Preflight: TCP ports that two programs want."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.deploy.port_addresses import check_port_addresses
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.runtime.middleware.ice.addresses import parse_fixed, tcp_ports

CDSL = """\
import "Laser.idsl";
Component body { Communications { implements Laser; }; language Python; };
"""


def messages(folder: Path, statements: str, in_use: dict[int, str]) -> list[str]:
    (folder / "body.cdsl").write_text(CDSL)
    path = folder / "app.ddsl"
    path.write_text(f'import "body.cdsl";\nDeployment app {{ {statements} }};\n')
    report = Report()
    deployment = check_ddsl(path, Workspace(environ={}), report)
    assert deployment is not None
    assert not report.has_errors, [d.message for d in report.sorted()]
    found = check_port_addresses(deployment, KnownMiddlewares(), lambda n: in_use.get(n, ""))
    return [finding.message for finding in found]


def test_check_port_addresses_reports_two_components_at_one_port(tmp_path: Path) -> None:
    statements = """\
component body { port Laser over ice at "tcp -p 10001"; };
component second : body { port Laser over ice at "laser:tcp -h 127.0.0.1 -p 10001"; };
"""
    assert messages(tmp_path, statements, {}) == ["`second.Laser`: `body` has TCP port 10001, too"]


def test_check_port_addresses_reports_port_in_use(tmp_path: Path) -> None:
    statements = 'component body { port Laser over ice at "tcp -p 10002"; };'
    assert messages(tmp_path, statements, {10002: "in use"}) == [
        "`body.Laser`: TCP port 10002 cannot be used: in use"
    ]
    assert messages(tmp_path, statements, {}) == []


@pytest.mark.parametrize(
    ("address", "ports"),
    [
        ("tcp -p 10001", [10001]),
        ("laser:tcp -h 127.0.0.1 -p 10001:ssl -p 10002 -t 500", [10001, 10002]),
        ("tcp", []),
        ("tcp -p 0", []),
        ("udp -p 10002", []),
        ("nonsense -p 10002", []),
    ],
)
def test_tcp_ports_of_an_address_of_ice(address: str, ports: list[int]) -> None:
    assert tcp_ports(address) == ports


def test_parse_fixed_names_the_object_as_robocomp_does() -> None:
    assert parse_fixed(" tcp -p 1 ", "JointMotor") == ("jointmotor", "tcp -p 1")
    assert parse_fixed("motor:tcp -p 1", "JointMotor") == ("motor", "tcp -p 1")
    with pytest.raises(ValueError, match="`10001` is no address of Ice; write such as"):
        parse_fixed("10001", "JointMotor")
