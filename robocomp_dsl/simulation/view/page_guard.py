"""Access control of a page that is served on loopback: token, Host and Origin of each request.

In: the request that a browser sends. Out: the request without the token, or a refusal. Loopback is
open to all users of the machine and to every web page that a browser shows: the token in the path
keeps other users out, `Host` a name that an attacker points to 127.0.0.1 (DNS rebinding), `Origin`
pages of other servers.
"""

from __future__ import annotations

import hmac
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from http import HTTPStatus
from typing import Any
from urllib.parse import urlsplit

import websockets.asyncio.server as websocket_server
from websockets.datastructures import Headers
from websockets.http11 import Request, Response

LOOPBACK_NAMES = frozenset({"127.0.0.1", "localhost", "::1"})
_WRONG_PATH = "This page needs its token: open the URL that the command printed."
_OTHER_HOST = "This page is served to this machine only: open it as 127.0.0.1 or localhost."
_OTHER_ORIGIN = "Another page may not use this one."
_patching = threading.Lock()


class Unprotected(Exception):
    """The server did not install the guard; it was not opened."""


@dataclass(slots=True)
class PageGuard:
    """Guards the pages of one server. `installed`: it sees all requests."""

    token: str
    installed: bool = False

    def refusal(self, headers: Headers, path: str) -> str:
        """Why a request is refused; empty if it is not."""
        hosts, origins = headers.get_all("Host"), headers.get_all("Origin")
        if len(hosts) != 1 or _host_name(hosts[0]) not in LOOPBACK_NAMES:
            return _OTHER_HOST
        if any(origin != f"http://{hosts[0]}" for origin in origins):
            return _OTHER_ORIGIN
        if not hmac.compare_digest(_first_segment(path).encode(), self.token.encode()):
            return _WRONG_PATH
        return ""

    def check(self, request: Request) -> Response | None:
        """A refusal; None, with the token removed from the path, for a request that is allowed."""
        reason = self.refusal(request.headers, request.path)
        if reason:
            body = f"{reason}\n".encode()
            headers = Headers(
                {"Content-Type": "text/plain; charset=utf-8", "Content-Length": str(len(body))}
            )
            return Response(HTTPStatus.FORBIDDEN, "Forbidden", headers, body)
        rest = request.path.removeprefix(f"/{self.token}")
        request.path = rest if rest.startswith("/") else f"/{rest}"
        return None

    @contextmanager
    def install(self) -> Iterator[None]:
        """Guard the server that is opened in this block. Raises `Unprotected` at the end.

        viser has no setting for it; it opens its server by `websockets.asyncio.server.serve`, in
        another thread.
        """
        with _patching:
            serve = websocket_server.serve
            websocket_server.serve = self._guarded(serve)  # type: ignore[misc,assignment]
            try:
                yield
            finally:
                websocket_server.serve = serve  # type: ignore[misc]
        if not self.installed:
            raise Unprotected("this version of viser opens its server in another way")

    def _guarded(self, serve: Callable[..., Any]) -> Callable[..., Any]:
        def guarded_serve(*arguments: Any, process_request: Any = None, **options: Any) -> Any:
            def process(connection: Any, request: Request) -> Any:
                refusal = self.check(request)
                if refusal is not None or process_request is None:
                    return refusal
                return _without_referrer(process_request(connection, request))

            self.installed = True
            return serve(*arguments, process_request=process, **options)

        return guarded_serve


def _without_referrer(response: Response | None) -> Response | None:
    """Links on the page do not tell other servers its URL."""
    if response is not None:
        response.headers["Referrer-Policy"] = "no-referrer"
    return response


def _host_name(host: str) -> str:
    """The name of `name:port`, in lower case; empty if it is malformed."""
    try:
        return urlsplit(f"//{host}").hostname or ""
    except ValueError:
        return ""


def _first_segment(path: str) -> str:
    return path.partition("?")[0].removeprefix("/").partition("/")[0]
