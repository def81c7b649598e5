from genericworker import *
import RoboCompLaser


class SpecificWorker(GenericWorker):
	def __init__(self, proxy_map):
		super(SpecificWorker, self).__init__(proxy_map)
		self.timer.timeout.connect(self.compute)
		self.Period = 20
		self.timer.start(self.Period)

	def setParams(self, params):
		return True

	@QtCore.Slot()
	def compute(self):
		return True

	def getLaserData(self):
		data = RoboCompLaser.TLaserData()
		for i in range(3):
			one = RoboCompLaser.TData()
			one.dist, one.angle = 300.0 + i, 0.1 * i
			data.append(one)
		return data
