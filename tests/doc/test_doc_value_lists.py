"""Lists of values in the documentation of a component."""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.passes import check_pdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.doc.component_page import parameter_table


def test_parameter_table_shows_length_default_and_range_of_lists(tmp_path: Path) -> None:
    file = tmp_path / "arm.pdsl"
    file.write_text(
        "ComponentParams arm { weights[1:8] float 1.0 [kg] 0:10; names[] string;"
        " modes[2] {fast, slow} {fast, slow}; needed[3] int; };\n"
    )
    report = Report()
    parameters = check_pdsl(file, Workspace(environ={}), report)
    assert parameters
    assert not report.has_errors
    (table,) = parameter_table(parameters)
    text = repr(table)
    for shown in (
        "list of 1 to 8 elements: ",
        "[1.0]",
        "list of any number of elements: ",
        "list of 2 elements: ",
        '["fast", "slow"]',
        "must be given",
    ):
        assert shown in text
