"""Documentation of items: comments behind them, and Doxygen's commands."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.check.doc_comments import plain
from robocomp_dsl.check.passes import check_idsl, check_pdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.types import Enum, Struct

FIELDS = """module M
{
    struct P
    {
        int a;  // plain
        int b;  /// three slashes
        /// before
        int c;
        int d;  ///< Doxygen
        int e;  /**< a block */
        int f;  //!< Qt style
        int g;  // int h;
        int i;  // -----
        int j; };
    enum E { X, // the first
        Y = 2 // the last
    };
};
"""


def test_documentation_of_fields_is_comment_on_their_line(tmp_path: Path) -> None:
    (tmp_path / "M.idsl").write_text(FIELDS)
    modules = check_idsl(tmp_path / "M.idsl", Workspace(environ={}), Report())
    assert modules
    structs = [d for d in modules[0].declarations if isinstance(d, Struct)]
    enums = [d for d in modules[0].declarations if isinstance(d, Enum)]
    assert {field.name: field.doc for field in structs[0].fields} == {
        "a": "plain",
        "b": "three slashes",
        "c": "before",
        "d": "Doxygen",
        "e": "a block",
        "f": "Qt style",
        "g": "",
        "i": "",
        "j": "",
    }
    assert [value.doc for value in enums[0].enumerators] == ["the first", "the last"]


def test_documentation_of_parameter_is_comment_on_its_line(tmp_path: Path) -> None:
    text = "ComponentParams arm\n{\n    rate int 5;  // Hz of the arm\n    name string;\n};\n"
    (tmp_path / "arm.pdsl").write_text(text)
    parameters = check_pdsl(tmp_path / "arm.pdsl", Workspace(environ={}), Report())
    assert parameters
    assert [parameter.doc for parameter in parameters.parameters] == ["Hz of the arm", ""]


@pytest.mark.parametrize(
    ("comment", "text"),
    [
        ("@brief Moves the arm.", "Moves the arm."),
        ("\\struct Point\n@brief A point.", "A point."),
        ("Moves.\n@param x the goal\n@param[in] y - fast", "Moves.\n- `x`: the goal\n- `y`: fast"),
        (
            "@return whether it moves\n\\throws Error late",
            "Returns whether it moves\nRaises Error late",
        ),
        ("@note slow", "Note: slow"),
        ("me@example.org", "me@example.org"),
    ],
)
def test_plain_comment_has_no_commands(comment: str, text: str) -> None:
    assert plain(comment) == text
