"""Models of components, parameters and worlds."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.passes import check_cdsl, check_innermodel, check_pdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.component import Role
from robocomp_dsl.model.interface import Pattern
from robocomp_dsl.model.parameter import Kind
from tests.check.case_models import CASES, case_workspace, component_case


def test_cdsl_model_has_ports() -> None:
    model = component_case("sem_clean.cdsl")
    assert (model.name, model.period, model.threads, model.middleware) == ("robot", 20, 4, "inproc")
    ports = [(str(port.role), port.name, port.interface.name) for port in model.ports]
    assert ports == [
        ("implements", "Speech", "Speech"),
        ("requires", "front", "Laser"),
        ("requires", "Laser", "Laser"),
        ("requires", "Laser1", "Laser"),
        ("publishes", "LaserPub", "LaserPub"),
        ("subscribesTo", "SpeechEvents", "SpeechEvents"),
    ]
    assert [module.name for module in model.modules] == [
        "RoboCompLaser",
        "RoboCompLaserPub",
        "RoboCompSpeech",
    ]
    (push,) = model.with_role(Role.PUBLISHES)[0].interface.operations
    assert model.with_role(Role.PUBLISHES)[0].pattern(push) is Pattern.PUBLISH


def test_port_without_bridge_uses_component_middleware() -> None:
    model = component_case("sem_middleware_marks.cdsl")
    marks = {(str(port.role), port.name): port.middlewares for port in model.ports}
    assert marks["publishes", "LaserPub"] == ("zenoh",)
    assert marks["implements", "Laser"] == ("inproc", "zenoh")
    assert marks["requires", "Speech"] == ()


def test_option_agmagent_adds_imports_and_ports() -> None:
    model = component_case("sem_agm_interfaces/main.cdsl")
    ports = sorted((str(port.role), port.name) for port in model.ports)
    assert ports == [
        ("implements", "AGMCommonBehavior"),
        ("requires", "AGMExecutive"),
        ("requires", "Laser"),
        ("subscribesTo", "AGMExecutiveTopic"),
    ]
    assert "RoboCompAGMWorldModel" in [module.name for module in model.modules]
    assert model.options == ("agmagent", "dsr")


def test_pdsl_model_has_parameters() -> None:
    model = check_pdsl(CASES / "pdsl" / "sem_clean.pdsl", case_workspace(), Report())
    assert model is not None
    by_name = {parameter.name: parameter for parameter in model.parameters}
    assert by_name["device"].doc == "Serial device of the bus."
    rate = by_name["rate"]
    assert (rate.kind, rate.default, rate.low, rate.high) == (Kind.FLOAT, 50.0, 1.0, 1000.0)
    assert (rate.unit, rate.live) == ("Hz", True)
    assert by_name["mode"].choices == ("position", "velocity")
    assert by_name["mode"].default == "position"
    assert by_name["None"].default is None
    motors = by_name["motors"]
    assert (motors.kind, motors.low, motors.high, motors.single) == (Kind.GROUP, 1, 32, False)
    assert [member.name for member in motors.members] == ["name", "min", "pid"]
    assert motors.members[2].single


def test_innermodel_model(tmp_path: Path) -> None:
    path = tmp_path / "x.xml"
    path.write_text('<innerModel><transform id="a" tx="1"/></innerModel>\n')
    report = Report()
    body = check_innermodel(path, case_workspace(), report)
    assert body is not None
    assert not report.has_errors


def test_option_agmagent_takes_topic_from_file_of_executive(tmp_path: Path) -> None:
    (tmp_path / "agent.cdsl").write_text(
        "Component agent { Communications { }; language Python; options agmagent; };\n"
    )
    for name, declared in (
        ("AGMExecutive", ("AGMExecutive", "AGMExecutiveTopic")),
        ("AGMCommonBehavior", ("AGMCommonBehavior",)),
        ("AGMWorldModel", ()),
    ):
        interfaces = " ".join(f"interface {interface} {{ void go(); }};" for interface in declared)
        (tmp_path / f"{name}.idsl").write_text(f"module RoboComp{name} {{ {interfaces} }};\n")
    report = Report()
    model = check_cdsl(tmp_path / "agent.cdsl", Workspace(environ={}), report)
    assert [finding.message for finding in report] == []
    assert model is not None
    (topic,) = model.with_role(Role.SUBSCRIBES)
    assert topic.interface.qualified == "RoboCompAGMExecutive::AGMExecutiveTopic"
