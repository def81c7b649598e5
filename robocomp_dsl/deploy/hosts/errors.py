"""Errors of connections to hosts. In: what happened. Out: texts that are ready for a finding."""

from __future__ import annotations

from robocomp_dsl.deploy.hosts import codes
from robocomp_dsl.diagnostics import Code

ANY_FILE = "APP.ddsl"
"""Stands for the deployment's file in `HostError.help`."""
_STATES = {
    codes.UNREACHABLE.id: "unreachable",
    codes.LOGIN.id: "login refused",
    codes.UNKNOWN_KEY.id: "unknown key",
    codes.CHANGED_KEY.id: "changed key",
}


class HostError(Exception):
    """A host cannot be used; the message begins with the host, `help` says what to do."""

    def __init__(self, message: str, help: str = "", code: Code = codes.UNREACHABLE) -> None:
        super().__init__(message)
        self.message = message
        self.help = help
        self.code = code

    @property
    def state(self) -> str:
        """The error in two words, for tables."""
        return _STATES.get(self.code.id, "not usable")


class HostUnreachable(HostError):
    """Nothing answers at the address, or the connection was lost."""


class HostRefused(HostError):
    """The host answers, but its key, the login or the request was refused."""

    def __init__(self, message: str, help: str = "", code: Code = codes.LOGIN) -> None:
        super().__init__(message, help, code)


class HostTimeout(HostError):
    """A command did not end in time; it may still run."""


class HostWriteError(HostError):
    """A file of the host cannot be read or written."""

    def __init__(self, message: str, help: str = "", code: Code = codes.DISK) -> None:
        super().__init__(message, help, code)
