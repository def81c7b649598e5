"""Publications over `local`: no subscriber holds the publisher, and all use the same memory."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.middleware.local import subscriber_socket
from tests.middleware.local.direct import FRAMES, Side, open_descriptors
from tests.middleware.probe_types import NEWS, OTHER_NEWS
from tests.support.waiting import wait_until

Open = Callable[[str], Side]
PIXELS = np.zeros(200_000, np.uint8)


class Slow:
    """A handler that waits for `free`."""

    def __init__(self) -> None:
        self.free = threading.Event()
        self.entered = threading.Event()
        self.numbers: list[int] = []

    def announced(self, _who: str, number: int) -> None:
        self.entered.set()
        self.free.wait(60)
        self.numbers.append(number)

    def taken(self, number: int, _pixels: object) -> None:
        self.announced("", number)


def test_publications_arrive_in_order(side: Open) -> None:
    received: list[int] = []
    qos = Qos(reliable=True)
    record = side("s").subscribe({"announced": lambda _who, n: received.append(n)}, NEWS, qos)
    publish = side("p").publisher(NEWS, record, qos=qos)
    for number in range(2000):
        publish("announced", "p", number)
    wait_until(lambda: len(received) == 2000)
    assert received == list(range(2000))


def test_small_and_large_publications_stay_in_order(side: Open) -> None:
    received: list[tuple[int, int]] = []

    def taken(number: int, pixels: np.ndarray) -> None:
        received.append((number, pixels.size))

    publish = side("p").publisher(FRAMES, side("s").subscribe({"taken": taken}, FRAMES))
    sizes = [200_000 if n % 3 == 0 else n for n in range(200)]
    for number, size in enumerate(sizes):
        publish("taken", number, PIXELS[:size])
    wait_until(lambda: len(received) == len(sizes))
    assert received == list(enumerate(sizes))


def test_three_subscribers_use_the_memory_that_was_written_once(side: Open) -> None:
    received: list[np.ndarray] = []
    subscribers = [
        side(f"s{n}").subscribe({"taken": lambda _n, pixels: received.append(pixels)}, FRAMES)
        for n in range(3)
    ]
    side("p").publisher(FRAMES, *subscribers)("taken", 0, PIXELS + 7)
    wait_until(lambda: len(received) == 3)
    assert len({mapped_file(array) for array in received}) == 1
    assert all(np.array_equal(array, PIXELS + 7) for array in received)


def mapped_file(array: np.ndarray) -> str:
    """The inode of the memory file that an array is a view of."""
    address = array.__array_interface__["data"][0]
    for mapping in Path("/proc/self/maps").read_text().splitlines():
        begin, end = (int(part, 16) for part in mapping.split()[0].split("-"))
        if begin <= address < end:
            assert "memfd:robocomp" in mapping
            return mapping.split()[4]
    raise AssertionError("not mapped")


def test_arrays_that_a_subscriber_keeps_do_not_change(side: Open) -> None:
    arrays: list[np.ndarray] = []
    record = side("s").subscribe({"taken": lambda _n, pixels: arrays.append(pixels)}, FRAMES)
    publish = side("p").publisher(FRAMES, record)
    for number in range(40):
        publish("taken", number, PIXELS + number)
        wait_until(lambda number=number: len(arrays) > number)
        if number % 2:
            arrays[number] = PIXELS[:1]  # releases the message
    assert all(set(array) == {n} for n, array in enumerate(arrays) if n % 2 == 0)


@pytest.mark.parametrize(("interface", "depth"), [(NEWS, None), (NEWS, 3), (FRAMES, None)])
def test_slow_subscriber_does_not_hold_the_publisher(
    side: Open, interface: object, depth: int | None
) -> None:
    slow, publisher = Slow(), side("p")
    name = interface.operations[0].name
    record = side("s").subscribe({name: getattr(slow, name)}, interface, Qos(depth=depth))
    publish = publisher.publisher(interface, record)
    first = ("p", 0) if interface is NEWS else (0, PIXELS)
    publish(name, *first)
    slow.entered.wait(60)
    longest = 0.0
    for number in range(1, 2000):
        values = ("p", number) if interface is NEWS else (number, PIXELS)
        start = time.thread_time()  # its own time: the machine may be busy
        publish(name, *values)
        longest = max(longest, time.thread_time() - start)
    assert longest < 0.05
    counts = publisher.count(name, interface)
    assert counts.drops > 0
    slow.free.set()
    wait_until(lambda: slow.numbers and slow.numbers[-1] == 1999)
    assert slow.numbers == sorted(slow.numbers)
    assert depth or len(slow.numbers) + counts.drops == 2000


def test_queue_of_large_messages_is_limited_in_bytes(
    side: Open, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(subscriber_socket, "MAX_QUEUED_BYTES", 10 * PIXELS.nbytes)
    slow = Slow()
    publish = side("p").publisher(FRAMES, side("s").subscribe({"taken": slow.taken}, FRAMES))
    publish("taken", 0, PIXELS)
    slow.entered.wait(60)
    before = open_descriptors()
    for number in range(1, 200):
        publish("taken", number, PIXELS)
    assert open_descriptors() - before < 60
    slow.free.set()
    wait_until(lambda: slow.numbers[-1:] == [199])
    assert len(slow.numbers) < 25


def test_depth_of_the_subscriber_limits_the_queue_of_the_publisher(side: Open) -> None:
    slow = Slow()
    record = side("s").subscribe({"taken": slow.taken}, FRAMES, Qos(depth=2))
    publish = side("p").publisher(FRAMES, record)
    publish("taken", 0, PIXELS)
    slow.entered.wait(60)
    for number in range(1, 100):
        publish("taken", number, PIXELS)
    slow.free.set()
    wait_until(lambda: slow.numbers[-2:] == [98, 99])
    # In the socket were four, of which the receiver keeps two; then come those of the publisher.
    assert len(slow.numbers) <= 6


def test_subscriber_with_depth_takes_the_last_publications_of_a_publisher_that_closed(
    side: Open,
) -> None:
    slow, subscriber = Slow(), side("s")
    record = subscriber.subscribe({"taken": slow.taken}, FRAMES, Qos(depth=4))
    publish = side("p").publisher(FRAMES, record)
    publish("taken", 0, PIXELS)
    slow.entered.wait(60)
    publish("taken", 1, PIXELS)
    publish("taken", 2, PIXELS)
    publish.publisher.close()
    slow.free.set()
    wait_until(lambda: slow.numbers == [0, 1, 2])
    wait_until(lambda: "s.Frames" not in [thread.name for thread in threading.enumerate()])
    assert subscriber.failures == []


def test_reliable_publisher_waits_for_a_slow_subscriber(side: Open) -> None:
    slow = Slow()
    qos = Qos(reliable=True, depth=4)
    record = side("s").subscribe({"taken": slow.taken}, FRAMES, qos)
    publisher = side("p")
    publish = publisher.publisher(FRAMES, record, qos=qos)
    threading.Timer(0.2, slow.free.set).start()
    for number in range(100):
        publish("taken", number, PIXELS)
    wait_until(lambda: slow.numbers[-1:] == [99])
    if not publisher.count("taken", FRAMES).drops:  # a busy machine may take longer
        assert slow.numbers == list(range(100))


def test_reliable_subscriber_that_receives_nothing_holds_once(
    side: Open, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(subscriber_socket, "HOLD_S", 0.05)
    slow, qos, publisher = Slow(), Qos(reliable=True), side("p")
    record = side("s").subscribe({"taken": slow.taken}, FRAMES, qos)
    publish = publisher.publisher(FRAMES, record, qos=qos)
    with caplog.at_level(logging.WARNING):
        for number in range(50):
            publish("taken", number, PIXELS)
    drops = publisher.count("taken", FRAMES).drops
    assert drops > 40
    assert caplog.text.count("receives nothing and held Frames.taken") == 1
    slow.free.set()
    wait_until(lambda: len(slow.numbers) == 50 - drops)
    publish("taken", 50, PIXELS)
    wait_until(lambda: slow.numbers[-1] == 50)


def test_subscriber_that_has_closed_is_lost(side: Open) -> None:
    subscriber = side("s")
    record = subscriber.subscribe({"announced": lambda *_: None}, NEWS)
    publish = side("p").publisher(NEWS, record)
    assert publish.publisher.has_subscribers()
    subscriber.transport.close()

    def is_lost() -> bool:
        publish("announced", "p", 1)
        return not publish.publisher.has_subscribers()

    wait_until(is_lost)
    publish.publisher.detach(record)
    publish("announced", "p", 2)


def test_detached_subscriber_receives_nothing(side: Open) -> None:
    received: list[int] = []
    records = [
        side(name).subscribe({"announced": lambda _who, n: received.append(n)}, NEWS)
        for name in ("a", "b")
    ]
    publish = side("p").publisher(NEWS, *records)
    publish.publisher.attach(records[0])  # it is attached already
    publish("announced", "p", 1)
    wait_until(lambda: received == [1, 1])
    publish.publisher.detach(records[0])
    publish("announced", "p", 2)
    wait_until(lambda: received == [1, 1, 2])


def test_subscriber_with_another_interface_receives_nothing(side: Open) -> None:
    received: list[str] = []
    record = side("s").subscribe({"announced": received.append}, OTHER_NEWS)
    publish = side("p").publisher(NEWS, record)

    def is_lost() -> bool:
        publish("announced", "p", 1)
        return not publish.publisher.has_subscribers()

    wait_until(is_lost)
    assert not received


def test_publications_of_many_threads_arrive_once(side: Open) -> None:
    received: list[int] = []
    record = side("s").subscribe({"announced": lambda _who, n: received.append(n)}, NEWS)
    publish = side("p").publisher(NEWS, record)

    def work(first: int) -> None:
        for number in range(first, first + 20):
            publish("announced", "p", number)

    threads = [threading.Thread(target=work, args=(20 * n,)) for n in range(10)]
    for thread in threads:
        thread.start()
    wait_until(lambda: len(received) == 200)
    assert sorted(received) == list(range(200))


def test_connections_that_have_ended_leave_nothing(side: Open) -> None:
    received: list[int] = []
    subscriber = side("s")
    record = subscriber.subscribe({"announced": lambda _who, n: received.append(n)}, NEWS)
    publisher = side("p")
    before, threads = open_descriptors(), threading.active_count()
    for number in range(30):
        publish = publisher.publisher(NEWS, record)
        publish("announced", "p", number)
        publish.publisher.close()
    wait_until(lambda: len(received) == 30)
    wait_until(lambda: open_descriptors() <= before + 1)
    wait_until(lambda: threading.active_count() <= threads)


def test_publications_of_a_publisher_that_closes_at_once_arrive(side: Open) -> None:
    received: list[int] = []
    record = side("s").subscribe({"taken": lambda n, _pixels: received.append(n)}, FRAMES)
    publisher = side("p")
    for number in range(0, 40, 2):
        publish = publisher.publisher(FRAMES, record)
        publish("taken", number, PIXELS)
        publish("taken", number + 1, PIXELS[:9])
        publish.publisher.close()
    wait_until(lambda: len(received) == 40)
    assert sorted(received) == list(range(40))


def test_keep_all_queues_in_order_and_holds_when_full(
    side: Open, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(subscriber_socket, "HOLD_S", 0.05)
    slow, qos, publisher = Slow(), Qos(keep_all=True, depth=50), side("p")
    record = side("s").subscribe({"taken": slow.taken}, FRAMES, qos)
    publish = publisher.publisher(FRAMES, record, qos=qos)
    for number in range(50):
        publish("taken", number, PIXELS[: 200_000 * (number % 2)])
    assert publisher.count("taken", FRAMES).drops == 0
    for number in range(50, 500):
        publish("taken", number, PIXELS)
    drops = publisher.count("taken", FRAMES).drops
    assert drops > 300
    slow.free.set()
    wait_until(lambda: len(slow.numbers) == 500 - drops)
    assert slow.numbers[:50] == list(range(50))
    assert slow.numbers == sorted(slow.numbers)
    publish("taken", 500, PIXELS)
    wait_until(lambda: slow.numbers[-1] == 500)
