"""An action of a bridge with a client of ROS 1's actionlib, and a lift that is a YARP program."""

from __future__ import annotations

import json
import subprocess
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.runtime import types as rt
from tests.bridge.bridge_run import Peer, running
from tests.bridge.lift_bridge import generate_lift
from tests.cli.rcgen_run import Rcgen
from tests.middleware.ros1.ros1_peers import LOOPBACK, PYTHON, Master, needs_ros1
from tests.support.waiting import wait_until


class LiftCommand(rt.Struct):
    verb: rt.String = ""
    height: rt.Int = 0


class LiftState(rt.Struct):
    height: rt.Int = 0
    moving: rt.Bool = False


COMMANDS = rt.Interface(
    "Test::Commands", rt.Operation("send", rt.Pattern.PUBLISH, {"command": LiftCommand})
)
STATES = rt.Interface(
    "Test::States", rt.Operation("send", rt.Pattern.PUBLISH, {"state": LiftState})
)
pytestmark = [pytest.mark.peers, needs_ros1, pytest.mark.usefixtures("name_server")]


class ActionClient:
    """The program `actionlib_client.py`; `events` grow."""

    def __init__(self, master: Master) -> None:
        script = Path(__file__).with_name("actionlib_client.py")
        self.events: list[dict[str, Any]] = []
        self.process = subprocess.Popen(
            [PYTHON, str(script)],
            env=master.environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self.events.append(json.loads(line))

    def write(self, line: str) -> None:
        """Tell the program what to do."""
        assert self.process.stdin is not None
        self.process.stdin.write(f"{line}\n")
        self.process.stdin.flush()

    def done(self, goal: int) -> dict[str, Any] | None:
        """The event with the outcome of a goal."""
        return next((e for e in self.events if e["event"] == "done" and e["goal"] == goal), None)


@pytest.fixture
def master(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Master]:
    home = tmp_path / "ros"
    home.mkdir()
    started = Master(home)
    monkeypatch.setenv("ROS_MASTER_URI", started.uri)
    monkeypatch.setenv("ROS_HOSTNAME", LOOPBACK)
    yield started
    started.stop()


@pytest.fixture
def client(master: Master) -> Iterator[ActionClient]:
    started = ActionClient(master)
    yield started
    started.process.kill()
    started.process.communicate()


def test_action_serves_actionlib_client_with_yarp_program(
    rcgen: Rcgen, tmp_path: Path, domain: str, peer: Callable[..., Peer], client: ActionClient
) -> None:
    folder = generate_lift(rcgen, tmp_path / "bridge")
    commands = peer("yarp", lift="/lift/command:i").subscribe(COMMANDS, "lift")
    push = peer("yarp", lift="/lift/state:o").publisher(STATES, "lift")
    with running(folder, "--domain", domain) as worker:

        def sent(verb: str, height: int) -> bool:
            return any((c.verb, c.height) == (verb, height) for c in commands)

        wait_until(lambda: client.events and hasattr(worker, "bridge"))
        goals = worker.bridge.actions["lift"].goals
        # The ports of the lift connect a little later than the client.
        received = worker.bridge.inputs["lift"].counts
        wait_until(lambda: (push(LiftState(0, False)), received.messages)[1])

        client.write("goal 5")
        wait_until(lambda: sent("move", 5))
        push(LiftState(3, True))
        wait_until(lambda: any(e.get("feedback") == 3 for e in client.events))
        assert client.done(5) is None
        push(LiftState(5, False))
        wait_until(lambda: client.done(5))
        assert client.done(5) == {"event": "done", "goal": 5, "state": 3, "result": 5}

        client.write("goal 7")
        wait_until(lambda: sent("move", 7))
        client.write("cancel")
        wait_until(lambda: sent("stop", 0) and client.done(7))
        assert client.done(7)["state"] == 2  # type: ignore[index]

        client.write("goal 8")
        wait_until(lambda: sent("move", 8))
        push(LiftState(101, True))
        wait_until(lambda: client.done(8))
        assert client.done(8) == {"event": "done", "goal": 8, "state": 4, "result": 101}
        assert goals.running is None
