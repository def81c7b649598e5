"""Models of deployments: instances, connections and start order."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Qos, Restart
from tests.check.case_models import CASES, connection_lines, deployment_case


def test_ddsl_model_has_deployment() -> None:
    model = deployment_case("sem_clean")
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
    assert connection_lines(model) == [
        "body.LaserPub -> reflex.LaserPub",
        "reflex.Laser -> body.Laser implied",
    ]
    assert model.connections[0].qos == Qos(False, "high", 1, 40.0)


def test_implicit_connections_skip_own_port() -> None:
    model = deployment_case("sem_filter")
    assert connection_lines(model) == ["filter.Laser -> body.Laser"]


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
    model = deployment_case("", tmp_path, head + "};")
    assert connection_lines(model)[1:] == [
        "left.LaserPub -> reflex.LaserPub implied",
        "right.LaserPub -> reflex.LaserPub implied",
    ]
    model = deployment_case("", tmp_path, head + "connect right.LaserPub -> reflex.LaserPub; };")
    assert connection_lines(model)[1:] == ["right.LaserPub -> reflex.LaserPub"]


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
    model = deployment_case("", tmp_path, text)
    assert [instance.name for instance in model.instances] == ["c", "d", "a", "b", "e"]


def test_monitor_file_with_syntax_error_is_reported(tmp_path: Path) -> None:
    parts = (CASES / "ddsl" / "sem_parts").as_posix()
    (tmp_path / "broken.py").write_text("class Near(Monitor):\n    def accept(self\n")
    path = tmp_path / "main.ddsl"
    path.write_text(
        f'import "{parts}/body.cdsl"; import "{parts}/reflex.cdsl";\n'
        "Deployment d { component body; component reflex;\n"
        'connect reflex.Laser -> body.Laser { monitor "broken.py" Near; }; };\n'
    )
    report = Report()
    check_ddsl(path, Workspace(environ={}, shipped=CASES / "interfaces"), report)
    (finding,) = report.sorted()
    assert finding.code.id == "RC557"
    assert finding.span.source.path.name == "broken.py"
    assert finding.span.start_position[0] == 2
    assert finding.message.startswith("invalid Python: ")
    assert [note.span.source.path.name for note in finding.notes] == ["main.ddsl"]


def test_arbitration_adds_connections_with_conditions(tmp_path: Path) -> None:
    parts = (CASES / "ddsl" / "sem_parts").as_posix()
    text = f"""
        import "{parts}/body.cdsl";
        import "{parts}/reflex.cdsl";
        Deployment d
        {{
            group eyes
            {{
                component left : body;
                component right : body;
                export LaserPub from left;
                export LaserPub from right as Other;
            }};
            component body;
            component reflex;
            connect reflex.Laser -> body.Laser;
            arbitrate reflex.LaserPub
            {{
                from eyes.LaserPub when true and !(false || not true);
                from eyes.Other when FALSE_;
                from body.LaserPub when false;
            }};
        }};
    """.replace("FALSE_", "!true || false")
    path = tmp_path / "main.ddsl"
    path.write_text(text)
    report = Report()
    model = check_ddsl(path, Workspace(environ={}, shipped=CASES / "interfaces"), report)
    assert model is not None
    assert [f.message for f in report] == ["this condition never holds"] * 2
    assert [(c.source.name, c.target.name, c.condition) for c in model.connections] == [
        ("reflex", "body", ""),
        ("eyes-left", "reflex", "true and !(false || not true)"),
        ("eyes-right", "reflex", "!true || false"),
        ("body", "reflex", "false"),
    ]
