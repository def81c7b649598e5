"""Components that load a deployment, and write journals of what they did.

`caller` sends numbered commands to `ledger`, and does not repeat one. `ledger` writes each command
that it executes, `caller` each that is acknowledged: the journals show what was lost or executed
twice. `source` publishes numbers to `sink`, and logs each. `faulty` fails as its parameter says,
`stubborn` ignores SIGTERM. `caller` and `ledger` are not ready while the file `NAME.hold` is in the
folder of the journals.
Times are those of the monotonic clock, which all hosts of a test share.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.plan import plan
from robocomp_dsl.generate.write import write

IDSL = """
module Faults
{
    interface Ledger { idempotent int add(int caller, int number); };
    interface Feed { void news(int number, string text); };
};
"""
COMMUNICATIONS = {
    "ledger": "implements Ledger;",
    "caller": "requires Ledger;",
    "source": "publishes Feed;",
    "sink": "subscribesTo Feed;",
    "faulty": "",
    "stubborn": "",
}
PERIODS_MS = {"caller": 5, "source": 20, "faulty": 50}
PARAMETERS = 'ComponentParams faulty { fault string ""; };\n'
HEAD = """
from __future__ import annotations
import os
import random
import signal
import time
from pathlib import Path
from {name}_generated.genericworker import GenericWorker
from {name}_generated.interfaces import *
from robocomp_dsl.runtime.errors import MiddlewareError

JOURNALS = Path("/run/host/journals")


def open_journal(name):
    return os.open(JOURNALS / name, os.O_APPEND | os.O_CREAT | os.O_WRONLY)


def write(journal, *fields):
    os.write(journal, (" ".join(map(str, fields)) + "\\n").encode())


def wait_while_held(name):
    while (JOURNALS / f"{{name}}.hold").exists():
        time.sleep(0.01)


class SpecificWorker(GenericWorker):
"""
WORKERS = {
    "ledger": """
    def initialize(self):
        wait_while_held("ledger")
        self.journal = open_journal("executed")
    def Ledger_add(self, caller, number):
        write(self.journal, caller, number, time.monotonic())
        return number
""",
    "caller": """
    def initialize(self):
        wait_while_held("caller")
        self.journal, self.number = open_journal("acknowledged"), 0
        self.identity = random.getrandbits(31)
    def compute(self):
        self.number += 1
        try:
            self.ledger_proxy.add(self.identity, self.number)
        except MiddlewareError:
            return
        write(self.journal, self.identity, self.number, time.monotonic())
""",
    "source": """
    number = 0
    def compute(self):
        self.number += 1
        self.feed_proxy.news(self.number, str(os.getpid()))
        self.log.info("number %d", self.number)
""",
    "sink": """
    def initialize(self):
        self.journal = open_journal("received")
    def Feed_news(self, number, text):
        write(self.journal, text, number, time.monotonic())
""",
    "faulty": """
    leaked = b""
    def compute(self):
        match self.params.fault:
            case "crashes":
                self.log.info("about to crash")
                os._exit(3)
            case "hangs":
                time.sleep(3600)
            case "leaks":
                self.leaked += bytes(5_000_000)
""",
    "stubborn": """
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    signal.signal = lambda *_: None  # nobody sets another handler
""",
}


def build(folder: Path) -> None:
    """Generate all components below `folder`."""
    for name, body in WORKERS.items():
        path = folder / name / f"{name}.cdsl"
        path.parent.mkdir(parents=True)
        (path.parent / "Faults.idsl").write_text(IDSL)
        path.write_text(component_text(name))
        if name == "faulty":
            path.with_suffix(".pdsl").write_text(PARAMETERS)
        report = Report()
        component = check_cdsl(path, Workspace(), report)
        assert component, [str(finding) for finding in report.sorted()]
        assert not report.has_errors, [str(finding) for finding in report.sorted()]
        write(path.parent, plan(component))
        (path.parent / "specificworker.py").write_text(HEAD.format(name=name) + body)


def component_text(name: str) -> str:
    """The CDSL of the component `name`."""
    uses_interface = 'import "Faults.idsl";' if COMMUNICATIONS[name] else ""
    period = f"period {PERIODS_MS[name]};" if name in PERIODS_MS else ""
    parameters = 'parameters "faulty.pdsl";' if name == "faulty" else ""
    return (
        f"{uses_interface}\nComponent {name}\n{{\n"
        f"    Communications {{ {COMMUNICATIONS[name]} }};\n"
        f"    language Python;\n    {period} {parameters}\n}};\n"
    )
