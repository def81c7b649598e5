"""Keeps a node registered with the ROS master, also after the master was restarted.

In: what the node publishes, receives and serves. Out: registrations; the publishers of subscribed
topics. A thread asks the master twice a second whether it still knows the node.
"""

from __future__ import annotations

import contextlib
import logging
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from robocomp_dsl.runtime.component.user_errors import describe_error
from robocomp_dsl.runtime.middleware.ros1.xmlrpc import RosApi, RosApiError

CHECK_S = 0.5
MASTER_S = 2.0
"""The master replies within this time."""
CLOSE_S = 0.5
log = logging.getLogger("robocomp")


@dataclass(slots=True)
class _Item:
    """`kind` as in the method `registerPublisher`; `on_publishers` takes what it returns."""

    kind: str
    name: str
    type: str
    on_publishers: Callable[[Sequence[str]], None] | None
    is_known: bool = False


class MasterRegistration:
    """All registrations of one node. `api_uri` is that of its interface."""

    def __init__(self, node: str, api_uri: str, service_uri: str, master: str) -> None:
        self._node = node
        self._api_uri = api_uri
        self._service_uri = service_uri
        self._master = master
        self._changed = threading.Condition()
        self._items: dict[tuple[str, str], _Item] = {}
        self._removed: list[_Item] = []
        self._pid: Any = None
        self._warned = False
        self._closed = self._stopped = False
        self._thread: threading.Thread | None = None
        self.on_master: Callable[[RosApi], None] = lambda _api: None
        """Called when a master has appeared that does not know the node yet."""
        self.on_check: Callable[[RosApi], None] = lambda _api: None
        """Called twice a second while the master replies."""

    def add(
        self,
        kind: str,
        name: str,
        type_: str,
        on_publishers: Callable[[Sequence[str]], None] | None = None,
    ) -> None:
        """Register a topic or service; returns at once."""
        with self._changed:
            self._items[kind, name] = _Item(kind, name, type_, on_publishers)
            self._start()
            self._changed.notify_all()

    def _start(self) -> None:
        if self._thread is None and not self._closed:
            name = f"ros1 {self._node} registration"
            self._thread = threading.Thread(target=self._run, name=name, daemon=True)
            self._thread.start()

    def start(self) -> None:
        """Look for the master, also without a registration."""
        with self._changed:
            self._start()

    def remove(self, kind: str, name: str) -> None:
        """Withdraw a registration; returns at once."""
        with self._changed:
            item = self._items.pop((kind, name), None)
            if item and item.is_known:
                self._removed.append(item)
            self._changed.notify_all()

    def _run(self) -> None:
        api = RosApi(self._master, MASTER_S)
        while True:
            try:
                self._check(api)
            except RosApiError as error:
                self._failed(error)
            except Exception as error:
                log.error(  # noqa: TRY400 - described
                    "%s: registration failed: %s", self._node, describe_error(error)
                )
            with self._changed:
                self._changed.wait_for(self._is_urgent, CHECK_S)
                if self._closed or self._stopped:
                    break
        if self._closed and not self._stopped:
            self._withdraw_all(api)
        api.close()

    def _is_urgent(self) -> bool:
        if self._closed or self._stopped:
            return True
        is_new = any(not item.is_known for item in self._items.values())
        return not self._warned and (is_new or bool(self._removed))

    def _check(self, api: RosApi) -> None:
        """Register what the master does not know. Raises `RosApiError`."""
        pid = api.call("getPid", self._node)
        if pid != self._pid or not self._is_registered(api):
            for item in self._items_now():
                item.is_known = False
            self._pid = pid
            self.on_master(api)
        if self._warned:
            self._warned = False
            log.info("%s: the ROS master %s replies", self._node, self._master)
        with self._changed:
            removed, self._removed = self._removed, []
        for item in removed:
            self._withdraw(api, item)
        for item in self._items_now():
            if not item.is_known:
                self._register(api, item)
        self.on_check(api)

    def _is_registered(self, api: RosApi) -> bool:
        """Whether the master knows the node, as far as it should."""
        if not any(item.is_known for item in self._items_now()):
            return True
        try:
            found = api.call("lookupNode", self._node, self._node)
        except RosApiError as error:
            if error.is_unreachable:
                raise
            return False
        return bool(found == self._api_uri)

    def _items_now(self) -> list[_Item]:
        with self._changed:
            return list(self._items.values())

    def _register(self, api: RosApi, item: _Item) -> None:
        of = self._service_uri if item.kind == "Service" else item.type
        found = api.call(f"register{item.kind}", self._node, item.name, of, self._api_uri)
        item.is_known = True
        if item.on_publishers and isinstance(found, list):
            item.on_publishers([str(uri) for uri in found])

    def _withdraw(self, api: RosApi, item: _Item) -> None:
        of = self._service_uri if item.kind == "Service" else self._api_uri
        api.call(f"unregister{item.kind}", self._node, item.name, of)

    def _failed(self, error: RosApiError) -> None:
        self._pid = None
        if self._warned:
            return
        self._warned = True
        log.warning(
            "%s: the ROS master %s: components find each other, programs of ROS do not find them."
            " Start the master with `roscore`, or set ros1.master or ROS_MASTER_URI",
            self._node,
            error,
        )

    def _withdraw_all(self, api: RosApi) -> None:
        with self._changed:
            items = [item for item in self._items.values() if item.is_known]
            items += self._removed
        if not self._warned:
            with contextlib.suppress(RosApiError):
                for item in items:
                    self._withdraw(api, item)

    def stop(self) -> None:
        """Register nothing more, and leave to the master what it knows."""
        with self._changed:
            self._stopped = True
            self._changed.notify_all()

    def close(self) -> None:
        """Withdraw all registrations."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()
            thread = self._thread
        if thread and thread is not threading.current_thread():
            thread.join(CLOSE_S)
