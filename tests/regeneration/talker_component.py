"""A component in a folder, generated again after changes."""

from __future__ import annotations

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


@dataclass(frozen=True)
class TalkerComponent:
    """A component in a folder whose operations and ports a test selects."""

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
        """Generate the component; returns the findings about user files."""
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

    def check_import(self) -> None:
        """Import the module of the user in a process."""
        code = "import specificworker; specificworker.SpecificWorker"
        run = subprocess.run(
            [sys.executable, "-c", code],
            cwd=self.folder,
            capture_output=True,
            text=True,
            check=False,
        )
        assert run.returncode == 0, run.stderr


WORKER_HEAD = """\
from talker_generated.genericworker import GenericWorker
from talker_generated.interfaces import *

class SpecificWorker(GenericWorker):
"""


def write_worker(talker: TalkerComponent, *methods: str) -> None:
    """Write `specificworker.py` with these methods."""
    talker.worker.write_text(WORKER_HEAD + "\n".join(f"    {method}" for method in methods) + "\n")


def add_machine(talker: TalkerComponent, text: str) -> None:
    """Add the state machine `text` to the component."""
    (talker.folder / "m.smdsl").write_text(text)
    talker.describe("int say(Word w);")
    cdsl = talker.folder / "talker.cdsl"
    cdsl.write_text(cdsl.read_text().replace("language", 'statemachine "m.smdsl"; language'))


MACHINE = "m {{ states a{0}; initial_state b; transitions {{ b => a{0} on start; }}; }};\n"
