"""Finds and reads the stored logs of runs, while they last and after their end.

In: the folder `robocomp/logs` below the user's state directory (XDG Base Directory Specification).
Out: runs and their records. Layout: `NAME/RUN/run.json`, and `NAME/RUN/*.jsonl` with one record a
line, in files that follow each other. Runs are numbered by counting, because the clock of a robot
may be wrong when it starts.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

from robocomp_dsl.deploy.logs import LogRecord

DESCRIPTION = "run.json"
SEGMENT_SUFFIX = ".jsonl"


@dataclass(frozen=True, slots=True)
class LogRun:
    """One run of a deployment; times in s since 1970.

    `path` is its DDSL file, `pid` that of rcdeploy. `ended` is None while it runs, and forever if
    rcdeploy was killed; `code` and `reason` are its outcome.
    """

    name: str
    path: str
    domain: str
    pid: int
    started: float
    components: tuple[str, ...] = ()
    ended: float | None = None
    code: int | None = None
    reason: str = ""

    def to_json(self) -> str:
        """The content of `run.json`."""
        return json.dumps(asdict(self), ensure_ascii=False) + "\n"


def logs_folder() -> Path:
    """The folder with the logs of all deployments of this user; it may not exist."""
    configured = os.environ.get("XDG_STATE_HOME", "")
    # A relative path is invalid by the specification.
    state = Path(configured) if configured.startswith("/") else Path.home() / ".local" / "state"
    return state / "robocomp" / "logs"


def run_folders(name: str) -> list[Path]:
    """The folders of the runs of a deployment, oldest first."""
    try:
        folders = [path for path in (logs_folder() / name).iterdir() if path.name.isdecimal()]
    except OSError:
        return []
    return sorted(folders, key=lambda folder: int(folder.name))


def read_description(folder: Path) -> LogRun | None:
    """The description of a run; None if it cannot be read."""
    try:
        data = json.loads((folder / DESCRIPTION).read_text(encoding="utf-8"))
        return LogRun(**data | {"components": tuple(data.get("components", ()))})
    except (OSError, ValueError, TypeError):
        return None


def stored_names() -> list[str]:
    """The names of all deployments with stored logs."""
    try:
        return sorted(path.name for path in logs_folder().iterdir() if run_folders(path.name))
    except OSError:
        return []


def segments(folder: Path) -> list[Path]:
    """The files with the records of a run, oldest first."""
    try:
        return sorted(path for path in folder.iterdir() if path.suffix == SEGMENT_SUFFIX)
    except OSError:
        return []


def read_records(folder: Path) -> Iterator[LogRecord]:
    """The records of a run, oldest first; what is no record is skipped.

    The last line of a run may be incomplete, and a segment may be deleted while it is read.
    """
    for segment in segments(folder):
        try:
            with segment.open(encoding="utf-8", errors="replace") as lines:
                yield from filter(None, map(_parse_record, lines))
        except OSError:
            continue


def _parse_record(line: str) -> LogRecord | None:
    try:
        return LogRecord.from_json(line)
    except (ValueError, TypeError):
        return None
