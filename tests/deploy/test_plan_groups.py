"""Plans of deployments with groups: instances of definitions, and groups in one process."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli.rcdeploy.plan import as_text
from robocomp_dsl.deploy.plan import Plan, Process, plan
from robocomp_dsl.deploy.selection import NoSuchComponent, select_group, select_names
from robocomp_dsl.diagnostics import Report

PARTS = Path(__file__).parent.parent / "cases" / "ddsl" / "sem_parts"
HEAD = "".join(f'import "{PARTS}/{name}.cdsl";\n' for name in ("body", "reflex"))
ARM = """
group arm
{
    component body { set rate = 20; env MODE = slow; };
    component reflex { after body; env MODE = slow; };
    export LaserPub from body;
    export Laser from body;
};
"""


def planned(tmp_path: Path, text: str, group: str = "") -> Plan:
    """The plan of a deployment of `arm`."""
    file = tmp_path / "app.ddsl"
    file.write_text(f"{HEAD}{ARM}Deployment app {{ {text} }};")
    report = Report()
    deployment = check_ddsl(file, Workspace(), report)
    assert deployment
    assert [diagnostic.message for diagnostic in report] == []
    if group:
        deployment = select_group(deployment, group)
    return plan(deployment, name="app", domain="d", interpreter="py")


def option(process: Process, name: str) -> list[str]:
    """The values of an option in a command line."""
    words = process.argv
    return [words[i + 1] for i, word in enumerate(words) if word == name]


def test_plan_of_instances_has_a_process_for_each_component(tmp_path: Path) -> None:
    text = "group left : arm { prefix left; set body.rate = 30; }; group right : arm;"
    found = planned(tmp_path, text)
    assert [p.name for p in found.processes] == [
        "left/left-body",
        "left/left-reflex",
        "right-body",
        "right-reflex",
    ]
    assert [option(p, "--set") for p in found.processes] == [
        ["rate=30.0"],
        [],
        ["rate=20.0"],
        [],
    ]
    assert option(found.processes[1], "--prefix") == ["left"]
    assert option(found.processes[3], "--connect") == ["Laser=right-body", "LaserPub=right-body"]
    assert select_names(["left"], found.processes) == ["left/left-body", "left/left-reflex"]
    assert found.components == found.processes


def test_plan_of_group_in_one_process_has_arguments_of_each_component(tmp_path: Path) -> None:
    text = """
        component body;
        group left : arm { prefix left; inprocess; after body; memory 200 MB; restart never; };
        component reflex { after left; };
        connect left.LaserPub -> reflex.LaserPub;
        connect reflex.Laser -> left.Laser;
    """
    found = planned(tmp_path, text)
    assert [p.name for p in found.processes] == ["body", "left/left", "reflex"]
    group, user = found.processes[1], found.processes[2]
    assert [m.name for m in group.members] == ["left/left-body", "left/left-reflex"]
    assert [p.name for p in found.components] == [
        "body",
        "left/left-body",
        "left/left-reflex",
        "reflex",
    ]
    assert group.argv[:7] == (
        *("py", "-m", "robocomp_dsl.runtime.group_process"),
        *("--name", "left/left", "--log-format", "json"),
    )
    assert option(group, "--component") == [str(PARTS.resolve())] * 2
    assert option(group, "--name") == ["left/left", "left-body", "left-reflex"]
    assert option(group, "--after") == ["left/left-body"]
    assert group.env == (("MODE", "slow"),)
    assert (group.restart.policy, group.limits.memory_bytes) == ("never", 200_000_000)
    assert (group.after, user.after) == (("body",), ("left/left",))
    assert group.stops_after == ("reflex",)
    assert found.shutdown_batches() == [["reflex"], ["left/left"], ["body"]]
    assert found.names == ("body", "left/left", "left/left-body", "left/left-reflex", "reflex")


def test_plan_of_group_in_one_process_makes_its_connections_plain_calls(tmp_path: Path) -> None:
    text = """
        group left : arm { inprocess; };
        component reflex;
        connect left.LaserPub -> reflex.LaserPub;
        connect reflex.Laser -> left.Laser;
    """
    found = planned(tmp_path, text)
    body, inside, outside = found.components
    served = ["LaserPub=inproc,zenoh", "Laser=inproc,zenoh"]
    assert sorted(option(body, "--middleware")) == sorted(served)
    assert option(inside, "--middleware") == ["Laser=inproc", "LaserPub=inproc"]
    assert option(outside, "--middleware") == []
    assert option(inside, "--connect") == ["Laser=left-body", "LaserPub=left-body"]


def test_plan_of_group_in_one_process_respects_named_middleware(tmp_path: Path) -> None:
    text = """group own { inprocess; component body; component reflex;
        connect reflex.Laser -> body.Laser over local;
        connect body.LaserPub -> reflex.LaserPub { priority high; }; };"""
    body, reflex = planned(tmp_path, text.replace("local", "zenoh")).components
    assert option(body, "--middleware") == []
    assert option(reflex, "--middleware") == []


def test_plan_of_nested_group_in_one_process_joins_outermost(tmp_path: Path) -> None:
    text = "group robot { group body { inprocess; group left : arm { inprocess; }; }; };"
    found = planned(tmp_path, text)
    (process,) = found.processes
    assert (process.name, process.group) == ("robot-body", "robot")
    assert [m.name for m in process.members] == ["robot-body-left-body", "robot-body-left-reflex"]
    assert select_names(["robot"], found.processes) == ["robot-body"]
    inside = "`robot-body-left-body` runs in the process of the group `robot-body`; name the group"
    with pytest.raises(NoSuchComponent, match=inside):
        select_names(["robot-body-left-body"], found.processes)


def test_select_group_of_one_process_keeps_it(tmp_path: Path) -> None:
    text = "group left : arm { inprocess; }; group right : arm;"
    found = planned(tmp_path, text, "left")
    assert [p.name for p in found.processes] == ["left"]
    assert len(found.processes[0].members) == 2


def test_plan_shows_exports_of_groups(tmp_path: Path) -> None:
    text = "group all { group left : arm { inprocess; prefix far; }; export Laser from left; };"
    found = planned(tmp_path, text)
    lines = [line for group in found.groups for line in group.format()]
    assert lines == [
        "group all",
        "   Laser is far/all-left-body.Laser",
        "group far/all-left : arm, one process",
        "   LaserPub is far/all-left-body.LaserPub",
        "   Laser is far/all-left-body.Laser",
    ]
    assert found.groups[1].as_dict()["exports"]["Laser"] == "far/all-left-body.Laser"
    assert "group far/all-left : arm, one process" in list(as_text(found))
