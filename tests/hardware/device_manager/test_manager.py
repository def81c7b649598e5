"""The phases of a robot's devices: order, levels, threads, failures, interrupts."""

from __future__ import annotations

import logging
import threading

import pytest

from robocomp_dsl.hardware.device_manager.check import PlanError
from robocomp_dsl.hardware.device_manager.description import Phase
from robocomp_dsl.hardware.device_manager.kinds import ActionFailed, DeviceKind
from robocomp_dsl.hardware.device_manager.manager import DeviceManager
from robocomp_dsl.hardware.device_manager.read import read_plan
from robocomp_dsl.hardware.devices.errors import CommandRefused

LONG = 60.0
"""Nothing here takes so long, unless it is broken [s]."""


class Bench:
    """Kinds of devices that write down what happens to them."""

    def __init__(self) -> None:
        self.journal: list[str] = []
        self.begun, self.go_on = threading.Event(), threading.Event()
        self.kinds = {
            "driver": DeviceKind(self._open(Written)),
            "wrapper": DeviceKind(self._open(Written), max_attached=3),
            "calibrator": DeviceKind(self._open(Calibrates), max_attached=3, calibrates=True),
            "broken": DeviceKind(self._refuse),
            "faulty": DeviceKind(self._open(Faulty), max_attached=3, calibrates=True),
            "slow": DeviceKind(self._open(Slow), max_attached=3, calibrates=True),
        }

    def _open(self, result):
        def open_(spec):
            self.journal.append(f"open {spec.name}")
            return result(self, spec)

        return open_

    def _refuse(self, spec):
        raise CommandRefused(f"{spec.name}: no such bus")

    def conductor(self, **data) -> DeviceManager:
        return DeviceManager(read_plan(data), self.kinds)


class Written:
    def __init__(self, bench, spec) -> None:
        self.bench, self.name = bench, spec.name

    def note(self, what: str) -> None:
        self.bench.journal.append(what)

    def attach(self, devices) -> None:
        self.note(f"{self.name} on {' '.join(devices)}")

    def detach(self) -> None:
        self.note(f"{self.name} off")

    def close(self) -> None:
        self.note(f"close {self.name}")


class Calibrates(Written):
    def calibrate(self, target, stop) -> None:
        self.note(f"calibrate {target}")

    def park(self, target, stop) -> None:
        self.note(f"park {target}")


class Faulty(Calibrates):
    def calibrate(self, target, stop) -> None:
        raise ActionFailed("it does not move")

    def park(self, target, stop) -> None:
        raise ZeroDivisionError

    def close(self) -> None:
        super().close()
        raise CommandRefused("it does not answer")


class Slow(Calibrates):
    def calibrate(self, target, stop) -> None:
        self.note(f"calibrate {target}")
        self.bench.begun.set()
        assert stop.wait(LONG)
        self.note(f"stopped {target}")
        raise ActionFailed("stopped")

    def park(self, target, stop) -> None:
        self.bench.begun.set()
        assert self.bench.go_on.wait(LONG)
        self.note(f"park {target}")


def device(name: str, kind: str) -> dict[str, str]:
    return {"name": name, "kind": kind}


ARM = [device("arm", "driver"), device("zero", "calibrator"), device("all", "wrapper")]


def test_device_manager_runs_levels_in_order_and_closes_in_reverse():
    bench = Bench()
    conductor = bench.conductor(
        devices=ARM,
        attach={"all": ["zero", "arm"], "zero": "arm"},
        actions=[
            {"phase": "startup", "level": 10, "calibrate": "arm"},
            {"phase": "shutdown", "level": 2, "detach": "all"},
            {"phase": "startup", "level": 5, "attach": "all"},
            {"phase": "interrupt1", "level": 0, "park": "arm", "by": "zero"},
        ],
    )
    assert conductor.phase is Phase.CLOSED
    assert conductor.start()
    assert conductor.ready
    assert (conductor.phase, conductor.level) == (Phase.RUN, 10)
    assert list(conductor.devices) == ["arm", "zero", "all"]
    assert conductor.shutdown()
    assert conductor.phase is Phase.CLOSED
    assert bench.journal == [
        "open arm",
        "open zero",
        "open all",
        "zero on arm",  # has no action of its own
        "all on zero arm",
        "calibrate arm",
        "park arm",
        "all off",
        "zero off",
        "close all",
        "close zero",
        "close arm",
    ]
    assert conductor.shutdown()  # nothing is left to do


