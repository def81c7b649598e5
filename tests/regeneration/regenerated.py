"""A component in a folder, generated again after changes."""

from __future__ import annotations

import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli.output import render
from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.generate.plan import plan
from robocomp_dsl.generate.regeneration.update import update_user_files
from robocomp_dsl.generate.write import write

STARTS = """\
import sys
from specificworker import SpecificWorker
from robocomp_dsl.runtime import main
sys.exit(main(SpecificWorker, ["--version"]))
"""


@dataclass(frozen=True)
class Talker:
    """A component that implements and subscribes to what a test says."""

    folder: Path

    def describe(self, operations: str, *, parameters: str = "", ports: str = "") -> None:
        """Write the descriptions."""
        (self.folder / "Talk.idsl").write_text(
            "module M { struct Word { string text; }; struct Tone { int pitch; };\n"
            f"interface Talk {{ {operations} }}; interface Ear {{ void heard(Word w); }}; }};\n"
        )
        (self.folder / "talker.pdsl").write_text(f"ComponentParams talker {{ {parameters} }};\n")
        (self.folder / "talker.cdsl").write_text(
            'import "Talk.idsl";\nComponent talker\n{\n    Communications { '
            f"{ports or 'implements Talk;'} }};\n"
            '    language Python; parameters "talker.pdsl"; middleware inproc;\n};\n'
        )

    def generate(self) -> list[Diagnostic]:
        """Generate it; the findings about what is the user's."""
        report = Report()
        component = check_cdsl(self.folder / "talker.cdsl", Workspace(environ={}), report)
        assert not report.has_errors, render.full(report)
        assert component is not None
        found = Report()
        write(self.folder, update_user_files(self.folder, component, plan(component), found))
        return found.sorted()

    @property
    def worker(self) -> Path:
        return self.folder / "specificworker.py"

    def imports(self) -> None:
        """Python runs the module of the user, with all that it imports."""
        code = "import specificworker; specificworker.SpecificWorker"
        run = subprocess.run(
            [sys.executable, "-c", code],
            cwd=self.folder,
            capture_output=True,
            text=True,
            check=False,
        )
        assert run.returncode == 0, run.stderr

    def copy_to(self, folder: Path) -> Talker:
        """The same in another folder."""
        shutil.copytree(self.folder, folder)
        return Talker(folder)
