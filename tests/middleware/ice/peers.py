"""Plain Ice programs: peers of the tests that know nothing of this project but its Slice files."""

from __future__ import annotations

import importlib
import socket
from pathlib import Path
from typing import Any

import pytest

Ice = pytest.importorskip("Ice", reason="needs ZeroC Ice: `make test-peers` installs it")


def load_slice(file: Path, *names: str) -> list[Any]:
    """The Python modules of a Slice file and the files that it includes, compiled by Ice."""
    Ice.loadSlice(f"--all --underscore -I{file.parent} {file}")
    return [importlib.import_module(name) for name in names]


def free_port() -> int:
    """A TCP port of loopback that nothing uses."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


class PlainProgram:
    """A program written with Ice: a communicator, and an adapter at a fixed port if it serves."""

    def __init__(self, port: int = 0, **properties: str) -> None:
        data = Ice.InitializationData()
        data.properties = Ice.createProperties()
        for key, value in properties.items():
            data.properties.setProperty(f"Ice.{key.replace('_', '.')}", value)
        data.properties.setProperty("Ice.Warn.Connections", "0")
        data.properties.setProperty("Ice.Warn.Dispatch", "0")
        self.communicator = Ice.initialize(data)
        self.port = port or free_port()
        self._adapter: Any = None

    def serve(self, servant: Any, name: str) -> str:
        """Serve an object; returns its proxy as RoboComp's configurations write it."""
        endpoints = f"tcp -h localhost -p {self.port}"
        if self._adapter is None:
            self._adapter = self.communicator.createObjectAdapterWithEndpoints("plain", endpoints)
            self._adapter.activate()
        self._adapter.add(servant, Ice.stringToIdentity(name))
        return f"{name}:{endpoints}"

    def proxy(self, text: str) -> Any:
        return self.communicator.stringToProxy(text)

    def close(self) -> None:
        self.communicator.destroy()
