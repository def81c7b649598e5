"""A deployment that runs in a process of its own, and what its control socket reports."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from robocomp_dsl.deploy.control import send_request
from robocomp_dsl.deploy.instances import Unavailable
from tests.support.waiting import wait_until

PROGRAM = (sys.executable, "-m", "robocomp_dsl.cli.rcdeploy")
START_TIMEOUT_S = 90.0


class RunningDeployment:
    """Starts `rcdeploy FILE` and stops it at the end; its output goes to `FILE.log`."""

    def __init__(self, path: Path, *, output: str = "") -> None:
        self.path, self.name = path, path.stem
        self.log = Path(output) if output else path.with_suffix(".log")
        with self.log.open("ab") as stream:
            self.process = subprocess.Popen(
                [*PROGRAM, str(path)],
                cwd=path.parent,
                stdin=subprocess.DEVNULL,
                stdout=stream,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    def rows(self) -> dict[str, dict[str, Any]]:
        """The status of each component; empty while the deployment does not answer."""
        try:
            for reply in send_request(self.name, {"verb": "status"}):
                return {row["name"]: row for row in reply["rows"]}
        except (Unavailable, OSError, ValueError):
            pass
        return {}

    def is_ready(self) -> bool:
        """All components are ready."""
        states = [row["state"] for row in self.rows().values()]
        return bool(states) and set(states) == {"ready"}

    def wait_ready(self, timeout_s: float = START_TIMEOUT_S) -> None:
        """Wait until all components are ready."""
        wait_until(
            lambda: self.is_ready() or self.process.poll() is not None,
            f"{self.name} is ready",
            timeout_s,
        )
        if self.process.poll() is not None:
            raise RuntimeError(f"{self.name} ended with {self.process.returncode}: see {self.log}")

    def pid(self, component: str) -> int:
        """The process of a component; 0 if it has none."""
        return int(self.rows().get(component, {}).get("pid", 0))

    def restarted(self, component: str, old: int, timeout_s: float = 30.0) -> float | None:
        """Wait until `component` is ready with another process; the time that took [s]."""
        start = time.monotonic()
        while time.monotonic() - start < timeout_s:
            row = self.rows().get(component, {})
            if row.get("state") == "ready" and row["pid"] != old:
                return time.monotonic() - start
            time.sleep(0.005)
        return None

    def stop(self) -> int:
        """Stop with Ctrl-C; the exit code of rcdeploy."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        try:
            return self.process.wait(60)
        except subprocess.TimeoutExpired:
            self.process.kill()
            return self.process.wait()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: object, trace: TracebackType | None
    ) -> None:
        self.stop()
