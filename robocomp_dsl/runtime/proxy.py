"""The base of the generated proxies: typed methods in front of what a middleware bound.

In: a link of a middleware. Out: an object with the operations of the interface as methods.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

from robocomp_dsl.runtime.interface import Interface, Operation
from robocomp_dsl.runtime.middleware.base import Link


class Proxy:
    """What a component calls. Every call may raise a `MiddlewareError`.

    An operation of the interface that has the name of a method here wins.
    """

    __slots__ = ("_link",)
    INTERFACE: ClassVar[Interface]

    def __init__(self, link: Link) -> None:
        self._link = link
        self._bind(link.bind)

    def _bind(self, bind: Callable[[Operation], Callable[..., Any]]) -> None:
        """Fill the slots of the operations."""

    def wait_for_server(self, timeout: float) -> bool:
        """Whether somebody is there, waiting up to `timeout` s for it."""
        return self._link.wait(timeout)

    def is_heard(self) -> bool:
        """Whether anybody would get a publication now; it costs less than making one."""
        return self._link.heard()

    def set_timeout(self, seconds: float) -> None:
        """How long a call may take before it raises `Timeout`."""
        self._link.timeout = seconds
