"""A program that runs components: a folder a line in, the exit code and its output out.

Each runs in a fork, so that the runtime is imported once.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
import traceback

import robocomp_dsl.runtime.entry_point
import robocomp_dsl.runtime.types  # noqa: F401


def run(folder: str) -> int:
    """One component from its start to its first `compute` and its end."""
    os.chdir(folder)
    sys.path.insert(0, folder)
    from specificworker import SpecificWorker  # type: ignore[import-not-found]  # noqa: PLC0415

    from robocomp_dsl.runtime import main  # noqa: PLC0415

    class Once(SpecificWorker):  # type: ignore[misc]
        def compute(self) -> None:
            super().compute()
            self.quit()

    return main(Once, ["--middleware", "inproc"])


def child(folder: str, output: int) -> None:
    os.dup2(output, 1)
    os.dup2(output, 2)
    code = 70
    try:
        code = run(folder)
    except SystemExit as leaving:
        code = int(leaving.code or 0)
    except BaseException:
        traceback.print_exc()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)


for line in sys.stdin:
    with tempfile.TemporaryFile() as log:
        pid = os.fork()
        if not pid:
            child(line.strip(), log.fileno())
        _, status = os.waitpid(pid, 0)
        log.seek(0)
        text = log.read().decode("utf-8", "replace")
    sys.stdout.write(json.dumps([os.waitstatus_to_exitcode(status), text]) + "\n")
    sys.stdout.flush()
