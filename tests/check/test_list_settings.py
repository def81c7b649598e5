"""`set` of lists of values: their text for the component, their files, and groups around them."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.deploy.plan import format_settings
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import Deployment

PDSL = """
ComponentParams arm
{
    weights[1:4] float 1.0;
    names[] string;
    models[0:3] path;
    on bool true;
};
"""
CDSL = 'Component arm { Communications { }; language Python; parameters "arm.pdsl"; };\n'


def deployment(folder: Path, body: str) -> Deployment:
    (folder / "arm.pdsl").write_text(PDSL)
    (folder / "arm.cdsl").write_text(CDSL)
    (folder / "app.ddsl").write_text(f'import "arm.cdsl";\nDeployment app {{ {body} }};\n')
    report = Report()
    found = check_ddsl(folder / "app.ddsl", Workspace(environ={}), report)
    assert [d.message for d in report] == []
    assert found
    return found


def test_settings_of_lists_are_written_for_the_command_line(tmp_path: Path) -> None:
    written = "set weights[0] = 2; set weights = {1, 2.5}; set on = true;"
    written += ' set names = {a, "b, \\"c\\""};'
    (instance,) = deployment(tmp_path, f"component arm {{ {written} }};").instances
    assert format_settings(instance) == (
        "weights=[1.0, 2.5]",
        "on=true",
        'names=["a", "b, \\"c\\""]',
        "weights[0]=2.0",
    ), "elements come after their list"


def test_settings_of_path_lists_are_found_and_copied(tmp_path: Path) -> None:
    text = 'component arm { set models = {"arm.pdsl", "/no", ""}; set models[1] = "arm.cdsl"; };'
    (tmp_path / "no").touch()
    (instance,) = deployment(tmp_path, text.replace("/no", str(tmp_path / "no"))).instances
    pdsl, cdsl = (str(tmp_path / name) for name in ("arm.pdsl", "arm.cdsl"))
    assert dict(instance.settings) == {
        "models": (pdsl, str(tmp_path / "no"), ""),
        "models[1]": cdsl,
    }
    assert [str(path) for path in instance.setting_paths] == [pdsl, cdsl]


def test_settings_of_groups_replace_lists_and_elements(tmp_path: Path) -> None:
    body = (
        "group pair { set inner.weights = {5}; set other.weights[0] = 6;"
        " component inner : arm { set weights[0] = 1; };"
        " component other : arm { set weights = {7, 8}; }; };"
    )
    inner, other = deployment(tmp_path, body).instances
    assert format_settings(inner) == ("weights=[5.0]",)
    assert format_settings(other) == ("weights=[7.0, 8.0]", "weights[0]=6.0")
