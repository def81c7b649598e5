"""Check the form of a component's window: `mainUI.ui`, which Qt Designer writes.

In: the `gui` of a component, the folder of its CDSL file. Out: a finding if the form is for another
class of window.
"""

from __future__ import annotations

import re
from pathlib import Path

from robocomp_dsl.check.codes import names as codes
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.source import UnreadableSource
from robocomp_dsl.syntax.ast.cdsl import Gui

FORMS = ("mainUI.ui", "src/mainUI.ui")
"""The places of the form, as in `robocomp_dsl.runtime.gui.ui_file`."""
_WIDGET = re.compile(r'<widget\s+class="(\w+)"')
_FITTING = {
    "QWidget": {"QWidget", "QFrame"},
    "QDialog": {"QWidget", "QFrame", "QDialog"},
    "QMainWindow": {"QMainWindow"},
}
"""The classes of forms that fit each class of window."""


def check_form(gui: Gui, folder: Path, workspace: Workspace, report: Report) -> None:
    """Report a form in `folder` that does not fit the class of the window."""
    path = next((folder / form for form in FORMS if (folder / form).is_file()), None)
    if path is None:
        return
    try:
        widget = _WIDGET.search(workspace.sources.read(path).text)
    except UnreadableSource:  # reported when the window is opened
        return
    if widget and widget[1] not in _FITTING.get(gui.widget.text, {widget[1]}):
        fits = [window for window, forms in _FITTING.items() if widget[1] in forms]
        other = f"write `gui Qt({fits[0]});`, or " if fits else ""
        report.add(
            codes.FORM_MISMATCH,
            gui.widget.span,
            f"the form `{path.relative_to(folder)}` is for a `{widget[1]}`,"
            f" not for a `{gui.widget.text}`",
            help=f"{other}change the class of the form in Qt Designer",
        )
