"""A deployment of scripted processes in its own process: `scripted_session.py FOLDER NAME SPEC`.

SPEC is a JSON list of `{name, body, after}`. Prints every record as one line of text.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from robocomp_dsl.deploy import instances, session
from robocomp_dsl.deploy.logs import LogRecord
from robocomp_dsl.deploy.supervisor.supervisor import Options
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
    spec = json.loads(sys.argv[3])
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
    plan = make_plan(where, *processes, name=name)
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
