"""Topics of IceStorm: a port is connected to its topic in the background, and again when needed.

In: the proxy of the TopicManager, the name of a topic, and what to do with the topic. Out: a thread
that retries until it succeeds, and looks from time to time whether the topic still exists.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from typing import Any

import Ice

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.ice.client import parse_proxy
from robocomp_dsl.runtime.middleware.ice.communicator import reason

MANAGER = "IceStorm/TopicManager:tcp -h localhost -p 9999"
"""The TopicManager of RoboComp's `rcnode`, used if no setting names another."""
RETRY_S = 1.0
CHECK_S = 3.0
_CALL_TIMEOUT_MS = 2000
log = logging.getLogger("robocomp")


class TopicLink:
    """Keeps one port connected to one topic. `connect` gets the topic, and may be called again.

    `owner` is the port, for messages.
    """

    def __init__(
        self,
        communicator: Any,
        manager: str,
        topic: str,
        owner: str,
        connect: Callable[[Any], None],
    ) -> None:
        import IceStorm  # noqa: PLC0415 - a part of Ice that few components need

        self._ice_storm = IceStorm
        self.topic = topic
        self.connected = threading.Event()
        self._manager_text = manager
        self._owner = owner
        self._connect = connect
        proxy = parse_proxy(communicator, manager, "the TopicManager of IceStorm")
        limited = proxy.ice_invocationTimeout(_CALL_TIMEOUT_MS)
        self._manager = IceStorm.TopicManagerPrx.uncheckedCast(limited)
        self._problem = ""
        self._wakeup = threading.Event()
        self._closed = False
        self._thread = threading.Thread(target=self._run, name=f"{owner}.icestorm", daemon=True)
        self._thread.start()

    def check(self) -> None:
        """Look now whether the topic still exists, because sending failed."""
        self.connected.clear()
        self._wakeup.set()

    def _run(self) -> None:
        while not self._closed:
            try:
                self._connect(self._find())
            except (Ice.Exception, MiddlewareError) as error:
                self.connected.clear()
                self._report(error)
                self._wakeup.wait(RETRY_S)
            else:
                self._report(None)
                self.connected.set()
                self._wakeup.wait(CHECK_S)
            self._wakeup.clear()

    def _find(self) -> Any:
        """The topic, created if nobody did."""
        storm = self._ice_storm
        try:
            topic = self._manager.retrieve(self.topic)
        except storm.NoSuchTopic:
            try:
                topic = self._manager.create(self.topic)
            except storm.TopicExists:  # another program was faster
                topic = self._manager.retrieve(self.topic)
        return storm.TopicPrx.uncheckedCast(topic.ice_invocationTimeout(_CALL_TIMEOUT_MS))

    def _report(self, error: Exception | None) -> None:
        """Log a new problem, or its end."""
        problem = "" if error is None or self._closed else reason(error)
        if problem and problem != self._problem:
            log.warning(
                "%s is not connected to the topic %s: IceStorm at `%s`: %s; trying again."
                " Start IceStorm, or name another TopicManager: --transport 'ice.TopicManager=…'",
                *(self._owner, self.topic, self._manager_text, problem),
            )
        elif self._problem and not problem and not self._closed:
            log.info("%s is connected to the topic %s", self._owner, self.topic)
        self._problem = problem

    def close(self) -> None:
        """End the thread; it may still wait for IceStorm."""
        self._closed = True
        self._wakeup.set()
        self._thread.join(_CALL_TIMEOUT_MS / 1000)
