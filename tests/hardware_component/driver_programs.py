"""Programs that tests of `rcgen hardware` run: drivers and clients, as text."""

from __future__ import annotations

from pathlib import Path

from tests.support import waiting

SIMULATED_DRIVER = '''
    def open(self) -> None:
        """Another process' worth of physics stands for the device."""
        if Path(self.params.address).exists():
            raise OSError("the cable is out")
        self.world = Simulation.read(Path(__file__).parent / "PACKAGE" / "scene.json")
        self.world.start()

    def close(self) -> None:
        """Let go of it."""
        if hasattr(self, "world"):
            self.world.stop()
            del self.world

    @property
    def settings(self) -> LaserSettings:
        """How the laser scans."""
        return LaserSettings(101, 57.2958, 100.0, 30000.0)

    def scan(self) -> Scan:
        """The latest scan."""
        if Path(self.params.address).exists():
            raise OSError("the cable is out")
        with self.world.lock:
            return self.world.devices["laser"].scan()
'''

WAITING = f"""
import sys
from functools import partial
sys.path.append({str(Path(waiting.__file__).parent)!r})
from waiting import wait_until
"""

CLIENT = (
    WAITING
    + """
wait_until = partial(wait_until, ignoring=Exception)
from robocomp_dsl.runtime.component.component_interface import COMPONENT, LifeState
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.component.statistics import Statistics
from PACKAGE.interfaces import LASER
from pathlib import Path

name, domain, cable = sys.argv[1:]
context = ComponentContext("client", domain, CallbackGroup(), Statistics())
middleware = open_ports("zenoh", context)

def bound(interface, port, operation):
    link = middleware.proxy(Endpoint(interface, "client", "x", (f"{name}.{port}",)))
    assert link.wait(100), port
    return link.bind(next(o for o in interface.operations if o.name == operation))

def work():
    scan = bound(LASER, "laser", "getLaserData")
    wait_until(lambda: abs(float(scan().dist[50]) - 2775) < 2)
    assert bound(LASER, "laser", "getLaserConfData")().maxMeasures == 101
    if cable:
        info = bound(COMPONENT, "Component", "getInfo")
        Path(cable).touch()
        wait_until(lambda: info().state == LifeState.Emergency)
        try:
            scan()
            raise SystemExit("a scan without a cable")
        except Exception as error:
            assert "the cable is out" in str(getattr(error, "what", error)), error
        Path(cable).unlink()
        wait_until(lambda: info().state == LifeState.Compute)
        wait_until(lambda: abs(float(scan().dist[50]) - 2775) < 2)

try:
    work()
finally:
    middleware.close()
"""
)

BUS = (
    WAITING
    + """
import time
import numpy as np
from driver import Driver
from PACKAGE import interfaces as i
from PACKAGE.hardware import IDS, PORTS
from PACKAGE.params import ArmParams
from robocomp_dsl.hardware.drivers.driver_host import DriverHost
from robocomp_dsl.hardware.devices.errors import HardwareError
from robocomp_dsl.runtime import ServedPort

class FreeArm(Driver):
    "Joints without load."
    torque = np.zeros(6)
    at, speed, last = np.array([1.2, 0.2, 0, -0.5, 0, 0.5]), np.zeros(6), time.perf_counter()

    def open(self):
        self.last = time.perf_counter()

    def read(self):
        now = time.perf_counter()
        for _ in range(min(round((now - self.last) / 5e-4), 100)):
            self.speed = self.speed + (self.torque - 0.02 * self.speed) / 5e-3 * 5e-4
            self.at = self.at + self.speed * 5e-4
        self.last = now
        return self.at.copy(), self.speed.copy()

    def write(self, torque):
        self.torque = torque

hardware = DriverHost(FreeArm(ArmParams()), IDS, motors=True)
served = [ServedPort("LArm", i.CONTROLBOARD), ServedPort("JointMotor", i.JOINTMOTOR)]
ports = hardware.serve(served, PORTS)
try:
    ports["LArm"].getState()
    raise SystemExit("a state of motors that are not there")
except HardwareError as error:
    assert "has not been opened yet" in str(error), error
hardware.open()
assert [joint.name for joint in ports["LArm"].getJoints()] == IDS
ports["LArm"].setControlMode([], i.ControlMode.Position)
ports["LArm"].setReferenceSpeed(["LShoulderPitch"], np.array([1.0]))
ports["LArm"].positionMove(["LShoulderPitch"], np.array([0.9]))
wait_until(
    lambda: abs(ports["LArm"].getState().position[0] - 0.9) < 0.02,
    lambda: str(ports["LArm"].getState().position),
)
assert abs(ports["JointMotor"].getMotorState("LShoulderPitch").pos - 0.9) < 0.05
hardware.close()
"""
)
