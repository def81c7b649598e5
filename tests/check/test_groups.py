"""Groups and hosts of a deployment: full names of instances, start order, connections."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.check.languages import check_file
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Deployment, Host

CASES = Path(__file__).parent.parent / "cases"
PARTS = CASES / "ddsl" / "sem_parts"


def read(path: Path) -> Deployment:
    report = Report()
    found = check_file(path, Workspace(environ={}, shipped=CASES / "interfaces"), report)
    assert [d.message for d in report] == []
    assert isinstance(found, Deployment)
    return found


def written(folder: Path, text: str) -> Deployment:
    path = folder / "main.ddsl"
    imports = "".join(f'import "{PARTS}/{n}.cdsl";\n' for n in ("body", "reflex", "filter"))
    path.write_text(f"{imports}Deployment demo {{ {text} }};")
    return read(path)


def test_groups_set_names_order_and_hosts() -> None:
    found = read(CASES / "ddsl" / "sem_groups" / "main.ddsl")
    order = [instance.name for instance in found.instances]
    assert order == [
        "talker",
        *("left-body", "left-reflex", "left-inner-second"),
        *("right-body", "right-deep-body", "right-deep-filter"),
        "reflex",
    ]
    by_name = {instance.name: instance for instance in found.instances}
    assert by_name["left-inner-second"].group == "left-inner"
    assert by_name["left-inner-second"].after == ("left-reflex", "talker")
    assert set(by_name["reflex"].after) == set(order[1:-1])
    assert by_name["left-body"].host.address == "10.0.0.2"
    assert by_name["right-body"].host.is_local
    assert by_name["right-deep-body"].host.name == ""
    assert by_name["left-body"].host_span is not None
    assert by_name["left-body"].component.name == "body"


def test_implicit_connections_prefer_own_group() -> None:
    found = read(CASES / "ddsl" / "sem_groups" / "main.ddsl")
    wires = {
        f"{w.source.name}.{w.source_port.name} -> {w.target.name}.{w.target_port.name}"
        for w in found.connections
    }
    assert wires == {
        "left-reflex.Laser -> left-body.Laser",
        "left-inner-second.Laser -> left-body.Laser",
        "right-deep-filter.Laser -> right-deep-body.Laser",
        "reflex.Laser -> left-body.Laser",
        "left-body.LaserPub -> left-reflex.LaserPub",
        "left-body.LaserPub -> left-inner-second.LaserPub",
        "left-body.LaserPub -> reflex.LaserPub",
    }


def test_deployment_model_has_groups() -> None:
    found = read(CASES / "ddsl" / "sem_groups" / "main.ddsl")
    groups = {group.name: group for group in found.groups}
    assert list(groups) == ["left", "left-inner", "right", "right-deep"]
    assert groups["left"].instances == ("left-body", "left-reflex", "left-inner-second")
    assert groups["left"].doc == "Two that belong together."
    exports = {(g.name, e.name): e for g in found.groups for e in g.exports}
    assert exports["left", "Range"].port.name == "Laser"
    assert exports["right", "Laser"].instance.name == "right-deep-filter"


@pytest.mark.parametrize(
    ("text", "order"),
    [
        ("group a { after b; component body; }; component b : filter { };", "b a-body"),
        ("group a { component body { after b; }; }; component b : filter;", "b a-body"),
        ("group a { group c { component body { after b; }; }; }; component b : filter;", None),
        ("component b : filter { after a; }; group a { component body; export Laser from body; };",
         "a-body b"),
        ("group a { component body { after x; }; component x : body; };", "a-x a-body"),
        ("group a { after b; component body; }; group b { component body; };", "b-body a-body"),
    ],
)  # fmt: skip
def test_start_order_with_groups(tmp_path: Path, text: str, order: str | None) -> None:
    found = _order(tmp_path, text)
    assert found == (order or "b a-c-body").split()


def _order(folder: Path, text: str) -> list[str]:
    path = folder / "main.ddsl"
    imports = "".join(f'import "{PARTS}/{n}.cdsl";\n' for n in ("body", "reflex", "filter"))
    path.write_text(f"{imports}Deployment demo {{ {text} }};")
    report = Report()
    found = check_file(path, Workspace(environ={}, shipped=CASES / "interfaces"), report)
    # an unserved requirement is another matter
    assert {d.code.id for d in report} <= {"RC507"}
    assert isinstance(found, Deployment)
    return [instance.name for instance in found.instances]


def test_exports_resolve_through_nested_groups(tmp_path: Path) -> None:
    found = written(
        tmp_path,
        "group a { group b { component body; export Laser from body as Inner; };"
        " export Inner from b as Outer; }; component filter; connect filter.Laser -> a.Outer;",
    )
    (wire,) = (w for w in found.connections if w.source.name == "filter")
    assert (wire.target.name, wire.target_port.name, wire.implied) == ("a-b-body", "Laser", False)


@pytest.mark.parametrize(
    ("address", "here"),
    [
        ("localhost", True),
        ("127.0.0.1", True),
        ("127.1.2.3", True),
        ("::1", True),
        ("10.0.0.2", False),
        ("robot.local", False),
        ("", False),
    ],
)
def test_host_is_local(address: str, here: bool) -> None:
    assert Host("robot", address).is_local is here


NAMES = st.sampled_from(["a", "b", "c", "body", "reflex", "self"])
HOSTS = st.sampled_from(["", " on localhost", " on robot", " on nowhere"])


@st.composite
def _blocks(draw: st.DrawFn, depth: int = 0) -> str:
    """Random content of a deployment or a group."""
    deployment = []
    for _ in range(draw(st.integers(0, 4))):
        name, other, host = draw(NAMES), draw(NAMES), draw(HOSTS)
        kind = draw(st.integers(0, 4 if depth else 2))
        if kind == 0:
            deployment.append(f"component {name} : {draw(NAMES)}{host} {{ after {other}; }};")
        elif kind == 1:
            deployment.append(f"connect {name}.Laser -> {other}.Laser;")
        elif kind == 2 and depth < 3:
            deployment.append(f"group {name}{host} {{ {draw(_blocks(depth + 1))} }};")
        elif kind == 3:
            deployment.append(f"export Laser from {name} as {other};")
        elif kind == 4:
            deployment.append(f"after {name}, {other};")
    return " ".join(deployment)


@settings(max_examples=200)
@given(_blocks())
def test_check_ddsl_accepts_any_groups(text: str) -> None:
    imports = "".join(f'import "{PARTS}/{n}.cdsl";\n' for n in ("body", "reflex"))
    path = Path("main.ddsl")
    workspace = Workspace(environ={}, shipped=CASES / "interfaces")
    whole = f'{imports}Deployment d {{ host robot {{ address "10.0.0.2"; }}; {text} }};'
    workspace.sources.set_overlay(path, whole)
    report = Report()
    found = check_file(path, workspace, report)
    assert isinstance(found, Deployment)
    names = [instance.name for instance in found.instances]
    assert len(set(names)) == len(names)
    if not report.has_errors:
        place = {name: i for i, name in enumerate(names)}
        for instance in found.instances:
            assert all(place[name] < place[instance.name] for name in instance.after)


MONITOR = """
from robocomp_dsl.runtime import Monitor


