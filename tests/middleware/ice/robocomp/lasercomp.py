"""A Python component as RoboComp's generator wrote them, with slice2py's code and etc/config."""
# ruff: noqa: E402, N802, T201

import sys
import time

import Ice

Ice.loadSlice(f"--all --underscore -I{sys.argv[2]} {sys.argv[2]}/Laser.ice")
Ice.loadSlice(f"--all --underscore -I{sys.argv[2]} {sys.argv[2]}/DifferentialRobot.ice")
import RoboCompDifferentialRobot
import RoboCompGenericBase
import RoboCompLaser


class LaserI(RoboCompLaser.Laser):
    def getLaserData(self, current=None):
        return [RoboCompLaser.TData(0.5 * (i - 1), 1000.0 + i) for i in range(3)]

    def getLaserAndBStateData(self, current=None):
        return self.getLaserData(), RoboCompGenericBase.TBaseState(x=12.5)

    def getLaserConfData(self, current=None):
        return RoboCompLaser.LaserConfData(driver="hokuyo")


def drive(base):
    base.setSpeedBase(150.0, 0.25)
    state = base.getBaseState()
    x, z, _ = base.getBasePose()
    print(f"base drives at {state.advVz:g} from {x} {z}", flush=True)
    try:
        base.setSpeedBase(-1.0, 0.0)
    except RoboCompGenericBase.HardwareFailedException as error:
        print(f"base failed: {error.what}", flush=True)


ic = Ice.initialize([sys.argv[1]])
basic = ic.stringToProxy(ic.getProperties().getProperty("DifferentialRobotProxy"))
base = RoboCompDifferentialRobot.DifferentialRobotPrx.uncheckedCast(basic)
adapter = ic.createObjectAdapter("Laser")
adapter.add(LaserI(), Ice.stringToIdentity("laser"))
adapter.activate()
print("LaserComp started", flush=True)
while True:
    try:
        drive(base)
    except Ice.Exception as error:
        print(f"no base: {error.ice_id()}", flush=True)
    time.sleep(0.05)
