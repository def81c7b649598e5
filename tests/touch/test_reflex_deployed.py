"""Simulator, generic_arm and reflex as processes over zenoh, deployed; some are held up and killed.

The clock of one robot is the machine's; that of the other is made by the simulator: what ends or
hangs there takes the time of all with it. Timeouts are long, so that a busy machine is no silent
robot, and nothing is judged by how long it took.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.component_interface import ComponentProxy, LifeState
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.tactile.description.read import load_robot
from tests.support.waiting import wait_until
from tests.touch import finger_geometry
from tests.touch.kinematic_robot import interfaces, proxy_of
from tests.touch.shipped_component import COMPONENTS
from tests.touch.shipped_system import ARM, BOARDS

DEADLINE = 120.0
RCDEPLOY = Path(sys.executable).with_name("rcdeploy")
SIDE = "left_arm"
CLOCKS = {"nao": "clock sim;", "icub": ""}
DDSL = """
import "{components}/generic_arm/generic_arm.cdsl";
import "{components}/reflex/reflex.cdsl";
import "{components}/{robot}_simulator/{robot}_simulator.cdsl";

Deployment touch
{{
    {clock}
    component robot : {robot}_simulator {{ restart on-failure max 9 in 60 s; }};
    component arm : generic_arm
    {{
        restart on-failure max 9 in 60 s;
        set description = "{description}";
        set begin = start;
    }};
    component reflex
    {{
        restart on-failure max 9 in 60 s;
        set description = "{description}";
        set threshold = 0.005;
        set full = 0.02;
        set withdraw_speed = 0.05;
        set frame_timeout = 2.0;
        set arm_timeout = 2.0;
    }};
    connect arm.board -> robot.{board};
    connect reflex.GenericArm -> arm.GenericArm;
    connect reflex.Skin -> robot.Skin;
    connect robot.SkinFrame -> reflex.SkinFrame;
    connect arm.GenericArmState -> reflex.GenericArmState;
}};
"""

pytestmark = pytest.mark.xdist_group("demo")  # they want a processor for themselves


def wait_for(condition: Callable[[], Any], message: str) -> None:
    """Wait for the condition; calls fail while a process is not there."""
    absent = (MiddlewareError, interfaces.RoboCompGenericArm_NotPossible)
    wait_until(condition, message, DEADLINE, ignoring=absent)


class ReflexDeployment:
    """The deployment, and proxies of it from outside."""

    def __init__(self, robot: str, clock: str, folder: Path) -> None:
        self.name, self.makes_time = f"reflex-{robot}-{os.getpid()}", "sim" in clock
        home = COMPONENTS / f"{robot}_simulator"
        description = home / "tactile.yaml"
        file, self.output_file = folder / "touch.ddsl", folder / "output.txt"
        board = BOARDS[robot, SIDE]
        values = {"description": description, "robot": robot, "clock": clock, "board": board}
        file.write_text(DDSL.format(**values, components=COMPONENTS), encoding="utf-8")
        self.part = load_robot(description).part(SIDE)
        self.model = mujoco.MjModel.from_xml_path(str(home / f"{robot}.xml"))
        self.data = mujoco.MjData(self.model)
        mujoco.mj_resetDataKeyframe(self.model, self.data, 0)
        mujoco.mj_forward(self.model, self.data)
        host = ComponentContext("test_client", self.name, CallbackGroup(), Statistics())
        self._middleware = open_ports("zenoh", host)
        self.reflex = self._proxy(proxy_of(interfaces.REFLEX), "reflex", "Reflex")
        self.finger = self._proxy(proxy_of(ARM.interfaces.CONTROLBOARD), "robot", "finger")
        self.arm = self._proxy(proxy_of(interfaces.GENERICARM), "arm", "GenericArm")
        self.about = {
            name: self._proxy(ComponentProxy, name, "Component")
            for name in ("robot", "arm", "reflex")
        }
        self.pids: set[int] = set()
        self.process = subprocess.Popen(
            [
                str(RCDEPLOY),
                str(file),
                "up",
                "--name",
                self.name,
                "--domain",
                self.name,
                "--no-table",
            ],
            stdout=self.output_file.open("w"),
            stderr=subprocess.STDOUT,
        )

    def _proxy(self, kind: Any, component: str, port: str) -> Any:
        at = Endpoint(kind.INTERFACE, "test_client", port, (f"{component}.{port}",))
        proxy = kind(self._middleware.proxy(at))
        proxy.set_timeout(2.0)
        return proxy

    def pid(self, name: str) -> int:
        pid = int(self.about[name].getInfo().pid)
        self.pids.add(pid)
        return pid

    def runs(self, name: str) -> bool:
        return bool(self.about[name].getInfo().state in (LifeState.Compute, LifeState.Emergency))

    def state(self) -> str:
        info = self.about["reflex"].getInfo()
        if info.state == LifeState.Emergency and info.states == ["Frozen"]:
            return "Emergency"
        return " ".join(info.states)  # none before it has begun

    def wait_until_watching(self) -> None:
        """Until the reflex watches an arm in its start pose."""
        wait_for(lambda: self.state() == "Watching", "a reflex that watches")
        wait_for(self._in_start_pose, "an arm in its start pose")

    def _in_start_pose(self) -> bool:
        away = self.arm.getState().position - self.arm.getLimits().start
        return bool(np.abs(away).max() < 0.03)

    def touch(self, place: str) -> None:
        """Bring the finger before a field, and into the skin."""
        field = next(candidate for candidate in self.part.fields if candidate.name == place)
        for off, seconds in ((0.12, 1.0), (0.004, 0.5), (-0.006, 0.1)):
            goal = finger_geometry.before_skin(self.model, self.data, self.part, field, off)
            here = self.finger.getState().position
            self.finger.setReferenceSpeed([], np.maximum(np.abs(goal - here) / seconds, 0.01))
            self.finger.positionMove([], goal)
            if off > 0:
                wait_for(lambda: self.finger.motionDone([]).all(), "a finger before the skin")

    def park(self) -> None:
        self.finger.setReferenceSpeed([], [0.3, 0.3, 0.3])
        self.finger.positionMove([], [0.4, 0.3, 0.55])

    def end(self) -> int:
        for pid in self.pids:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGCONT)
        self.process.send_signal(signal.SIGINT)
        try:
            return self.process.wait(DEADLINE)
        finally:
            self.process.kill()
            self._middleware.close()


@pytest.fixture(scope="module", params=CLOCKS.items(), ids=list(CLOCKS))
def deployed(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[ReflexDeployment]:
    deployment = ReflexDeployment(*request.param, tmp_path_factory.mktemp(request.param[0]))
    code = None
    try:
        deployment.wait_until_watching()
        for component in deployment.about:
            deployment.pid(component)
        yield deployment
    finally:
        code = deployment.end()
        # pytest shows it if a test fails
        sys.stdout.write(deployment.output_file.read_text(encoding="utf-8"))
    assert code == 0
    assert not [pid for pid in deployment.pids if Path(f"/proc/{pid}").exists()]


def test_deployed_reflex_withdraws_from_finger_and_returns(deployed: ReflexDeployment) -> None:
    start = deployed.arm.getState().position
    deployed.touch("lower_arm_outer")
    wait_for(lambda: deployed.reflex.getStatistics().withdrawals, "a withdrawal")
    far = deployed.part.fields[0].motion
    wait_for(
        lambda: np.abs(deployed.arm.getState().position - start).max() > 0.3 * np.abs(far).max(),
        "an arm that is away",
    )
    deployed.park()
    deployed.wait_until_watching()
    seen = deployed.reflex.getStatistics()
    assert (seen.framesNotFinite, seen.framesWrongLength, seen.framesOtherGeometry) == (0, 0, 0)


@pytest.mark.parametrize("who", ["arm", "robot"])
def test_deployed_reflex_is_in_emergency_while_peer_is_suspended(
    deployed: ReflexDeployment, who: str
) -> None:
    deployed.wait_until_watching()
    os.kill(deployed.pid(who), signal.SIGSTOP)
    try:
        wait_for(lambda: deployed.state() == "Emergency", "an emergency")
        reason = deployed.about["reflex"].getInfo().reason
        assert reason
        assert ("simulated clock lost" in reason) == (who == "robot" and deployed.makes_time)
        frames = deployed.reflex.getStatistics().framesAccepted
        if who == "arm":  # the skin is there all the time, and reflex_messages
            wait_for(lambda: deployed.reflex.getStatistics().framesAccepted > frames + 5, "frames")
        else:
            assert deployed.reflex.getStatistics().framesAccepted == frames
    finally:
        for pid in deployed.pids:
            os.kill(pid, signal.SIGCONT)
    deployed.wait_until_watching()


def test_deployed_reflex_stops_suspended_arm_when_it_resumes(deployed: ReflexDeployment) -> None:
    deployed.wait_until_watching()
    count = deployed.reflex.getStatistics().withdrawals
    deployed.touch("lower_arm_outer")
    wait_for(lambda: deployed.reflex.getStatistics().withdrawals > count, "a withdrawal")
    hanging = deployed.pid("arm")
    os.kill(hanging, signal.SIGSTOP)
    try:
        deployed.park()
        wait_for(lambda: deployed.state() == "Emergency", "an emergency")
        frozen = deployed.reflex.getStatistics()
    finally:
        os.kill(hanging, signal.SIGCONT)
    deployed.wait_until_watching()
    assert frozen.state == interfaces.ReflexState.Frozen


@pytest.mark.parametrize("who", ["arm", "robot", "reflex"])
def test_deployed_reflex_recovers_when_killed_peer_is_restarted(
    deployed: ReflexDeployment, who: str
) -> None:
    deployed.wait_until_watching()
    before = deployed.pid(who)
    os.kill(before, signal.SIGKILL)
    # The exit is noticed at once; the ports of the new process follow the one that has its pid.
    wait_for(lambda: deployed.pid(who) != before and deployed.runs(who), f"another {who}")
    deployed.pids.discard(before)
    wait_for(
        lambda: deployed.state() in ("Emergency", "Frozen", "Watching"), "a reflex that advance"
    )
    deployed.wait_until_watching()
    count = deployed.reflex.getStatistics().withdrawals
    deployed.touch("lower_arm_outer")
    wait_for(lambda: deployed.reflex.getStatistics().withdrawals > count, "a withdrawal")
    deployed.park()
    deployed.wait_until_watching()
