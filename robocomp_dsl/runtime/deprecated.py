"""Deprecated names that components of users may still use; each use warns once per call site."""

from __future__ import annotations

from typing import Protocol
from warnings import warn


def warn_deprecated(old: str, new: str, stacklevel: int = 3) -> None:
    """Warn the caller of the deprecated name `old` that it is now called `new`."""
    warn(f"`{old}` is deprecated; use `{new}`", DeprecationWarning, stacklevel=stacklevel)


class _Machine(Protocol):
    def send(self, event: str, **data: object) -> bool: ...


class _Proxy(Protocol):
    def has_subscribers(self) -> bool: ...


class _Clock(Protocol):
    @property
    def reset_count(self) -> int: ...
    @property
    def is_stale(self) -> bool: ...


class DeprecatedMachineNames:
    """Old names of `Machine`."""

    def go(self: _Machine, event: str, **data: object) -> bool:
        """Deprecated: use `send`."""
        warn_deprecated("machine.go", "machine.send")
        return self.send(event, **data)


class DeprecatedProxyNames:
    """Old names of `Proxy`."""

    __slots__ = ()

    def is_heard(self: _Proxy) -> bool:
        """Deprecated: use `has_subscribers`."""
        warn_deprecated("proxy.is_heard", "proxy.has_subscribers")
        return self.has_subscribers()


class DeprecatedClockNames:
    """Old names of clocks."""

    @property
    def epoch(self: _Clock) -> int:
        """Deprecated: use `reset_count`."""
        warn_deprecated("clock.epoch", "clock.reset_count")
        return self.reset_count

    @property
    def silent(self: _Clock) -> bool:
        """Deprecated: use `is_stale`."""
        warn_deprecated("clock.silent", "clock.is_stale")
        return self.is_stale
