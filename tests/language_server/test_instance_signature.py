"""The signature of an instance in the hover text of a deployment."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.language_server.signatures.signatures import signature

CASES = [
    ("component eye;", "component eye : eye"),
    ("component x : eye on localhost;", "component x : eye on localhost"),
    ("component x : eye { prefix left; };", 'prefix "left";    // runs as left/x'),
    ("component x : eye { middleware zenoh; };", "middleware zenoh;"),
    ('component x : eye { prefix "/a/b/"; };', 'prefix "a/b";    // runs as a/b/x'),
]


@pytest.mark.parametrize(("written", "line"), CASES)
def test_instance_signature(tmp_path: Path, written: str, line: str) -> None:
    (tmp_path / "eye.cdsl").write_text("Component eye { language Python; };\n")
    (tmp_path / "d.ddsl").write_text(f'import "eye.cdsl";\nDeployment d {{ {written} }};\n')
    report = Report()
    model = check_ddsl(tmp_path / "d.ddsl", Workspace(environ={}), report)
    assert model
    assert not report.has_errors
    assert line in signature(model.instances[0]).splitlines()
