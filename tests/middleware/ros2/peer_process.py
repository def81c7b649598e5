"""A program of another project as a peer: started by a test, controlled line by line.

The peer answers each command line with a line of JSON. All peers have: the service `/peer/set`
(std_srvs/SetBool, replies with its own name), an echo from the topic `/peer/in` to `/peer/out`
(std_msgs/String), and the latched topic `/peer/map`. Commands: `call NAME`, `received TOPIC`,
`subscribe TOPIC`, `raw TOPIC HEX`, `publish TOPIC TEXT`.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[3]


class PeerProcess:
    """One peer; `program` is a module beside this one."""

    def __init__(self, program: str, *arguments: str) -> None:
        self._process = subprocess.Popen(
            [sys.executable, str(Path(__file__).with_name(f"{program}.py")), *arguments],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            cwd=ROOT,
        )
        assert self._read() == "ready"

    def _read(self) -> Any:
        assert self._process.stdout
        line = self._process.stdout.readline()
        assert line, f"the peer exited with {self._process.wait()}"
        return json.loads(line)

    def command(self, *words: str) -> Any:
        assert self._process.stdin
        self._process.stdin.write(" ".join(words) + "\n")
        self._process.stdin.flush()
        return self._read()

    def close(self) -> None:
        self._process.kill()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout):
            if stream:
                stream.close()