@pytest.mark.parametrize(
    ("backwards", "expected"),
    [(False, ["park a", "park b"]), (True, ["park b", "park a"])],
)
def test_device_manager_runs_levels_backwards_in_shutdown_only(backwards, expected):
    bench = Bench()
    verbs = [("startup", "calibrate"), ("shutdown", "park")]
    conductor = bench.conductor(
        devices=[device("a", "driver"), device("b", "driver"), device("z", "calibrator")],
        attach={"z": ["a", "b"]},
        actions=[
            {"phase": phase, "level": level, verb: name}
            for phase, verb in verbs
            for level, name in ((7, "b"), (3, "a"))
        ],
        backwards=backwards,
    )
    assert conductor.start()
    assert conductor.shutdown()
    calibrated = [item for item in bench.journal if item.startswith("calibrate")]
    assert calibrated == ["calibrate a", "calibrate b"]
    assert [item for item in bench.journal if item.startswith("park")] == expected


def test_device_manager_attaches_devices_bottom_up():
    bench = Bench()
    conductor = bench.conductor(
        devices=[device("top", "wrapper"), device("mid", "wrapper"), device("low", "driver")],
        attach={"top": "mid", "mid": "low"},
    )
    assert conductor.start()
    assert bench.journal[3:] == ["mid on low", "top on mid"]
    conductor.shutdown()
    assert bench.journal[5:] == ["top off", "mid off", "close low", "close mid", "close top"]


def test_device_manager_closes_devices_if_another_cannot_be_opened():
    bench = Bench()
    devices = [device("arm", "driver"), device("leg", "broken"), device("tail", "driver")]
    conductor = bench.conductor(devices=devices)
    with pytest.raises(CommandRefused, match="leg: no such bus"):
        conductor.start()
    assert bench.journal == ["open arm", "close arm"]
    assert conductor.phase is Phase.CLOSED


def test_device_manager_logs_failures_and_continues(caplog):
    bench = Bench()
    conductor = bench.conductor(
        devices=[device("arm", "driver"), device("bad", "faulty"), device("good", "calibrator")],
        attach={"bad": "arm", "good": "arm"},
        actions=[
            {"phase": "startup", "level": 1, "calibrate": "arm", "by": "bad"},
            {"phase": "startup", "level": 2, "calibrate": "arm", "by": "good"},
            {"phase": "shutdown", "level": 1, "park": "arm", "by": "bad"},
            {"phase": "shutdown", "level": 2, "park": "arm", "by": "good"},
        ],
    )
    with caplog.at_level(logging.ERROR, "robocomp.devices"):
        assert not conductor.start()
        assert not conductor.ready
        assert not conductor.shutdown()
    assert bench.journal[-4:] == ["bad off", "close good", "close bad", "close arm"]
    assert "calibrate arm" in bench.journal
    assert "park arm" in bench.journal
    message = [record.getMessage() for record in caplog.records]
    assert message == [
        "startup: calibrate arm by bad failed: it does not move",
        "shutdown: park arm by bad failed: unexpected error in the device's code",
        "shutdown: close bad failed: it does not answer",
    ]


def test_device_manager_runs_actions_of_level_in_parallel():
    bench = Bench()
    conductor = bench.conductor(
        devices=[
            device("a", "driver"),
            device("b", "driver"),
            device("s", "slow"),
            device("z", "calibrator"),
        ],
        attach={"s": "a", "z": "b"},
        actions=[
            {"phase": "startup", "level": 1, "park": "a"},
            {"phase": "startup", "level": 1, "park": "b"},
            {"phase": "startup", "level": 2, "calibrate": "b"},
        ],
    )
    starter = threading.Thread(target=conductor.start)
    starter.start()
    assert bench.begun.wait(LONG)
    assert conductor.level == 1
    assert "calibrate b" not in bench.journal
    bench.go_on.set()
    starter.join(LONG)
    assert conductor.ready
    assert bench.journal.index("park a") < bench.journal.index("calibrate b")
    assert bench.journal.index("park b") < bench.journal.index("calibrate b")
    assert conductor.shutdown()


def test_device_manager_interrupt_stops_blocked_startup():
    bench = Bench()
    conductor = bench.conductor(
        devices=[device("arm", "driver"), device("s", "slow")],
        attach={"s": "arm"},
        actions=[
            {"phase": "startup", "level": 1, "calibrate": "arm"},
            {"phase": "startup", "level": 2, "detach": "s"},
        ],
    )
    result = []
    starter = threading.Thread(target=lambda: result.append(conductor.start()))
    starter.start()
    assert bench.begun.wait(LONG)
    conductor.interrupt()
    starter.join(LONG)
    assert result == [False]
    assert conductor.phase is Phase.INTERRUPT1
    conductor.shutdown()
    assert bench.journal[3:] == ["calibrate arm", "stopped arm", "s off", "close s", "close arm"]


