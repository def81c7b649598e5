"""Components of the tests of monitors: speakers and callers, a listener, a server."""

from __future__ import annotations

import json
import uuid
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from textwrap import dedent
from typing import Any

from robocomp_dsl.runtime import CalledPort, Component, ComponentSpec, ServedPort
from robocomp_dsl.runtime.clock import Clock
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.connection.parse_monitors import parse_monitors
from tests.middleware.probe_types import NEWS, PROBE, NewsProxy, ProbeProxy

HEADER = "from robocomp_dsl.runtime import Monitor\n"


class Speaker(Component):
    SPEC = ComponentSpec(
        "speaker", period=0, publishes=(CalledPort("News", NewsProxy, "news_proxy"),)
    )
    news_proxy: NewsProxy


class Listener(Component):
    SPEC = ComponentSpec(
        "listener",
        period=0,
        subscribes=(ServedPort("News", NEWS, {"announced": "announced"}),),
    )

    def __init__(self) -> None:
        self.heard: list[tuple[str, int]] = []

    def announced(self, who: str, n: int) -> None:
        self.heard.append((who, n))


class Caller(Component):
    SPEC = ComponentSpec(
        "caller", period=0, requires=(CalledPort("Probe", ProbeProxy, "probe_proxy"),)
    )
    probe_proxy: ProbeProxy


class Server(Component):
    SPEC = ComponentSpec(
        "server",
        period=0,
        implements=(ServedPort("Probe", PROBE, {"add": "add", "note": "note"}),),
    )

    def __init__(self) -> None:
        self.notes: list[str] = []

    def add(self, a: int, b: int) -> int:
        return a + b

    def note(self, text: str) -> None:
        self.notes.append(text)


class Deployment:
    """Components of one domain; `file` is the Python file of its monitors."""

    def __init__(self, folder: Path, middleware: str) -> None:
        self.file = folder / "monitors.py"
        self._settings = RunSettings(domain=f"test-{uuid.uuid4().hex[:12]}", middleware=middleware)
        self._runners: list[Runner] = []

    @property
    def domain(self) -> str:
        return self._settings.domain

    @property
    def middleware(self) -> str:
        return self._settings.middleware

    def write(self, text: str) -> None:
        self.file.write_text(HEADER + dedent(text))

    def monitor(
        self, name: str, on_failure: str = "bypass", **parameters: object
    ) -> dict[str, Any]:
        """A monitor of the file, as JSON."""
        return {
            "file": str(self.file),
            "class": name,
            "parameters": parameters,
            "on_failure": on_failure,
        }

    def start(
        self,
        cls: type[Component],
        name: str,
        monitors: Sequence[dict[str, Any]] = (),
        *,
        peers: Sequence[str] = (),
        clock: Clock | None = None,
        **settings: Any,
    ) -> Any:
        """The worker of a component that has opened its ports."""
        connections = {port.name: tuple(peers) for port in cls.SPEC.ports} if peers else {}
        settings = {
            "name": name,
            "connections": connections,
            "monitors": parse_monitors(json.dumps(list(monitors))) if monitors else (),
            **settings,
        }
        runner = Runner(cls, cls.SPEC.parameters.load(), replace(self._settings, **settings), clock)
        self._runners.append(runner)
        runner.start()
        return runner

    def close(self) -> None:
        for runner in self._runners:
            runner.stop()
        for runner in self._runners:
            runner.wait()
