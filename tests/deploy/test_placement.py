"""Placement by label and by load, pure: choices, their numbers, and what cannot be placed."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

import pytest

from robocomp_dsl.deploy.hosts.core_checks import check_cores
from robocomp_dsl.deploy.placement.host_load import HostLoad, local_load
from robocomp_dsl.deploy.placement.place import place, placeable_locally
from robocomp_dsl.deploy.placement.placement_choice import PlacementResult
from robocomp_dsl.deploy.placement.placement_text import placement_lines
from robocomp_dsl.model.deployment import UNPLACED, Deployment
from tests.check.case_models import CASES, deployment_case

PARTS = CASES / "ddsl" / "sem_parts"
HEAD = "".join(
    f'import "{PARTS / name}.cdsl";\n' for name in ("body", "reflex", "talker", "world", "filter")
)
HOSTS = """
    host robot { address "10.0.0.2"; labels arm, gpu; };
    host desk { address "10.0.0.3"; labels gpu; };
    host rack { address "10.0.0.4"; };
"""
IDLE = HostLoad(0.0, 0.0, 0.0, 4)


def deployed(tmp_path: Path, body: str, hosts: str = HOSTS) -> Deployment:
    text = f"{HEAD}\nDeployment demo\n{{\n{hosts}\n{body}\n}};\n"
    return deployment_case("", tmp_path, text)


def placed(
    tmp_path: Path,
    body: str,
    loads: Mapping[str, HostLoad] | None = None,
    running: Mapping[str, str] | None = None,
    hosts: str = HOSTS,
) -> PlacementResult:
    return place(deployed(tmp_path, body, hosts), loads or {}, running or {})


def hosts_of(result: PlacementResult) -> dict[str, str]:
    return {instance.name: instance.host.name for instance in result.deployment.instances}


@pytest.mark.parametrize(
    ("load", "score"),
    [
        (HostLoad(1.0, 1.0, 1.0, 1), 1.0),
        (HostLoad(26.0, 0.0, 0.0, 4), 15 / 4),
        (HostLoad(0.0, 26.0, 0.0, 4), 10 / 4),
        (HostLoad(0.0, 0.0, 26.0, 4), 1 / 4),
        (HostLoad(2.6, 0.0, 0.0, 0), 1.5),
    ],
)
def test_host_load_score_is_that_of_yarpmanager(load: HostLoad, score: float) -> None:
    assert load.score == pytest.approx(score)
    assert load.score_of_component == 1 / max(1, load.cpus)


def test_local_load_is_that_of_this_machine() -> None:
    load = local_load()
    assert load.cpus == os.cpu_count()
    assert min(load.load1, load.load5, load.load15) >= 0


def test_place_by_label_chooses_host_with_fewest_components(tmp_path: Path) -> None:
    body = """
        component a : talker on label gpu;
        component b : talker on label gpu;
        component c : talker on label gpu;
        component fixed : talker on robot;
        component only : talker on label arm;
    """
    result = placed(tmp_path, body)
    expected = {"a": "desk", "b": "desk", "c": "robot", "fixed": "robot", "only": "robot"}
    assert hosts_of(result) == expected
    assert [choice.reason for choice in result.choices] == ["fewest components"] * 3
    assert result.findings == ()
    assert hosts_of(placed(tmp_path, body)) == expected


def test_place_by_load_chooses_lowest_score_and_adds_components(tmp_path: Path) -> None:
    names = [f"c{i}" for i in range(5)]
    body = "".join(f"component {n} : talker {{ place by load on robot, desk; }};" for n in names)
    loads = {"robot": HostLoad(1.0, 1.0, 1.0, 2), "desk": HostLoad(1.0, 1.0, 1.0, 4)}
    result = placed(tmp_path, body, loads)
    chosen = ["desk", "robot", "desk", "desk", "robot"]
    assert hosts_of(result) == dict(zip(names, chosen, strict=True))
    scores = [{score.host: score.score for score in choice.candidates} for choice in result.choices]
    assert scores == [
        {"robot": 0.5, "desk": 0.25},
        {"robot": 0.5, "desk": 0.5},
        {"robot": 1.0, "desk": 0.5},
        {"robot": 1.0, "desk": 0.75},
        {"robot": 1.0, "desk": 1.0},
    ]


def test_place_by_load_counts_components_that_are_yet_to_start(tmp_path: Path) -> None:
    body = """
        component fixed : talker on robot;
        component c : talker { place by load on robot, desk; };
    """
    loads = {"robot": IDLE, "desk": HostLoad(0.1, 0.1, 0.1, 4)}
    assert hosts_of(placed(tmp_path, body, loads))["c"] == "desk"
    assert hosts_of(placed(tmp_path, body, loads, {"fixed": "robot"}))["c"] == "robot"


def test_place_by_load_ignores_hosts_without_load(tmp_path: Path) -> None:
    body = "component c : talker { place by load; };"
    result = placed(tmp_path, body, {"rack": HostLoad(9, 9, 9, 1)})
    assert hosts_of(result) == {"c": "rack"}
    unknown = placed(tmp_path, body)
    (finding,) = unknown.findings
    assert finding.code.id == "RC576"
    assert "the load of `robot`, `desk`, `rack` is not known" in finding.message
    assert unknown.deployment.instances[0].host is UNPLACED


def test_place_never_moves_running_component(tmp_path: Path) -> None:
    body = """
        component a : talker on label gpu;
        component b : talker { place by load on robot, desk; };
        group g { place by load; component x : talker; component y : talker; };
    """
    loads = {"robot": IDLE, "desk": HostLoad(50, 50, 50, 1), "rack": HostLoad(90, 90, 90, 1)}
    running = {"a": "desk", "b": "desk", "g-x": "rack"}
    result = placed(tmp_path, body, loads, running)
    assert hosts_of(result) == {"a": "desk", "b": "desk", "g-x": "rack", "g-y": "rack"}
    assert {choice.reason for choice in result.choices} == {"runs there"}


def test_place_moves_running_component_whose_host_is_no_candidate(tmp_path: Path) -> None:
    result = placed(tmp_path, "component a : talker on label gpu;", running={"a": "rack"})
    assert hosts_of(result) == {"a": "robot"}


def test_place_keeps_group_on_one_host(tmp_path: Path) -> None:
    body = """
        group left on label gpu { component a : talker; group deep { component b : talker; }; };
        group right { place by load on robot, desk; component a : talker; component b : talker; };
    """
    loads = {"robot": HostLoad(8, 8, 8, 4), "desk": HostLoad(0, 0, 0, 4)}
    result = placed(tmp_path, body, loads)
    assert hosts_of(result) == {
        "left-a": "robot",
        "left-deep-b": "robot",
        "right-a": "desk",
        "right-b": "desk",
    }
    assert [choice.instances for choice in result.choices] == [
        ("left-a", "left-deep-b"),
        ("right-a", "right-b"),
    ]


def test_place_keeps_local_connections_on_one_host(tmp_path: Path) -> None:
    body = """
        component body on desk;
        component near : reflex { place by load; };
        component free : reflex { place by load; };
        connect near.Laser -> body.Laser over local;
        connect free.Laser -> body.Laser over zenoh;
        connect body.LaserPub -> near.LaserPub;
        connect body.LaserPub -> free.LaserPub;
    """
    loads = {"robot": IDLE, "desk": HostLoad(9, 9, 9, 4), "rack": HostLoad(1, 1, 1, 4)}
    result = placed(tmp_path, body, loads)
    assert hosts_of(result) == {"body": "desk", "near": "desk", "free": "robot"}
    connections = {(c.source.name, c.target.name): c for c in result.deployment.connections}
    assert connections["near", "body"].source is result.deployment.instances[1]
    assert connections["near", "body"].target is result.deployment.instances[0]


def test_place_reports_components_without_common_host(tmp_path: Path) -> None:
    body = """
        component a : filter on label gpu;
        component b : filter { place by load on robot, rack; };
        component c : filter { place by load on desk, rack; };
        connect a.Laser -> b.Laser over local;
        connect b.Laser -> c.Laser over local;
        connect c.Laser -> b.Laser over local;
    """
    result = placed(tmp_path, body, {"robot": IDLE, "desk": IDLE, "rack": IDLE})
    (finding,) = result.findings
    assert finding.code.id == "RC576"
    assert "`a` is placed on label gpu (robot, desk)" in finding.message
    assert "`b` is placed by load on robot, rack" in finding.message
    assert "`c` is placed by load on desk, rack" in finding.message
    assert "`robot` (labels arm, gpu), `desk` (label gpu), `rack` (no labels)" in finding.help
    assert {note.span.text for note in finding.notes} <= {
        "place by load on robot, rack;",
        "place by load on desk, rack;",
    }


def test_place_counts_hosts_on_this_machine_as_one(tmp_path: Path) -> None:
    hosts = """
        host mine { address "localhost"; labels arm; };
        host also { address "127.0.0.1"; labels arm; };
        host robot { address "10.0.0.2"; labels arm; };
    """
    body = """
        component here : talker;
        component a : talker on label arm;
        component b : talker on label arm;
    """
    result = placed(tmp_path, body, hosts=hosts)
    assert hosts_of(result) == {"here": "", "a": "robot", "b": "mine"}
    only = "component c : talker { place by load on mine, also; };"
    alone = hosts.replace("host robot", "// host robot")
    assert placeable_locally(deployed(tmp_path, only, alone))
    assert hosts_of(placed(tmp_path, only, hosts=alone)) == {"c": "mine"}
    assert not placeable_locally(deployed(tmp_path, body, hosts))


def test_place_replaces_hosts_everywhere(tmp_path: Path) -> None:
    body = """
        clock sim from w;
        component w : world { place by load on robot, desk; };
        group g on label gpu { component body; export Laser from body; };
        component reflex { place by load on robot, desk; };
        connect reflex.Laser -> g.Laser;
    """
    model = placed(tmp_path, body, {"robot": IDLE, "desk": IDLE}).deployment
    instances = {id(instance) for instance in model.instances}
    assert {id(end) for c in model.connections for end in (c.source, c.target)} <= instances
    assert id(model.clock.source) in instances
    assert {id(export.instance) for group in model.groups for export in group.exports} <= instances
    assert all(instance.host is not UNPLACED for instance in model.instances)


def test_placement_lines_show_numbers(tmp_path: Path) -> None:
    body = """
        component a : talker on label gpu;
        component b : talker { place by load; };
    """
    loads = {"robot": HostLoad(1.3, 2.6, 0.0, 2), "desk": HostLoad(0.26, 0.0, 0.0, 8)}
    assert list(placement_lines(placed(tmp_path, body, loads).choices)) == [
        "a on robot: fewest components",
        "   host   components",
        "   robot           0  chosen",
        "   desk            0",
        "b on desk: lowest score",
        "   host   components  load 1 min  5 min  15 min  cpus  score",
        "   robot           1        1.30   2.60    0.00     2  1.375",
        "   desk            0        0.26   0.00    0.00     8  0.019  chosen",
        "   rack            0           ?      ?       ?     ?      ?",
    ]


def test_check_cores_names_cores_that_the_host_does_not_have(tmp_path: Path) -> None:
    body = """
        component a : talker on robot { cores 0, 3-5; };
        component b : talker on robot { cores 0-3; };
        component c : talker on desk { cores 9; };
        component d : talker { cores 1; };
    """
    model = deployed(tmp_path, body, HOSTS)
    findings = list(check_cores(model, {"robot": 4, "localhost": 1}))
    assert [(finding.code.id, finding.message) for finding in findings] == [
        ("RC575", "`a`: the host `robot` has no CPU core 4-5; it has 0-3"),
        ("RC575", "`d`: the host `localhost` has no CPU core 1; it has 0"),
    ]