def test_device_manager_handles_three_interrupts_and_second_does_not_wait():
    bench = Bench()
    conductor = bench.conductor(
        devices=[device("arm", "driver"), device("s", "slow"), device("z", "calibrator")],
        attach={"s": "arm", "z": "arm"},
        actions=[
            {"phase": "interrupt1", "level": 1, "park": "arm", "by": "s"},
            {"phase": "interrupt1", "level": 2, "park": "arm", "by": "z"},
            {"phase": "interrupt2", "level": 1, "detach": "z"},
        ],
    )
    assert not conductor.interrupt()  # nothing runs yet
    assert conductor.start()
    first = []
    patient = threading.Thread(target=lambda: first.append(conductor.interrupt()))
    patient.start()
    assert bench.begun.wait(LONG)
    conductor.interrupt()  # comes through while the parking of the first still hangs
    assert conductor.phase is Phase.INTERRUPT2
    assert bench.journal[-1] == "z off"
    patient.join(LONG)
    assert first == [False]
    conductor.interrupt()
    assert conductor.phase is Phase.INTERRUPT3
    assert not conductor.interrupt()  # there is no fourth
    bench.go_on.set()
    conductor.shutdown()
    assert bench.journal.count("park arm") == 1  # level 2 of the first did not begin
    assert bench.journal[-1] == "close arm"


def test_device_manager_abort_ends_running_actions():
    bench = Bench()
    conductor = bench.conductor(
        devices=[device("arm", "driver"), device("s", "slow")],
        attach={"s": "arm"},
        actions=[
            {"phase": "startup", "level": 1, "calibrate": "arm"},
            {"phase": "startup", "level": 1, "abort": "arm"},
        ],
    )
    assert not conductor.start()
    assert "stopped arm" in bench.journal
    conductor.shutdown()


def test_device_manager_starts_devices_again():
    bench = Bench()
    conductor = bench.conductor(devices=ARM, attach={"zero": "arm"})
    assert conductor.start()
    assert conductor.shutdown()
    first = bench.journal[:]
    assert conductor.start()
    assert conductor.shutdown()
    assert bench.journal == first * 2


WRONG = [
    ({"devices": [device("a", "driver"), device("a", "driver")]}, "there are two devices `a`"),
    ({"devices": [device("a", "drive")]}, "no kind `drive`; did you mean `driver`?"),
    ({"devices": ARM, "attach": {"zero": "arn"}}, "no device `arn`; did you mean `arm`?"),
    (
        {"devices": ARM, "attach": {"arm": "zero"}},
        "`arm` is attached to 1 devices; it supports none",
    ),
    ({"devices": ARM, "attach": {"zero": ["arm", "arm"]}}, "attached to a device twice"),
    ({"devices": ARM, "attach": {"all": "zero", "zero": "all"}}, "`all` is attached to itself"),
    ({"devices": ARM, "attach": {"all": "all"}}, "`all` is attached to itself"),
    ({"devices": ARM, "actions": [{"phase": "run", "park": "arm"}]}, "`run` has no actions"),
    (
        {"devices": ARM, "actions": [{"phase": "startup", "level": -1, "abort": "arm"}]},
        "a level is 0 or more",
    ),
    (
        {"devices": ARM, "actions": [{"phase": "startup", "park": "leg"}]},
        "there is no device `leg`",
    ),
    (
        {"devices": ARM, "actions": [{"phase": "startup", "calibrate": "arm"}]},
        "on startup level 0 calibrate arm: no calibrator is attached to `arm`",
    ),
    (
        {"devices": ARM, "actions": [{"phase": "startup", "calibrate": "arm", "by": "all"}]},
        "`all` is no calibrator",
    ),
    (
        {"devices": ARM, "actions": [{"phase": "startup", "calibrate": "arm", "by": "zero"}]},
        "`zero` is not attached to `arm`",
    ),
    (
        {
            "devices": [*ARM, device("other", "calibrator")],
            "attach": {"zero": "arm", "other": "arm"},
            "actions": [{"phase": "startup", "calibrate": "arm"}],
        },
        "`zero`, `other` could do that; name one with `by`",
    ),
    (
        {"devices": ARM, "actions": [{"phase": "startup", "attach": "all"}]},
        "`all` has no entry in `attach`",
    ),
    (
        {
            "devices": ARM,
            "attach": {"all": "arm"},
            "actions": [{"phase": "startup", "attach": "all", "by": "zero"}],
        },
        "only `calibrate` and `park` are done `by` another device",
    ),
]


@pytest.mark.parametrize(("data", "message"), WRONG)
def test_device_manager_refuses_invalid_plan_before_opening_devices(data, message):
    bench = Bench()
    with pytest.raises(PlanError) as refused:
        bench.conductor(**data)
    assert message in str(refused.value)
    assert bench.journal == []


def test_device_manager_runs_several_actions_of_one_level():
    bench = Bench()
    actions = [{"phase": "shutdown", "level": 4, verb: "zero"} for verb in ("detach", "abort")]
    assert bench.conductor(devices=ARM, attach={"zero": "arm"}, actions=actions).start()
