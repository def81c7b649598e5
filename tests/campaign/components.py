"""The components of the campaign, their deployment, and the journals that they write.

`caller` sends numbered commands to `ledger` without repeating one. `ledger` writes each number when
it executes it, `caller` when it is acknowledged: the two journals show what was lost or doubled.
`source` publishes to `sink`. `bystander` calls `echo`; no fault is injected into these two.
`faulty` fails in the hook that its parameters name.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

IDSL = """
module Campaign
{
    interface Ledger { idempotent int add(int caller, int number); };
    interface Echo { idempotent int ping(int number); };
    interface Fault { void trigger(); };
    interface Feed { void news(int number, string text); };
};
"""
COMMUNICATIONS = {
    "ledger": "implements Ledger;",
    "caller": "requires Ledger;",
    "source": "publishes Feed;",
    "sink": "subscribesTo Feed;",
    "echo": "implements Echo;",
    "bystander": "requires Echo;",
    "faulty": "implements Fault; subscribesTo Feed;",
}
PERIODS_MS = {"caller": 4, "source": 10, "bystander": 10, "faulty": 20}
PARAMETERS = """
ComponentParams faulty
{
    hook string "";
    action string "";
    once string "";
};
"""
HEAD = """
from __future__ import annotations
import os
import sys
import time
from pathlib import Path
from {name}_generated.genericworker import GenericWorker
from {name}_generated.interfaces import *
from robocomp_dsl.runtime.errors import MiddlewareError

JOURNALS = Path(os.environ["CAMPAIGN_JOURNALS"])


def open_journal(name):
    return os.open(JOURNALS / name, os.O_APPEND | os.O_CREAT | os.O_WRONLY)


class SpecificWorker(GenericWorker):
"""
WORKERS = {
    "ledger": """
    def initialize(self):
        self.journal = open_journal("executed")
    def Ledger_add(self, caller, number):
        os.write(self.journal, f"{caller} {number}\\n".encode())
        return number
""",
    "caller": """
    def initialize(self):
        self.journal, self.number = open_journal("acknowledged"), 0
    def compute(self):
        self.number += 1
        try:
            self.ledger_proxy.add(os.getpid(), self.number)
        except MiddlewareError:
            return
        os.write(self.journal, f"{os.getpid()} {self.number}\\n".encode())
""",
    "source": """
    number = 0
    def compute(self):
        self.number += 1
        self.feed_proxy.news(self.number, "x" * 200)
""",
    "sink": """
    def Feed_news(self, number, text):
        pass
""",
    "echo": """
    def Echo_ping(self, number):
        return number
""",
    "bystander": """
    def initialize(self):
        self.journal, self.last = open_journal("bystander"), time.monotonic()
    def compute(self):
        start = time.monotonic()
        try:
            self.echo_proxy.ping(1)
        except MiddlewareError as error:
            print("bystander:", error)
        end = time.monotonic()
        os.write(self.journal, f"{end} {start - self.last} {end - start}\\n".encode())
        self.last = start
""",
    "faulty": """
    def fail(self, hook):
        mark = JOURNALS / self.params.once
        if hook != self.params.hook or not self.params.once or mark.exists():
            return
        mark.write_text(hook)
        match self.params.action:
            case "hang":
                time.sleep(3600)
            case "sys.exit":
                sys.exit(0)
            case "os._exit":
                os._exit(3)
            case "raise":
                raise KeyError(hook)
    def initialize(self):
        self.fail("initialize")
    def finalize(self):
        self.fail("finalize")
        (JOURNALS / f"{self.params.once}.finalized").touch()
    def compute(self):
        self.fail("compute")
    def Fault_trigger(self):
        self.fail("implements")
    def Feed_news(self, number, text):
        self.fail("subscribesTo")
""",
}
DEPLOYMENT = """
import "ledger/ledger.cdsl";
import "caller/caller.cdsl";
import "source/source.cdsl";
import "sink/sink.cdsl";
import "echo/echo.cdsl";
import "bystander/bystander.cdsl";
Deployment campaign
{
    component ledger { restart always max 1000 in 1 s; };
    component caller { after ledger; restart always max 1000 in 1 s; };
    component source { restart always max 1000 in 1 s; };
    component sink { restart always max 1000 in 1 s; };
    component echo { };
    component bystander { after echo; };
    connect source.Feed -> sink.Feed { QOS };
};
"""
FAULTY = """
import "faulty/faulty.cdsl";
import "source/source.cdsl";
Deployment faults
{
    component source { };
    component faulty
    {
        set hook = "HOOK"; set action = "ACTION"; set once = "MARK";
        restart on-failure max 5 in 60 s;
        watchdog 1 s;
        ready within 10 s;
    };
};
"""


def component_text(name: str) -> str:
    """The CDSL of the component `name`."""
    period = f"period {PERIODS_MS[name]};" if name in PERIODS_MS else ""
    parameters = 'parameters "faulty.pdsl";' if name == "faulty" else ""
    return (
        f'import "Campaign.idsl";\nComponent {name}\n{{\n'
        f"    Communications {{ {COMMUNICATIONS[name]} }};\n"
        f"    language Python;\n    {period} {parameters}\n}};\n"
    )


def build(folder: Path) -> None:
    """Generate all components below `folder`, as a user does with `rcgen component`."""
    (folder / "journals").mkdir()
    (folder / "Campaign.idsl").write_text(IDSL)
    for name, body in WORKERS.items():
        path = folder / name / f"{name}.cdsl"
        path.parent.mkdir()
        path.write_text(component_text(name))
        if name == "faulty":
            (path.parent / "faulty.pdsl").write_text(PARAMETERS)
        command = [sys.executable, "-m", "robocomp_dsl.cli.rcgen", "component", str(path)]
        subprocess.run(command, check=True, capture_output=True, timeout=60)
        (path.parent / "specificworker.py").write_text(HEAD.format(name=name) + body)
    write_deployment(folder, "campaign.ddsl", "")


def write_deployment(folder: Path, name: str, quality: str) -> None:
    """Write the deployment with `quality` of service for the topic."""
    text = DEPLOYMENT.replace(" { QOS }", f" {{ {quality} }}" if quality else "").replace(
        "Deployment campaign", f"Deployment {Path(name).stem}"
    )
    (folder / name).write_text(text)


def write_faulty_deployment(folder: Path, hook: str, action: str) -> str:
    """Write the deployment of `faulty`; the name of the file that marks that it has failed."""
    mark = f"{hook}-{action}"
    text = FAULTY.replace("HOOK", hook).replace("ACTION", action).replace("MARK", mark)
    (folder / "faults.ddsl").write_text(text)
    return mark


def count_calls(folder: Path) -> dict[str, int]:
    """Acknowledged and executed calls; how many of them were lost or executed twice."""
    acknowledged = (folder / "journals/acknowledged").read_text().splitlines()
    executed = (folder / "journals/executed").read_text().splitlines()
    return {
        "acknowledged": len(acknowledged),
        "executed": len(executed),
        "lost": len(set(acknowledged) - set(executed)),
        "doubled": len(executed) - len(set(executed)),
    }


def environment(folder: Path, runtime: Path) -> dict[str, str]:
    """The environment of all processes of the campaign: sockets and state in folders of its own."""
    return {
        **os.environ,
        "CAMPAIGN_JOURNALS": str(folder / "journals"),
        "ROBOCOMP_INTERFACES": str(folder),
        "XDG_RUNTIME_DIR": str(runtime),
        "XDG_STATE_HOME": str(folder / "state"),
    }
