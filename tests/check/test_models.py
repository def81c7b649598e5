"""What the models hold when all is well."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.passes import (
    check_cdsl,
    check_ddsl,
    check_idsl,
    check_innermodel,
    check_pdsl,
)
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model import types
from robocomp_dsl.model.component import Component, Role
from robocomp_dsl.model.deployment import Deployment, Qos, Restart
from robocomp_dsl.model.interface import Interface, Module, Operation, Pattern
from robocomp_dsl.model.parameter import Kind

CASES = Path(__file__).parent.parent / "cases"


def _workspace() -> Workspace:
    return Workspace(environ={}, shipped=CASES / "interfaces")


def _module(text: str, tmp_path: Path) -> Module:
    path = tmp_path / "x.idsl"
    path.write_text(text)
    report = Report()
    modules = check_idsl(path, _workspace(), report)
    assert [item for item in report if item.severity == "error"] == []
    assert modules is not None
    return modules[-1]


def _operation(text: str, tmp_path: Path) -> Operation:
    structs = """
        struct Req { int a; }; struct Outcome { int b; }; struct SayResponse { int c; };
        struct BusyRESP { int d; }; enum Mode { Idle }; exception Failed { string what; };
    """
    module = _module(f"module M {{ {structs} interface I {{ {text} }}; }};", tmp_path)
    (interface,) = module.interfaces
    return interface.operations[0]


PATTERNS = [
    # text, pattern, inputs, outputs, result
    ("[command] void stop();", Pattern.COMMAND, "", "", None),
    ("[command] void go(Req r);", Pattern.COMMAND, "r", "", None),
    ("[command] void go(Req r) throws Failed;", Pattern.COMMAND, "r", "", None),
    ("[publish] void told(Req r);", Pattern.PUBLISH, "r", "", None),
    ("[query] int say(Req q, Outcome o);", Pattern.QUERY, "q", "o", "int"),
    ("[query] int say(Req q, SayResponse o);", Pattern.QUERY, "q", "o", "int"),
    ("[query] void say(Req q, SayResponse o);", Pattern.QUERY, "q", "o", None),
    ("[query] void say(int q, BusyRESP o);", Pattern.QUERY, "q", "o", None),
    ("[query] int isBusy(BusyRESP r);", Pattern.QUERY, "", "r", "int"),
    ("[query] int tell(Req r);", Pattern.QUERY, "r", "", "int"),
    ("[query] void move(Req a, Outcome b);", Pattern.QUERY, "a b", "", None),
    ("[query] bool ask(Req q, Outcome o);", Pattern.QUERY, "q o", "", "bool"),
    ("[query] int three(Req a, Req b, SayResponse c);", Pattern.QUERY, "a b c", "", "int"),
    ("[query] int ask(Req q, out Outcome o);", Pattern.QUERY, "q", "o", "int"),
    ("[query] int ask(out Outcome o, SayResponse r);", Pattern.QUERY, "r", "o", "int"),
    ("[query] int add(int a, int b);", Pattern.QUERY, "a b", "", "int"),
    ("[query] int mode(Req q, Mode m);", Pattern.QUERY, "q m", "", "int"),
    ("int say(Req q, SayResponse o);", Pattern.QUERY, "q o", "", "int"),
    ("int get();", Pattern.QUERY, "", "", "int"),
    ("void get(out int a, out int b);", Pattern.QUERY, "", "a b", None),
    ("void run() throws Failed;", Pattern.QUERY, "", "", None),
    ("void set(int a);", Pattern.UNMARKED, "a", "", None),
    ("idempotent void set(int a);", Pattern.UNMARKED, "a", "", None),
]


@pytest.mark.parametrize(("text", "pattern", "inputs", "outputs", "result"), PATTERNS)
def test_operation_patterns(
    text: str, pattern: Pattern, inputs: str, outputs: str, result: str | None, tmp_path: Path
) -> None:
    model = _operation(text, tmp_path)
    assert model.pattern is pattern
    assert " ".join(item.name for item in model.inputs) == inputs
    assert " ".join(output.name for output in model.outputs) == outputs
    assert (model.result.name if model.result else None) == result
    assert model.marked == text.startswith("[")
    assert model.idempotent == text.startswith("idempotent")


def test_idsl_model_has_types_and_docs(tmp_path: Path) -> None:
    module = _module(
        """
        import "Base.idsl";
        /** The module. */
        module M
        {
            sequence<Thing> Things;
            /** A thing. */
            struct Thing
            {
                /** How wide. */
                float width = 2 [mm];
                Mode mode = Moving;
                Pose pose;
            };
            enum Mode { Idle, Moving = 5, Stopped };
        };
        """,
        tmp_path,
    )
    things, thing, mode = module.declarations
    assert module.doc == "The module."
    assert isinstance(things, types.Sequence)
    assert things.element is thing
    assert isinstance(thing, types.Struct)
    assert thing.doc == "A thing."
    width, kind, pose = thing.fields
    assert (width.default, width.unit, width.doc) == (2.0, "mm", "How wide.")
    assert isinstance(width.default, float)
    assert kind.type is mode
    assert kind.default == "Moving"
    assert isinstance(mode, types.Enum)
    assert [enumerator.value for enumerator in mode.enumerators] == [0, 5, 6]
    assert pose.type is module.imports[0].declarations[0]
    assert module.closure() == (module.imports[0], module)
    assert thing.span.text == "Thing"


def _component(case: str) -> Component:
    found = check_cdsl(CASES / "cdsl" / case, _workspace(), Report())
    assert found is not None
    return found


def test_cdsl_model_has_ports() -> None:
    model = _component("sem_clean.cdsl")
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
    model = _component("sem_middleware_marks.cdsl")
    marks = {(str(port.role), port.name): port.middleware for port in model.ports}
    assert marks["requires", "Laser"] == ""
    assert marks["publishes", "LaserPub"] == "zenoh"
    assert marks["implements", "Laser"] == "inproc"


def test_option_agmagent_adds_imports_and_ports() -> None:
    model = _component("sem_agm_interfaces/main.cdsl")
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
    model = check_pdsl(CASES / "pdsl" / "sem_clean.pdsl", _workspace(), Report())
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


def _deployment(case: str, tmp_path: Path | None = None, text: str = "") -> Deployment:
    path = CASES / "ddsl" / case / "main.ddsl"
    if tmp_path:
        path = tmp_path / "main.ddsl"
        path.write_text(text)
    report = Report()
    found = check_ddsl(path, _workspace(), report)
    assert found is not None
    assert not report.has_errors
    return found


def _connections(model: Deployment) -> list[str]:
    return [
        f"{c.source.name}.{c.source_port.name} -> {c.target.name}.{c.target_port.name}"
        + (" implied" if c.implied else "")
        for c in model.connections
    ]


def test_ddsl_model_has_deployment() -> None:
    model = _deployment("sem_clean")
    assert [instance.name for instance in model.instances] == ["body", "reflex"]
    body, reflex = model.instances
    assert body.settings == (
        ("rate", 100.0),
        ("device", "can0"),
        ("mode", "velocity"),
        ("safe", False),
        ("motors[2].limit", 7),
        ("pid.kp", -0.5),
    )
    assert body.config is not None
    assert body.config.is_absolute()
    assert body.config.samefile(CASES / "ddsl" / "sem_parts" / "body.yaml")
    assert body.environment == (("LOG_LEVEL", "debug"),)
    assert (body.executable, body.port) == ("python3 'my main.py'", 7451)
    assert body.restart == Restart("always", 3, 120.0)
    assert reflex.restart.policy == "never"
    assert (reflex.start_timeout_s, reflex.after, reflex.executable) == (
        0.5,
        ("body",),
        "python3 main.py",
    )
    assert _connections(model) == [
        "body.LaserPub -> reflex.LaserPub",
        "reflex.Laser -> body.Laser implied",
    ]
    assert model.connections[0].qos == Qos(False, "high", 1, 40.0)


def test_implicit_connections_skip_own_port() -> None:
    model = _deployment("sem_filter")
    assert _connections(model) == ["filter.Laser -> body.Laser"]


def test_subscription_connects_to_all_or_named_publishers(tmp_path: Path) -> None:
    parts = (CASES / "ddsl" / "sem_parts").as_posix()
    head = f"""
        import "{parts}/body.cdsl";
        import "{parts}/reflex.cdsl";
        Deployment d
        {{
            component left : body; component right : body; component reflex;
            connect reflex.Laser -> left.Laser;
    """
    model = _deployment("", tmp_path, head + "};")
    assert _connections(model)[1:] == [
        "left.LaserPub -> reflex.LaserPub implied",
        "right.LaserPub -> reflex.LaserPub implied",
    ]
    model = _deployment("", tmp_path, head + "connect right.LaserPub -> reflex.LaserPub; };")
    assert _connections(model)[1:] == ["right.LaserPub -> reflex.LaserPub"]


def test_start_order_is_stable(tmp_path: Path) -> None:
    parts = (CASES / "ddsl" / "sem_parts").as_posix()
    text = f"""
        import "{parts}/talker.cdsl";
        Deployment d
        {{
            component a : talker {{ after d; }}; component b : talker; component c : talker;
            component d : talker {{ after c; }}; component e : talker;
        }};
    """
    model = _deployment("", tmp_path, text)
    assert [instance.name for instance in model.instances] == ["c", "d", "a", "b", "e"]


def test_innermodel_model(tmp_path: Path) -> None:
    path = tmp_path / "x.xml"
    path.write_text('<innerModel><transform id="a" tx="1"/></innerModel>\n')
    report = Report()
    body = check_innermodel(path, _workspace(), report)
    assert body is not None
    assert not report.has_errors


def test_imported_interfaces_are_shared_objects() -> None:
    workspace = _workspace()
    first = check_cdsl(CASES / "cdsl" / "sem_clean.cdsl", workspace, Report())
    second = check_cdsl(CASES / "ddsl" / "sem_parts" / "body.cdsl", workspace, Report())
    assert first is not None
    assert second is not None

    def laser(component: Component) -> Interface:
        return next(port.interface for port in component.ports if port.name == "Laser")

    assert laser(first) is laser(second)
