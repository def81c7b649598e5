"""The phases of a robot's devices: order, levels, threads and failures."""

from __future__ import annotations

import logging
import threading

import pytest

from robocomp_dsl.hardware.device_manager.description import Phase
from robocomp_dsl.hardware.devices.errors import CommandRefused
from tests.hardware.device_manager.device_journal import ARM, LONG, DeviceJournal, device


def test_device_manager_runs_levels_in_order_and_closes_in_reverse():
    journal = DeviceJournal()
    manager = journal.manager(
        devices=ARM,
        attach={"all": ["zero", "arm"], "zero": "arm"},
        actions=[
            {"phase": "startup", "level": 10, "calibrate": "arm"},
            {"phase": "shutdown", "level": 2, "detach": "all"},
            {"phase": "startup", "level": 5, "attach": "all"},
            {"phase": "interrupt1", "level": 0, "park": "arm", "by": "zero"},
        ],
    )
    assert manager.phase is Phase.CLOSED
    assert manager.start()
    assert manager.ready
    assert (manager.phase, manager.level) == (Phase.RUN, 10)
    assert list(manager.devices) == ["arm", "zero", "all"]
    assert manager.shutdown()
    assert manager.phase is Phase.CLOSED
    assert journal.entries == [
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
    assert manager.shutdown()  # nothing is left to do


@pytest.mark.parametrize(
    ("backwards", "expected"),
    [(False, ["park a", "park b"]), (True, ["park b", "park a"])],
)
def test_device_manager_runs_levels_backwards_in_shutdown_only(backwards, expected):
    journal = DeviceJournal()
    verbs = [("startup", "calibrate"), ("shutdown", "park")]
    manager = journal.manager(
        devices=[device("a", "driver"), device("b", "driver"), device("z", "calibrator")],
        attach={"z": ["a", "b"]},
        actions=[
            {"phase": phase, "level": level, verb: name}
            for phase, verb in verbs
            for level, name in ((7, "b"), (3, "a"))
        ],
        backwards=backwards,
    )
    assert manager.start()
    assert manager.shutdown()
    calibrated = [entry for entry in journal.entries if entry.startswith("calibrate")]
    assert calibrated == ["calibrate a", "calibrate b"]
    assert [entry for entry in journal.entries if entry.startswith("park")] == expected


def test_device_manager_attaches_devices_bottom_up():
    journal = DeviceJournal()
    manager = journal.manager(
        devices=[device("top", "wrapper"), device("mid", "wrapper"), device("low", "driver")],
        attach={"top": "mid", "mid": "low"},
    )
    assert manager.start()
    assert journal.entries[3:] == ["mid on low", "top on mid"]
    manager.shutdown()
    assert journal.entries[5:] == ["top off", "mid off", "close low", "close mid", "close top"]


def test_device_manager_closes_devices_if_another_cannot_be_opened():
    journal = DeviceJournal()
    devices = [device("arm", "driver"), device("leg", "broken"), device("tail", "driver")]
    manager = journal.manager(devices=devices)
    with pytest.raises(CommandRefused, match="leg: no such bus"):
        manager.start()
    assert journal.entries == ["open arm", "close arm"]
    assert manager.phase is Phase.CLOSED


def test_device_manager_logs_failures_and_continues(caplog):
    journal = DeviceJournal()
    manager = journal.manager(
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
        assert not manager.start()
        assert not manager.ready
        assert not manager.shutdown()
    assert journal.entries[-4:] == ["bad off", "close good", "close bad", "close arm"]
    assert "calibrate arm" in journal.entries
    assert "park arm" in journal.entries
    message = [record.getMessage() for record in caplog.records]
    assert message == [
        "startup: calibrate arm by bad failed: it does not move",
        "shutdown: park arm by bad failed: unexpected error in the device's code",
        "shutdown: close bad failed: it does not answer",
    ]


def test_device_manager_runs_actions_of_level_in_parallel():
    journal = DeviceJournal()
    manager = journal.manager(
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
    starter = threading.Thread(target=manager.start)
    starter.start()
    assert journal.started.wait(LONG)
    assert manager.level == 1
    assert "calibrate b" not in journal.entries
    journal.released.set()
    starter.join(LONG)
    assert manager.ready
    assert journal.entries.index("park a") < journal.entries.index("calibrate b")
    assert journal.entries.index("park b") < journal.entries.index("calibrate b")
    assert manager.shutdown()
