"""Starts and stops the components of a group in one process.

In: the members. Out: the exit code when all have ended. Members start when those after which they
start are ready, and stop in the reverse order. The failure of one ends all.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from queue import SimpleQueue

from robocomp_dsl.runtime.component.sd_notify import SystemdNotifier
from robocomp_dsl.runtime.component.supervisor_pipe import SupervisorPipe
from robocomp_dsl.runtime.group_process.arguments import GroupArguments
from robocomp_dsl.runtime.group_process.group_member import GroupMember
from robocomp_dsl.runtime.group_process.group_supervision import GroupSupervision

STOP_TIMEOUT_S = 4.8
"""Time for all members to end; below the grace period of rcdeploy."""
ORDER_TIMEOUT_S = 2.0
"""Of that, time in which a member may delay the stop of those that started before it."""
log = logging.getLogger("robocomp")


class RunningGroup:
    """The members of one process; `stop` may be called from any thread."""

    def __init__(self, arguments: GroupArguments) -> None:
        self.name = arguments.name
        self._events: SimpleQueue[GroupMember | None] = SimpleQueue()
        self._members = [GroupMember(each, self._events.put) for each in arguments.members]
        names = [member.name for member in self._members]
        self._supervision = GroupSupervision(names, SystemdNotifier(), SupervisorPipe())
        self._is_stopping = False
        self.failed = False

    @property
    def abandoned(self) -> bool:
        """Whether a thread of a member hangs."""
        return any(not m.ended.is_set() or m.abandoned for m in self._members)

    def stop(self) -> None:
        """Request the end."""
        self._events.put(None)

    def run(self) -> int:
        """Run until all members have ended; returns the exit code."""
        for member in self._members:
            if self._is_stopping or self.failed:
                member.ended.set()
                continue
            member.load(self._supervision.of_member(member.name, self._on_ready(member)))
            self._handle_events()
        self._warn_of_shared_folder()
        self._start_next()
        while not all(member.ended.is_set() for member in self._members):
            self._handle(self._events.get())
        self._handle_events()
        return 1 if self.failed else 0

    def _on_ready(self, member: GroupMember) -> Callable[[], None]:
        def on_ready() -> None:
            if not member.ready.is_set():
                member.ready.set()
                self._start_next()

        return on_ready

    def _start_next(self) -> None:
        """Start the members that wait for nobody."""
        ready = {member.name for member in self._members if member.ready.is_set()}
        for member in self._members:
            if ready.issuperset(member.after):
                member.start()

    def _handle_events(self) -> None:
        while not self._events.empty():
            self._handle(self._events.get())

    def _handle(self, ended: GroupMember | None) -> None:
        if ended is not None:
            self._supervision.ended(ended.name)
            if not ended.failed:
                self._on_ended(ended)
                return
            if not self.failed:
                self.failed = True
                log.error("%s failed; the group %s ends with it", ended.name, self.name)
        if not self._is_stopping:
            self._is_stopping = True
            self._stop_members()

    def _on_ended(self, member: GroupMember) -> None:
        """A member that ended by itself has been ready for those after it."""
        member.ready.set()
        self._start_next()

    def _stop_members(self) -> None:
        """Stop the members, the last one that started first."""
        begun = time.monotonic()
        started = [member for member in self._members if member.loaded.is_set()]
        for count, member in enumerate(reversed(started), start=1):
            member.stop()
            # Each gets its share of the time that is left.
            left = begun + ORDER_TIMEOUT_S - time.monotonic()
            member.ended.wait(max(left, 0.0) / max(len(started) - count, 1))
        for member in started:
            if not member.ended.wait(max(begun + STOP_TIMEOUT_S - time.monotonic(), 0.0)):
                log.error("%s did not end within %g s", member.name, STOP_TIMEOUT_S)
                self.failed = True
                member.ended.set()

    def _warn_of_shared_folder(self) -> None:
        if not self._is_stopping and not all(m.has_own_folder for m in self._members):
            log.warning(
                "the components have no working folders of their own, because `unshare` is not"
                " allowed here: relative paths start at the working folder of the process"
            )
