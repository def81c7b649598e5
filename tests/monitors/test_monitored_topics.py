"""Monitors and arbitration of topics, in components that run."""

from __future__ import annotations

from tests.monitors.components import Deployment, Listener, Speaker
from tests.monitors.manual_clock import ManualClock
from tests.support.waiting import wait_until

LIMIT = """
    class Limit(Monitor):
        def __init__(self, max: int) -> None:
            self.max = max

        def accept_announced(self, who: str, n: int) -> bool:
            return n <= self.max

        def update(self, operation, arguments):
            who, n = arguments
            return f"{who} by {self.peer}", n * 2
    """
FACE = """
    class Face(Monitor):
        def accept_announced(self, who: str, n: int) -> bool:
            if n > 0:
                self.set_event("e_face", 2.0)
            return True
    """


def publish(speaker: object, listener: object, *numbers: int) -> None:
    """Publish numbers under the speaker's name, once the listener is connected."""
    proxy = speaker.worker.news_proxy
    wait_until(proxy.has_subscribers, "the listener is not connected")
    for number in numbers:
        proxy.announced(speaker.name, number)


def test_monitor_at_the_receiver_sees_its_connection_only(deployment: Deployment) -> None:
    deployment.write(LIMIT)
    entry = {"port": "News", "at": "receiver", "peer": "left.News"}
    monitors = [entry | {"monitors": [deployment.monitor("Limit", max=5)]}]
    left, right = (deployment.start(Speaker, name) for name in ("left", "right"))
    listener = deployment.start(Listener, "listener", monitors, peers=("left", "right.News"))
    publish(left, listener, 1, 9, 2)
    publish(right, listener, 9)
    heard = listener.worker.heard
    wait_until(lambda: len(heard) >= 3, lambda: f"heard {heard}")
    assert sorted(heard) == [("left by left.News", 2), ("left by left.News", 4), ("right", 9)]
    (status,) = listener.monitors.statuses()
    assert (status.passed, status.rejected, status.state) == (2, 1, "active")
    assert listener.statistics.of("News from left:News", "announced").calls == 3


def test_monitor_at_the_sender_changes_what_all_receivers_get(deployment: Deployment) -> None:
    deployment.write(LIMIT)
    monitor = deployment.monitor("Limit", max=5)
    peers = ("first.News", "second.News")
    monitors = [
        {"port": "News", "at": "sender", "peer": peer, "monitors": [monitor]} for peer in peers
    ]
    speaker = deployment.start(Speaker, "speaker", monitors)
    listeners = [
        deployment.start(Listener, name, peers=("speaker",)) for name in ("first", "second")
    ]
    proxy = speaker.worker.news_proxy

    def all_connected() -> bool:
        proxy.announced("probe", 0)
        return all(listener.worker.heard for listener in listeners)

    wait_until(all_connected, "a listener is not connected")
    proxy.announced("speaker", 6)
    proxy.announced("speaker", 5)
    last = ("speaker by first.News and second.News", 10)
    for listener in listeners:
        heard = listener.worker.heard
        wait_until(lambda heard=heard: heard[-1] == last, lambda heard=heard: f"heard {heard}")
        assert {n for _, n in heard} == {0, 10}


def test_arbitrated_topic_passes_the_winner_until_the_event_expires(
    deployment: Deployment,
) -> None:
    deployment.write(FACE)
    clock = ManualClock()
    monitors = [
        {
            "port": "News",
            "at": "receiver",
            "peer": "face.News",
            "when": "e_face",
            "monitors": [deployment.monitor("Face")],
        },
        {"port": "News", "at": "receiver", "peer": "explorer.News", "when": "not e_face"},
    ]
    face, explorer, other = (
        deployment.start(Speaker, name) for name in ("face", "explorer", "other")
    )
    listener = deployment.start(
        Listener, "gaze", monitors, peers=("face", "explorer", "other"), clock=clock
    )
    heard = listener.worker.heard
    seen = listener.monitors.statuses

    def judged(count: int) -> None:
        """Wait until so many messages were passed or rejected."""
        wait_until(lambda: sum(s.passed + s.rejected for s in seen()) == count)

    publish(explorer, listener, 1)
    judged(1)
    publish(face, listener, 0)  # no face: not the winner
    judged(2)
    publish(face, listener, 7)  # sets e_face for 2 s
    judged(3)
    publish(explorer, listener, 2)
    judged(4)
    assert {s.peer: s.is_winner for s in seen()} == {"face.News": True, "explorer.News": False}
    assert seen()[0].events == (("e_face", 2.0),)
    clock.time = 1.999
    publish(explorer, listener, 3)
    judged(5)
    clock.time = 2.0
    publish(face, listener, 0)
    judged(6)
    publish(explorer, listener, 4)
    judged(7)
    assert heard == [("explorer", 1), ("face", 7), ("explorer", 4)]
    assert [(s.passed, s.rejected) for s in seen()] == [(1, 2), (2, 2)]
    # A port that is arbitrated has no connection with others.
    assert not other.worker.news_proxy.has_subscribers()


def test_monitored_connection_of_a_namespace(quick_deployment: Deployment) -> None:
    quick_deployment.write(LIMIT)
    entry = {"port": "News", "at": "receiver", "peer": "speaker.News"}
    monitors = [entry | {"monitors": [quick_deployment.monitor("Limit", max=5)]}]
    speaker = quick_deployment.start(Speaker, "speaker", prefix="left")
    listener = quick_deployment.start(
        Listener, "listener", monitors, peers=("speaker",), prefix="left"
    )
    publish(speaker, listener, 3)
    heard = listener.worker.heard
    wait_until(lambda: heard)
    assert heard == [("left/speaker by left/speaker.News", 6)]
