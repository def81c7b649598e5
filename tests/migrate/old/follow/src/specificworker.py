#!/usr/bin/python3
# -*- coding: utf-8 -*-
#    Copyright (C) 2022 by Somebody

from PySide2.QtCore import QTimer
from PySide2.QtWidgets import QApplication
from genericworker import *
import interfaces as ifaces
import Ice
import time
from steering import turn   # ours

sys.path.append('/opt/robocomp/lib')


# If RoboComp was compiled with Python bindings you can use InnerModel in Python
class SpecificWorker(GenericWorker):
    def __init__(self, proxy_map, startup_check=False):
        super(SpecificWorker, self).__init__(proxy_map)
        self.Period = 50
        self.nearest = 0.0
        self.steps = 0
        if startup_check:
            self.startup_check()
        else:
            self.timer.timeout.connect(self.compute)
            self.timer.start(self.Period)

    def __del__(self):
        """Destructor"""

    def setParams(self, params):
        try:
            self.threshold = float(params["Follow.Threshold"])
            self.advance = int(params["Follow.Advance"])
            self.verbose = params["Follow.Verbose"] == "True"
            self.sectors = [int(s) for s in params["Sectors"].split(",")]
        except KeyError:
            print("Error reading config params")
            return False
        return True

    @QtCore.Slot()
    def compute(self):
        try:
            ldata = self.laser_proxy.getLaserData()
            self.nearest = min(d.dist for d in ldata)
            rot = turn(self.nearest, self.threshold)
            self.differentialrobot_proxy.setSpeedBase(self.advance, rot)
        except Ice.Exception as e:
            print("no robot:", type(e).__name__)
        self.steps += 1
        return True

    def startup_check(self):
        test = ifaces.RoboCompMood.TMood()
        QTimer.singleShot(200, QApplication.instance().quit)

    # =============== Methods for Component Implements ==================
    def Mood_getMood(self):
        ret = ifaces.RoboCompMood.TMood()
        ret.nearest = self.nearest
        if self.nearest < self.threshold:
            ret.feeling = ifaces.RoboCompMood.Feeling.Afraid
        return ret

    def setSpeed(self, advance):
        self.advance = advance
