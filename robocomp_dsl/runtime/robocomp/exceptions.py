"""The names of `Ice` that workers use: exceptions, and `loadSlice`.

In: failed calls. Out: `except Ice.Exception` catches them.
"""

from __future__ import annotations

from types import SimpleNamespace

from robocomp_dsl.runtime.errors import DeclaredError, MiddlewareError, NoServer, Timeout

Ice = SimpleNamespace(
    Exception=(MiddlewareError, DeclaredError),
    LocalException=MiddlewareError,
    UserException=DeclaredError,
    ConnectionRefusedException=NoServer,
    ConnectFailedException=NoServer,
    ConnectionLostException=NoServer,
    ObjectNotExistException=NoServer,
    NoEndpointException=NoServer,
    TimeoutException=Timeout,
    loadSlice=lambda *_: None,
)
"""Types are generated, so `loadSlice` does nothing."""
