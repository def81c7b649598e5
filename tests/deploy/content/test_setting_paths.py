"""Paths in `set`: relative to the DDSL file, found by the check, passed on, copied to hosts."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.deploy.plan import Plan
from robocomp_dsl.diagnostics import Report
from tests.deploy.content.workspace_files import CDSL, check, describe, write_files

PATH_PDSL = "ComponentParams arm {{ description path{default}; parts[0:2] {{ file path; }}; }};"


@pytest.fixture
def app(tmp_path: Path) -> Path:
    """A deployment in another folder than its component, which is below `library`."""
    arm = tmp_path / "library" / "arm"
    write_files(
        arm,
        {
            "arm.cdsl": CDSL.format(name="arm", more='parameters "arm.pdsl";'),
            "arm.pdsl": PATH_PDSL.format(default=""),
            "main.py": "",
            "etc/beside_configuration.yaml": "",
            "in_component.yaml": "",
        },
    )
    write_files(tmp_path / "app", {"robot.yaml": "", "maps/hall.yaml": ""})
    return tmp_path / "app" / "app.ddsl"


def text(settings: str) -> str:
    arm = f"component arm {{ {settings} }};"
    return f'import "../library/arm/arm.cdsl"; Deployment app {{ {arm} }};'


def settings_of(planned: Plan) -> tuple[str, ...]:
    (process,) = planned.components
    return process.settings


@pytest.mark.parametrize("value", ["robot.yaml", "./robot.yaml", "../app/robot.yaml"])
def test_set_path_is_relative_to_the_ddsl_file(app: Path, value: str) -> None:
    _, planned = check(app, text(f'set description = "{value}";'))
    assert settings_of(planned) == (f"description={app.with_name('robot.yaml')}",)


def test_set_path_of_a_folder_and_in_a_group(app: Path) -> None:
    _, planned = check(app, text('set description = "maps"; set parts[1].file = "maps/hall.yaml";'))
    maps = app.with_name("maps")
    assert settings_of(planned) == (f"description={maps}", f"parts[1].file={maps}/hall.yaml")


@pytest.mark.parametrize("value", ["beside_configuration.yaml", "in_component.yaml"])
def test_set_path_that_the_component_finds_is_unchanged(app: Path, value: str) -> None:
    _, planned = check(app, text(f'set description = "{value}";'))
    assert settings_of(planned) == (f"description={value}",)


def test_set_path_beside_the_ddsl_file_precedes_that_of_the_component(app: Path) -> None:
    app.with_name("in_component.yaml").write_text("")
    _, planned = check(app, text('set description = "in_component.yaml";'))
    assert settings_of(planned) == (f"description={app.with_name('in_component.yaml')}",)


def test_set_path_in_an_imported_definition_is_relative_to_its_file(app: Path) -> None:
    definition = app.parent.parent / "groups" / "arms.ddsl"
    write_files(
        definition.parent,
        {
            "left.yaml": "",
            "arms.ddsl": 'import "../library/arm/arm.cdsl";'
            ' group arms { component arm { set description = "left.yaml"; }; };',
        },
    )
    _, planned = check(app, 'import "../groups/arms.ddsl"; Deployment app { group left : arms; };')
    assert settings_of(planned) == (f"description={definition.with_name('left.yaml')}",)


@pytest.mark.parametrize("value", ["rabot.yaml", "maps/holl.yaml", "/no/such.yaml"])
def test_set_path_that_does_not_exist_is_a_located_finding(app: Path, value: str) -> None:
    app.write_text(text(f'set description = "{value}";'))
    report = Report()
    check_ddsl(app, Workspace(), report)
    (finding,) = report
    assert finding.code.id == "RC211"
    assert finding.span.text == f'"{value}"'
    assert finding.message == f"cannot find `{app.parent / value}`"
    assert "relative to the folder of `app.ddsl`" in finding.help
    if not value.startswith("/"):
        assert finding.fix is not None


def test_absolute_set_path_of_another_machine_is_not_looked_up(app: Path) -> None:
    app.write_text(
        'import "../library/arm/arm.cdsl"; Deployment app { host robot { address "10.0.0.2"; };'
        ' component arm on robot { set description = "/robot/tactile.yaml"; }; };'
    )
    report = Report()
    check_ddsl(app, Workspace(), report)
    assert [finding.message for finding in report if "find" in finding.message] == []


def test_set_path_is_copied_to_the_host(app: Path) -> None:
    trees, findings = describe(app, text('set description = "robot.yaml";'))
    assert findings == []
    (tree,) = trees.values()
    assert "app/robot.yaml" in [file.path for file in tree.files]
    assert dict(tree.named)[str(app.with_name("robot.yaml"))].endswith("app/robot.yaml")


def test_model_and_positions_of_a_tactile_description_are_copied(app: Path) -> None:
    write_files(
        app.parent,
        {
            "robot.yaml": "robot: r\nmodel: body.xml   # MJCF\nparts:\n"
            "  arm: {skin: [{patch: p, file: taxels.txt}, {patch: q, file: gone.txt}]}\n",
            "body.xml": "",
            "taxels.txt": "",
        },
    )
    trees, findings = describe(app, text('set description = "robot.yaml";'))
    assert findings == []
    (tree,) = trees.values()
    assert {"app/robot.yaml", "app/body.xml", "app/taxels.txt"} <= {f.path for f in tree.files}
