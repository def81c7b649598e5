"""Programs of YARP that run beside a bridge."""

from __future__ import annotations

import json
import subprocess
import threading
import time
from pathlib import Path
from typing import Any

from tests.middleware.yarp.yarp_tools import VENV, Tools
from tests.support.waiting import wait_until

PROGRAM = Path(__file__).with_name("yarp_program.py")


class YarpProgram:
    """`yarp_program.py` in one of its modes; it ends with the test at the latest.

    `events` grows: lists of a word and its values; `times` has their arrivals in s.
    """

    def __init__(self, tools: Tools, *command: Any) -> None:
        self.events: list[list[Any]] = []
        self.times: list[float] = []
        self._process = subprocess.Popen(
            [str(VENV / "bin" / "python"), "-u", str(PROGRAM), json.dumps(command)],
            env=tools.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        wait_until(lambda: self.events)

    def _read(self) -> None:
        assert self._process.stdout
        for line in self._process.stdout:
            if line.startswith("["):  # YARP's own messages may begin with it, too
                try:
                    event = json.loads(line)
                except json.JSONDecodeError:
                    continue
                self.times.append(time.monotonic())
                self.events.append(event)

    @property
    def messages(self) -> list[list[Any]]:
        """The events but the first, which says that the port is open."""
        return self.events[1:]

    @property
    def ready_at(self) -> float:
        """When its port was open, in s."""
        return self.times[0]

    @property
    def pid(self) -> int:
        """Its process."""
        return self._process.pid

    def kill(self) -> None:
        """End it as a crash does."""
        self._process.kill()
        self._process.wait()
        self._reader.join()
        assert self._process.stdout
        self._process.stdout.close()
