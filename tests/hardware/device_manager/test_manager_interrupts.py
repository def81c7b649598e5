"""Interrupts, aborts and restarts of a device manager."""

from __future__ import annotations

import threading

from robocomp_dsl.hardware.device_manager.description import Phase
from tests.hardware.device_manager.device_journal import ARM, LONG, DeviceJournal, device


def test_device_manager_interrupt_stops_blocked_startup():
    journal = DeviceJournal()
    manager = journal.manager(
        devices=[device("arm", "driver"), device("s", "slow")],
        attach={"s": "arm"},
        actions=[
            {"phase": "startup", "level": 1, "calibrate": "arm"},
            {"phase": "startup", "level": 2, "detach": "s"},
        ],
    )
    result = []
    starter = threading.Thread(target=lambda: result.append(manager.start()))
    starter.start()
    assert journal.started.wait(LONG)
    manager.interrupt()
    starter.join(LONG)
    assert result == [False]
    assert manager.phase is Phase.INTERRUPT1
    manager.shutdown()
    assert journal.entries[3:] == ["calibrate arm", "stopped arm", "s off", "close s", "close arm"]


def test_device_manager_handles_three_interrupts_and_second_does_not_wait():
    journal = DeviceJournal()
    manager = journal.manager(
        devices=[device("arm", "driver"), device("s", "slow"), device("z", "calibrator")],
        attach={"s": "arm", "z": "arm"},
        actions=[
            {"phase": "interrupt1", "level": 1, "park": "arm", "by": "s"},
            {"phase": "interrupt1", "level": 2, "park": "arm", "by": "z"},
            {"phase": "interrupt2", "level": 1, "detach": "z"},
        ],
    )
    assert not manager.interrupt()  # nothing runs yet
    assert manager.start()
    first = []
    patient = threading.Thread(target=lambda: first.append(manager.interrupt()))
    patient.start()
    assert journal.started.wait(LONG)
    manager.interrupt()  # comes through while the parking of the first still hangs
    assert manager.phase is Phase.INTERRUPT2
    assert journal.entries[-1] == "z off"
    patient.join(LONG)
    assert first == [False]
    manager.interrupt()
    assert manager.phase is Phase.INTERRUPT3
    assert not manager.interrupt()  # there is no fourth
    journal.released.set()
    manager.shutdown()
    assert journal.entries.count("park arm") == 1  # level 2 of the first did not begin
    assert journal.entries[-1] == "close arm"


def test_device_manager_abort_ends_running_actions():
    journal = DeviceJournal()
    manager = journal.manager(
        devices=[device("arm", "driver"), device("s", "slow")],
        attach={"s": "arm"},
        actions=[
            {"phase": "startup", "level": 1, "calibrate": "arm"},
            {"phase": "startup", "level": 1, "abort": "arm"},
        ],
    )
    assert not manager.start()
    assert "stopped arm" in journal.entries
    manager.shutdown()


def test_device_manager_starts_devices_again():
    journal = DeviceJournal()
    manager = journal.manager(devices=ARM, attach={"zero": "arm"})
    assert manager.start()
    assert manager.shutdown()
    first = journal.entries[:]
    assert manager.start()
    assert manager.shutdown()
    assert journal.entries == first * 2
