"""A deployment of scripted processes in its own process: `scripted_session.py FOLDER NAME SPEC`.

SPEC is a JSON list of `{name, body, after}`, and of `{extern}` with the fields of an external
program. Prints every record as one line of text.
"""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from pathlib import Path

from robocomp_dsl.deploy import instances, session
from robocomp_dsl.deploy.external_program import ExternalProgram
from robocomp_dsl.deploy.logs import LogRecord
from robocomp_dsl.deploy.supervisor.run_options import Options
from tests.deploy.scripted_processes import FifoLifecycleMonitor, make_plan, scripted_process


class PrintedDisplay(session.Display):
    def record(self, record: LogRecord) -> None:
        print_line(f"{record.component}: {record.text}")


def print_line(text: str) -> None:
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()


def main() -> int:
    where, name = Path(sys.argv[1]), sys.argv[2]
    where.mkdir(exist_ok=True)
    entries = json.loads(sys.argv[3])
    externals = [ExternalProgram.from_dict(e["extern"]) for e in entries if "extern" in e]
    spec = [entry for entry in entries if "extern" not in entry]
    processes = [
        scripted_process(
            where,
            process["name"],
            process["body"],
            after=tuple(process.get("after", ())),
            stops_after=tuple(o["name"] for o in spec if process["name"] in o.get("after", ())),
        )
        for process in spec
    ]
    plan = replace(make_plan(where, *processes, name=name), externals=tuple(externals))
    try:
        claim = instances.acquire(name)
    except instances.Unavailable as error:
        print_line(str(error))
        return 1
    try:
        monitor = FifoLifecycleMonitor(where / "fifo")
        options = Options(grace_s=2.0)
        return session.run(plan, claim, monitor, PrintedDisplay(), options).code
    finally:
        claim.release()


if __name__ == "__main__":
    raise SystemExit(main())
