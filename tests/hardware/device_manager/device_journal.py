"""Devices that record what happens to them."""

from __future__ import annotations

import threading

from robocomp_dsl.hardware.device_manager.kinds import ActionFailed, DeviceKind
from robocomp_dsl.hardware.device_manager.manager import DeviceManager
from robocomp_dsl.hardware.device_manager.read import read_plan
from robocomp_dsl.hardware.devices.errors import CommandRefused

LONG = 60.0
"""Nothing here takes so long, unless it is broken [s]."""


class DeviceJournal:
    """Kinds of devices that write down what happens to them."""

    def __init__(self) -> None:
        self.entries: list[str] = []
        self.started, self.released = threading.Event(), threading.Event()
        self.kinds = {
            "driver": DeviceKind(self._open(JournalDevice)),
            "wrapper": DeviceKind(self._open(JournalDevice), max_attached=3),
            "calibrator": DeviceKind(
                self._open(JournalCalibrator), max_attached=3, calibrates=True
            ),
            "broken": DeviceKind(self._refuse),
            "faulty": DeviceKind(self._open(FailingCalibrator), max_attached=3, calibrates=True),
            "slow": DeviceKind(self._open(BlockingCalibrator), max_attached=3, calibrates=True),
        }

    def _open(self, result):
        def open_(spec):
            self.entries.append(f"open {spec.name}")
            return result(self, spec)

        return open_

    def _refuse(self, spec):
        raise CommandRefused(f"{spec.name}: no such bus")

    def manager(self, **data) -> DeviceManager:
        return DeviceManager(read_plan(data), self.kinds)


class JournalDevice:
    def __init__(self, journal, spec) -> None:
        self.journal, self.name = journal, spec.name

    def note(self, what: str) -> None:
        self.journal.entries.append(what)

    def attach(self, devices) -> None:
        self.note(f"{self.name} on {' '.join(devices)}")

    def detach(self) -> None:
        self.note(f"{self.name} off")

    def close(self) -> None:
        self.note(f"close {self.name}")


class JournalCalibrator(JournalDevice):
    def calibrate(self, target, stop) -> None:
        self.note(f"calibrate {target}")

    def park(self, target, stop) -> None:
        self.note(f"park {target}")


class FailingCalibrator(JournalCalibrator):
    def calibrate(self, target, stop) -> None:
        raise ActionFailed("it does not move")

    def park(self, target, stop) -> None:
        raise ZeroDivisionError

    def close(self) -> None:
        super().close()
        raise CommandRefused("it does not answer")


class BlockingCalibrator(JournalCalibrator):
    def calibrate(self, target, stop) -> None:
        self.note(f"calibrate {target}")
        self.journal.started.set()
        assert stop.wait(LONG)
        self.note(f"stopped {target}")
        raise ActionFailed("stopped")

    def park(self, target, stop) -> None:
        self.journal.started.set()
        assert self.journal.released.wait(LONG)
        self.note(f"park {target}")


def device(name: str, kind: str) -> dict[str, str]:
    return {"name": name, "kind": kind}


ARM = [device("arm", "driver"), device("zero", "calibrator"), device("all", "wrapper")]
