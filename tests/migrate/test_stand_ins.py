"""Stand-ins of migrated deployments: their names, their number, and who is connected to them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Deployment
from tests.migrate.worlds import HEAD, write_component

Rcgen = Callable[..., object]
WORKER = {"src/specificworker.py": f"{HEAD}    def compute(self):\n        pass\n"}


def client(folder: Path, port: int, ports: str = "requires Laser;") -> Path:
    config = f"LaserProxy = laser:tcp -h localhost -p {port}\n"
    return write_component(folder, WORKER | {"etc/config": config}, ports)


def server(folder: Path, port: int) -> Path:
    config = f"Laser.Endpoints = tcp -p {port}\n"
    return write_component(folder, WORKER | {"etc/config": config}, "implements Laser;")


def manager(path: Path, *nodes: tuple[str, str, int]) -> Path:
    rows = (
        f'<node alias="{alias}" endpoint="{alias}:tcp -h localhost -p {port}">'
        f'<workingDir path="/home/{folder}"/></node>\n'
        for alias, folder, port in nodes
    )
    path.write_text(f"<rcmanager>\n{''.join(rows)}</rcmanager>\n")
    return path


def checked(path: Path) -> Deployment:
    report = Report()
    deployment = check_ddsl(path, Workspace(), report)
    assert deployment is not None
    assert not report.has_errors, list(report)
    return deployment


def connections(deployment: Deployment) -> set[tuple[str, str]]:
    return {(w.source.name, w.target.name) for w in deployment.connections}


def test_stand_in_has_no_name_of_imported_component(rcgen, tmp_path: Path) -> None:
    file = manager(tmp_path / "all.xml", ("eyes", "eyes", 1100), ("front", "lms", 1300))
    folders = [client(tmp_path / "eyes", 1200), write_component(tmp_path / "lms", WORKER)]
    cdsl = folders[1] / "lms.cdsl"  # it is named like the address, and serves something else
    cdsl.write_text(cdsl.read_text().replace("Component lms", "Component laser"))
    done = rcgen("migrate", file, *folders, "-o", tmp_path / "new")
    assert done.code == 0, done.err
    deployment = checked(tmp_path / "new/all.ddsl")
    names = {instance.name: instance.component.name for instance in deployment.instances}
    assert names == {"eyes": "eyes", "front": "laser", "laser_peer": "laser_peer"}
    assert connections(deployment) == {("eyes", "laser_peer")}
    assert rcgen("check", tmp_path / "new").code == 0


def test_stale_addresses_share_a_stand_in(rcgen, tmp_path: Path) -> None:
    folders = [client(tmp_path / f"eyes{i}", 1200 + i) for i in range(3)]
    done = rcgen("migrate", *folders, "-o", tmp_path / "new")
    assert done.code == 0, done.err
    deployment = checked(tmp_path / "new/eyes0.ddsl")
    assert [i.name for i in deployment.instances] == ["eyes0", "eyes1", "eyes2", "laser"]
    assert connections(deployment) == {(f"eyes{i}", "laser") for i in range(3)}


def test_two_addresses_of_a_component_are_two_stand_ins(rcgen, tmp_path: Path) -> None:
    folder = client(tmp_path / "eyes", 1200, "requires Laser, Laser;")
    cdsl, config = folder / "eyes.cdsl", folder / "etc/config"
    cdsl.write_text('import "Laser.idsl";\n' + cdsl.read_text().partition("\n")[2].replace(
        'import "Laser.idsl";\n', ""))  # fmt: skip
    config.write_text("Laser0Proxy = laser:tcp -p 1200\nLaser1Proxy = laser:tcp -p 1201\n")
    done = rcgen("migrate", folder, "-o", tmp_path / "new")
    assert done.code == 0, done.err
    deployment = checked(tmp_path / "new/eyes.ddsl")
    assert [i.name for i in deployment.instances] == ["eyes", "laser", "laser_"]


def test_wire_prefers_node_with_alias_of_address(rcgen, tmp_path: Path) -> None:
    file = manager(
        tmp_path / "all.xml", ("eyes", "eyes", 1100), ("back", "lms", 1200), ("laser", "lms", 1300)
    )
    folders = [client(tmp_path / "eyes", 9999), server(tmp_path / "lms", 1400)]
    done = rcgen("migrate", file, *folders, "-o", tmp_path / "new")
    assert done.code == 0, done.err
    deployment = checked(tmp_path / "new/all.ddsl")
    assert len(deployment.instances) == 3
    assert connections(deployment) == {("eyes", "laser")}
