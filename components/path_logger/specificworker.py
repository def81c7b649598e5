"""path_logger: records the published states of a base, and writes them to a file at exit."""

from __future__ import annotations

from pathlib import Path

from path_logger_generated.genericworker import GenericWorker
from path_logger_generated.interfaces import PathSummary, TBaseState
from path_record import PathRecord


class SpecificWorker(GenericWorker):
    """Records the path of a base and writes it to a file at exit."""

    def initialize(self) -> None:
        """Start with an empty path."""
        self.record = PathRecord(self.params.interval / 1000)

    def finalize(self) -> None:
        """Write the path."""
        if not self.params.file:
            return
        path = Path(self.params.file)
        try:
            self.record.write(path)
        except OSError as error:
            self.log.error("the path cannot be written to %s: %s", path, error.strerror)  # noqa: TRY400
        else:
            self.log.info("%d samples are in %s", len(self.record.samples), path.resolve())

    # implements RoboCompPathLog::PathLog

    def PathLog_getSummary(self) -> PathSummary:
        """The path so far."""
        it = self.record
        return PathSummary(len(it.samples), it.runs, it.time, it.distance)

    # subscribesTo RoboCompDifferentialRobotPub::DifferentialRobotPub

    def DifferentialRobotPub_pushBaseState(self, state: TBaseState, time: float) -> None:
        """Record the state."""
        pose = (state.correctedX, state.correctedZ, state.correctedAlpha)
        odometry = (state.x, state.z, state.alpha)
        self.record.add(time, (*pose, *odometry, state.advVz, state.rotV))
