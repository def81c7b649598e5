"""A real IceStorm as a process of the test."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.middleware.ice.peers import Ice, PlainProgram
from tests.support.waiting import wait_until

ICEBOX = """\
IceBox.Service.IceStorm=IceStormService,37:createIceStorm --Ice.Config={folder}/icestorm.cfg
"""
ICESTORM = """\
IceStorm.InstanceName=IceStorm
IceStorm.TopicManager.Endpoints=tcp -h 127.0.0.1 -p {port}
IceStorm.Publish.Endpoints=tcp -h 127.0.0.1
IceStorm.Transient=1
"""


class IceStormProcess:
    """IceStorm at a port; `manager` is its proxy as RoboComp's configurations write it."""

    def __init__(self, folder: Path, port: int) -> None:
        self.manager = f"IceStorm/TopicManager:tcp -h localhost -p {port}"
        self.port = port
        self._folder = folder
        (folder / "icebox.cfg").write_text(ICEBOX.format(folder=folder))
        (folder / "icestorm.cfg").write_text(ICESTORM.format(port=port))
        self._process: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        program = shutil.which("icebox")
        if program is None:
            pytest.skip("needs IceStorm: `make test-peers` installs it")
        command = [program, f"--Ice.Config={self._folder}/icebox.cfg"]
        with (self._folder / "icebox.log").open("ab") as log:
            self._process = subprocess.Popen(command, stdout=log, stderr=log)
        client = PlainProgram()
        try:
            proxy = client.proxy(self.manager)
            wait_until(lambda: proxy.ice_ping() is None, ignoring=Ice.Exception)
        finally:
            client.close()

    def stop(self) -> None:
        if self._process:
            self._process.kill()
            self._process.wait()
            self._process = None


@contextmanager
def ice_storm(folder: Path, port: int) -> Iterator[IceStormProcess]:
    storm = IceStormProcess(folder, port)
    try:
        yield storm
    finally:
        storm.stop()
