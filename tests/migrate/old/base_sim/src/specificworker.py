from genericworker import *


class SpecificWorker(GenericWorker):
    def __init__(self, proxy_map, startup_check=False):
        super(SpecificWorker, self).__init__(proxy_map)
        self.Period = 100
        self.said = []

    def DifferentialRobot_setSpeedBase(self, adv, rot):
        self.said.append((adv, rot))
        print("SPEED", adv, round(rot, 3), flush=True)
