"""End-to-end tests of `rcgen migrate` with a file of rcmanager: deployments."""

from __future__ import annotations

import shutil
import uuid
from collections.abc import Callable
from pathlib import Path

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from tests.migrate.processes import running

Rcgen = Callable[..., object]


def test_migrated_deployment_components_communicate(rcgen, old: Path, tmp_path: Path) -> None:
    folders = [old / name for name in ("follow", "laser_sim", "base_sim")]
    out = tmp_path / "robot"
    done = rcgen("migrate", old / "robot.xml", *folders, "-o", out)
    assert done.code == 0, done.err
    report = Report()
    deployment = check_ddsl(out / "robot.ddsl", Workspace(), report)
    assert not report.has_errors
    assert deployment is not None
    domain = f"migrated-{uuid.uuid4().hex[:12]}"
    connections = ("--connect", "Laser=laser", "--connect", "DifferentialRobot=base")
    slow = ("--config", "etc/config_slow.yaml")
    with (
        running(out / "laser_sim", "--domain", domain, "--name", "laser"),
        running(out / "base_sim", "--domain", domain, "--name", "base") as base,
        running(out / "follow", "--domain", domain, *slow, *connections),
    ):
        # 300 mm ahead, nearer than 900: the advance of config_slow, and a turn.
        base.wait_for("SPEED 50.0 0.6")


def test_migrate_manager_writes_deployment(rcgen, old: Path, tmp_path: Path) -> None:
    folders = [old / name for name in ("follow", "laser_sim", "base_sim")]
    out = tmp_path / "robot"
    assert rcgen("migrate", old / "robot.xml", *folders, "-o", out).code == 0
    deployment = check_ddsl(out / "robot.ddsl", Workspace(), Report())
    assert deployment is not None
    rows = [
        (
            instance.name,
            instance.component.name,
            instance.host.address,
            instance.port,
            instance.after,
        )
        for instance in deployment.instances
    ]
    assert rows == [
        ("laser", "laser_sim", "127.0.0.1", 10003, ()),
        ("base", "base_sim", "127.0.0.1", 10004, ("laser",)),
        ("follow_me", "follow", "127.0.0.1", 11010, ("laser", "base")),
        ("rgbd", "rgbd", "10.0.30.33", 10096, ()),
    ]
    assert deployment.instances[2].config == out / "follow/etc/config_slow.yaml"
    assert deployment.instances[3].host.user == "robolab"
    connections = {
        (w.source.name, w.source_port.name, w.target.name, w.implied)
        for w in deployment.connections
    }
    assert connections == {
        ("follow_me", "Laser", "laser", False),
        ("follow_me", "DifferentialRobot", "base", False),
    }


def test_migrate_manager_without_folders_writes_placeholder_components(
    rcgen, old: Path, tmp_path: Path
) -> None:
    out = tmp_path / "robot"
    done = rcgen("migrate", old / "robot.xml", "-o", out)
    assert done.code == 1
    assert "error[RC945]: all components of the deployment are stand-ins" in done.err
    assert rcgen("check", out).code == 0
    assert "implements Laser;" in (out / "peers/laser/laser.cdsl").read_text()
    assert "implements RGBD;" in (out / "peers/rgbd/rgbd.cdsl").read_text()
    assert rcgen("component", out / "peers/laser/laser.cdsl").code == 0
    assert (out / "peers/laser/main.py").is_file()


def test_migrate_finds_configurations_next_to_manager_file(
    rcgen, old: Path, tmp_path: Path
) -> None:
    etc = tmp_path / "robot/etc"
    etc.mkdir(parents=True)
    shutil.copy(old / "robot.xml", etc)
    text = (etc / "robot.xml").read_text().replace("etc/config_slow", "robot/etc/follow.conf")
    (etc / "robot.xml").write_text(text)
    fast = (old / "follow/etc/config_slow").read_text().replace("Advance = 50", "Advance = 70")
    (etc / "follow.conf").write_text(fast)
    out = tmp_path / "new"
    folders = [old / name for name in ("follow", "laser_sim", "base_sim")]
    assert rcgen("migrate", etc / "robot.xml", *folders, "-o", out).code == 0
    deployment = check_ddsl(out / "robot.ddsl", Workspace(), Report())
    assert deployment is not None
    assert deployment.instances[2].config == out / "follow/etc/follow.yaml"
    assert "Advance: 70" in (out / "follow/etc/follow.yaml").read_text()
