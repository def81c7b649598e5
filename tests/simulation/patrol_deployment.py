"""A world, a component that patrols it, and their deployment, as text."""

from __future__ import annotations

from tests.simulation.served_worlds import ROOM

SECONDS = 3.0
"""Of simulated time that are recorded: the robot comes near the wall and turns away."""

WORLD = ROOM.replace('<differentialrobot id="robot"', '<differentialrobot noise="0.02" id="robot"')
WORLD = WORLD.replace('tz="-300"', 'tz="700"')
WORLD = WORLD.replace('<imu id="inertia"/>', '<imu id="inertia"/><gps id="sky" noise="30"/>')
EYE = '<camera id="eye" width="32" height="24" focal="20"/>'
WORLD = WORLD.replace('<laser id="laser"', f'{EYE}<laser id="laser"')

CDSL = """\
import "CameraSimple.idsl";
import "DifferentialRobot.idsl";
import "GPS.idsl";
import "IMUPub.idsl";
import "InnerModelManager.idsl";
import "JointMotor.idsl";
import "Laser.idsl";
import "Simulation.idsl";

/** Drives to the wall and away from it, looks about, and writes down all that it sees. */
Component patrol
{
    Communications
    {
        requires Laser, DifferentialRobot, JointMotor, GPS, InnerModelManager, Simulation;
        requires CameraSimple;
        subscribesTo IMUPub;
    };
    language Python;
    parameters "patrol.pdsl";
    period 20;
};
"""

PDSL = """\
ComponentParams patrol
{
    /** Where to write. */
    file string "";
    /** Change the world and its time now and then. */
    meddle bool false;
    /** Moment of the last line. */
    last float 5 [s] 0:1000;
};
"""

WORKER = '''\
"""patrol: to the wall and away from it."""

from __future__ import annotations

from typing import TextIO

from patrol_generated.genericworker import GenericWorker
from patrol_generated.interfaces import DataImu, MotorGoalPosition, Plane3D


class SpecificWorker(GenericWorker):
    """Drives about by its laser, and writes down all that it sees."""

    lines: TextIO

    def initialize(self) -> None:
        """Nothing is written yet."""
        self.lines = open(self.params.file, "w", encoding="utf-8")
        self.imu = DataImu()
        self.begun: float | None = None
        self.rounds = 0
        self.past: list[tuple[int, float]] = []

    def compute(self) -> None:
        """Look, drive, write."""
        now = self.clock.now()
        if self.begun is None:
            self.begun = now
        state = self.differentialrobot_proxy.getBaseState()
        scan = self.laser_proxy.getLaserData()
        neck = self.jointmotor_proxy.getMotorState("neck")
        here = self.gps_proxy.getData()
        near = float(scan.dist.min())
        self.differentialrobot_proxy.setSpeedBase(*((700.0, 0.0) if near > 900 else (0.0, 0.8)))
        side = 0.6 if neck.pos < 0.3 else -0.6
        self.jointmotor_proxy.setPosition(MotorGoalPosition("neck", side, 1.0))
        if self.params.meddle:
            self.meddle(now)
        if self.lines.closed:
            return
        seen = self.camerasimple_proxy.getImage().image.tobytes() if self.looks() else b""
        dist = scan.dist.tobytes()
        sample = (now, self.clock.epoch, near, state, neck, here, self.imu, dist, seen)
        self.lines.write(f"{now!r};{near!r};{sample!r}\\n")
        self.lines.flush()
        if now - self.begun >= self.params.last:
            self.lines.close()
            self.log.info("all is written")

    def looks(self) -> bool:
        """Every now and then."""
        self.rounds = (self.rounds + 1) % 10
        return not self.rounds

    def meddle(self, now: float) -> None:
        """A wall comes at 1 s; at 2 s it is 1 s again, without it; at 2.5 s all begins anew."""
        epoch, hand = self.clock.epoch, self.simulation_proxy
        if epoch == 0 and not self.past and now >= 1:
            self.past = [(hand.snapshot(), now)]
            wall = Plane3D(500.0, 150.0, 2800.0, 0.0, 0.0, -1.0, 900.0, 300.0, 9.0)
            self.innermodelmanager_proxy.addPlane("late", "floor", wall)
        if epoch == 0 and now >= 2:
            hand.restore(self.past[0][0])
        if epoch == 1 and now >= 2.5:
            hand.reset()

    def finalize(self) -> None:
        """Whatever is there is kept."""
        self.lines.close()

    # subscribesTo RoboCompIMUPub::IMUPub

    def IMUPub_publish(self, imu: DataImu) -> None:
        """Keep the latest."""
        self.imu = imu
'''

DDSL = """\
import "room_simulator/room_simulator.cdsl";
import "patrol/patrol.cdsl";

Deployment demo
{{
    {clock}
    component room_simulator {{ ready within 60 s; {settings} }};
    component patrol {{ after room_simulator; set file = "{file}"; set last = {last:g}; {more} }};

    connect patrol.Laser -> room_simulator.laser;
    connect patrol.DifferentialRobot -> room_simulator.robot;
    connect patrol.JointMotor -> room_simulator.JointMotor;
    connect patrol.CameraSimple -> room_simulator.eye;
    connect patrol.GPS -> room_simulator.sky;
    connect patrol.InnerModelManager -> room_simulator.InnerModelManager;
    connect patrol.Simulation -> room_simulator.Simulation;
    connect room_simulator.inertia_pub -> patrol.IMUPub;
}};
"""
