"""A simulated fleet: the work of its check, placement and plan is linear in the number of robots.

Work is counted: files that are read, and lines of Python that are executed. Time decides nothing.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli.rcdeploy.plan import as_text
from robocomp_dsl.deploy.placement.host_load import HostLoad
from robocomp_dsl.deploy.placement.place import place
from robocomp_dsl.deploy.plan import Plan, plan
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Deployment
from robocomp_dsl.source import Source
from tests.support.fleet import KINDS, write_fleet

LOAD = HostLoad(1.0, 1.0, 1.0, 4)
PACKAGE = str(Path(check_ddsl.__code__.co_filename).parents[1])


def checked(app: Path) -> Deployment:
    report = Report()
    deployment = check_ddsl(app, Workspace([app.parent / "interfaces"], environ={}), report)
    assert report.sorted() == []
    assert deployment is not None
    return deployment


def planned(deployment: Deployment) -> Plan:
    loads = {host.name: LOAD for host in deployment.hosts}
    result = place(deployment, loads, {})
    assert result.findings == ()
    return plan(result.deployment, name="fleet", domain="fleet", interpreter="python3")


def lines_executed(work: Callable[[], object]) -> int:
    """The number of lines of this project that `work` executes, without those of the parser."""
    count = 0

    def count_line(_frame: FrameType, event: str, _argument: Any) -> Any:
        nonlocal count
        count += event == "line"
        return count_line

    def enter(frame: FrameType, _event: str, _argument: Any) -> Any:
        path = frame.f_code.co_filename
        return count_line if path.startswith(PACKAGE) and "/syntax/" not in path else None

    earlier = sys.gettrace()
    sys.settrace(enter)
    try:
        work()
    finally:
        sys.settrace(earlier)
    return count


@pytest.mark.parametrize("placed_by", ["on {}", "on label robot", "by load"])
def test_fleet_work_is_linear_in_number_of_robots(tmp_path: Path, placed_by: str) -> None:
    work = {}
    for hosts in (3, 6):
        folder = tmp_path / str(hosts)
        folder.mkdir()
        app = write_fleet(folder, hosts, placed_by=placed_by)

        def check_and_plan(app: Path = app) -> None:
            list(as_text(planned(checked(app))))

        check_and_plan()  # what is loaded once does not count
        work[hosts] = lines_executed(check_and_plan)
    assert work[6] < 2.3 * work[3]


def test_fleet_reads_each_file_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    app = write_fleet(tmp_path, 6)
    read: list[str] = []
    original = Source.read
    monkeypatch.setattr(Source, "read", lambda path: (read.append(path.name), original(path))[1])
    deployment = checked(app)
    assert len(deployment.instances) == 300
    assert sorted(read) == sorted([app.name, "Fleet.idsl", *(f"{kind}.cdsl" for kind in KINDS)])


def test_fleet_plan_has_processes_and_connections_of_all_robots(tmp_path: Path) -> None:
    processes = {p.name: p for p in planned(checked(write_fleet(tmp_path, 4))).processes}
    assert len(processes) == 200
    flags = processes["traffic"].argv
    assert [f"mission{i}=r{i}-mission" for i in range(4)] == [
        word for word in flags if word.startswith("mission")
    ]
    assert "Image=r2-camera3" in processes["r2-detector3"].argv
    assert processes["r3-planner"].host == "h3 (10.0.3.2)"
    assert "traffic" in processes["r1-mission"].stops_after