class Limit(Monitor):
    def update(self, operation, arguments):
        return arguments
"""


def test_definitions_are_relative_to_their_file_and_have_exports_at_both_ends(
    tmp_path: Path,
) -> None:
    part = tmp_path / "parts"
    part.mkdir()
    (part / "body.yaml").write_text("rate: 20\n")
    (part / "limits.py").write_text(MONITOR)
    (part / "arm.ddsl").write_text(f"""
        import "{PARTS}/body.cdsl";
        import "{PARTS}/reflex.cdsl";
        group arm
        {{
            component body {{ config "body.yaml"; prefix inner; }};
            component reflex;
            connect body.LaserPub -> reflex.LaserPub {{ monitor "limits.py" Limit; }};
            connect reflex.Laser -> body.Laser;
            export LaserPub from body as Out;
        }};
        group eye
        {{
            component reflex;
            export LaserPub from reflex as In;
            export Laser from reflex;
        }};
        group pair {{ group both : eye; export In from both; export Laser from both as Needs; }};
    """)
    (tmp_path / "app.ddsl").write_text(f"""
        import "parts/arm.ddsl";
        import "{PARTS}/body.cdsl";
        Deployment app
        {{
            host robot {{ address "10.0.0.2"; }};
            component body;
            group left : arm on robot {{ prefix left; set body.rate = 30; }};
            group right : arm {{ after left; }};
            group eyes : pair {{ prefix "far/away"; }};
            connect left.Out -> eyes.In {{ reliable; depth 3; }};
            connect right.Out -> eyes.In;
            connect eyes.Needs -> body.Laser;
        }};
    """)
    found = read(tmp_path / "app.ddsl")
    by_name = {instance.name: instance for instance in found.instances}
    left, right, eyes = by_name["left-body"], by_name["right-body"], by_name["eyes-both-reflex"]
    assert [left.full_name, right.full_name] == ["left/inner/left-body", "inner/right-body"]
    assert eyes.full_name == "far/away/eyes-both-reflex"
    assert left.config == right.config == part / "body.yaml"
    assert [left.settings, right.settings] == [(("rate", 30.0),), ()]
    assert [left.host.name, right.host.name] == ["robot", ""]
    assert set(right.after) == {"left-body", "left-reflex"}
    files = {monitor.file for wire in found.connections for monitor in wire.monitors}
    assert files == {part / "limits.py"}
    outside = [wire for wire in found.connections if wire.target is eyes]
    assert [(wire.source.name, wire.qos.depth) for wire in outside] == [
        ("left-body", 3),
        ("right-body", None),
    ]
    assert [(g.name, g.definition) for g in found.groups] == [
        ("left", "arm"),
        ("right", "arm"),
        ("eyes", "pair"),
        ("eyes-both", "eye"),
    ]
    assert [export.name for export in found.groups[2].exports] == ["In", "Needs"]


def test_members_of_one_process_are_connected_by_plain_calls(tmp_path: Path) -> None:
    found = written(
        tmp_path,
        """component reflex; group g { inprocess; component body; group inner { component reflex; };
        export Laser from body; export LaserPub from body; };
        connect reflex.Laser -> g.Laser; connect g.LaserPub -> reflex.LaserPub;""",
    )
    assert {i.name: i.process for i in found.instances} == {
        "reflex": "",
        "g-body": "g",
        "g-inner-reflex": "g",
    }
    used = {(w.source.name, w.target.name): w.middleware for w in found.connections}
    assert used == {
        ("reflex", "g-body"): "",
        ("g-body", "reflex"): "",
        ("g-inner-reflex", "g-body"): "inproc",
        ("g-body", "g-inner-reflex"): "inproc",
    }
