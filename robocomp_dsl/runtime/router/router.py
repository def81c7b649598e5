"""The router of one host: connects its components and other routers, with access control.

In: `RouterSettings`. Out: an open router; a log line for each link and each refusal.
"""

from __future__ import annotations

import errno
import json
import logging
import socket
from typing import Any

import zenoh

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.presence.close_session import close_client_session
from robocomp_dsl.runtime.presence.keys import ROUTER_KEY, escape_chunk
from robocomp_dsl.runtime.presence.network_settings import parse_endpoint
from robocomp_dsl.runtime.presence.tls_settings import (
    RETRY,
    base_settings,
    drop_settings,
    tls_settings,
)
from robocomp_dsl.runtime.router.refusals import RefusalLog
from robocomp_dsl.runtime.router.router_settings import RELOADED, RouterSettings
from robocomp_dsl.runtime.router.zenoh_log import ZenohLog

log = logging.getLogger("robocomp.router")
MAX_LINKS = 10000
HOLD_S, HOLD_LARGE_S = 0.05, 0.5
"""How long a link that takes nothing may hold messages; 64 MB take 0.2 s over loopback."""


class Router:
    """One running router. Raises `MiddlewareError` if it cannot listen."""

    def __init__(self, settings: RouterSettings) -> None:
        for endpoint in settings.listen:
            check_can_listen(endpoint)
        self._settings = settings
        self._refusals = RefusalLog()
        ZenohLog(self._refusals.on_denial, self._refusals.on_warning)
        self._open(settings)

    def _open(self, settings: RouterSettings) -> None:
        self._session = _open_session(settings)
        key = f"{ROUTER_KEY}/{escape_chunk(settings.name)}"
        self._token = self._session.liveliness().declare_token(key)
        listener = self._session.info.declare_link_events_listener
        self._links = listener(self._on_link, history=True)

    def _on_link(self, event: zenoh.LinkEvent) -> None:
        link = event.link
        name = link.auth_identifier or "a program without certificate"
        if event.kind == zenoh.SampleKind.PUT:
            self._refusals.add_name(str(link.zid), name)
            log.info("%s is connected (%s)", name, link.dst)
        else:
            log.info("%s is no longer connected (%s)", name, link.dst)

    def reload(self, settings: RouterSettings) -> None:
        """Use new settings; clients connect again by themselves. Raises `MiddlewareError`.

        If the new settings cannot be used, the former are used again.
        """
        for endpoint in settings.listen:
            if endpoint not in self._settings.listen:
                check_can_listen(endpoint)
        self.close()
        try:
            self._open(settings)
        except MiddlewareError:
            self._open(self._settings)
            raise
        self._settings = settings
        log.info("%s, listens at %s", RELOADED, ", ".join(settings.listen))

    def close(self) -> None:
        """Close all links."""
        close_client_session(self._session)


def check_can_listen(endpoint: str) -> None:
    """Raise `MiddlewareError` if the address is not one of this host, or the port is in use."""
    host, port = parse_endpoint(endpoint, "listen")
    try:
        addresses = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)
    except OSError as error:
        raise MiddlewareError(
            f"the router cannot listen at {host}: no such host name ({error.strerror or error});"
            " correct `address` of the host in the DDSL file"
        ) from None
    for family, kind, protocol, _, address in addresses:
        with socket.socket(family, kind, protocol) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind(address)
                probe.listen()
            except OSError as error:
                raise MiddlewareError(_bind_failure(host, port, error)) from None


def _bind_failure(host: str, port: int, error: OSError) -> str:
    place = f"the router cannot listen at {host} port {port}"
    match error.errno:
        case errno.EADDRINUSE:
            return (
                f"{place}: another program uses the port; stop it (`ss -ltnp` shows it), or give"
                " the host another one in the DDSL file: port N;"
            )
        case errno.EADDRNOTAVAIL:
            return (
                f"{place}: this host does not have the address; correct `address` of the host in"
                " the DDSL file, or wait until its network is up"
            )
        case _:
            return f"{place}: {error.strerror or error}"


def _open_session(settings: RouterSettings) -> zenoh.Session:
    config = zenoh.Config()
    for key, value in _zenoh_settings(settings).items():
        config.insert_json5(key, json.dumps(value))
    try:
        return zenoh.open(config)
    except zenoh.ZError as error:
        places = ", ".join(settings.listen)
        raise MiddlewareError(f"the router cannot listen at {places}: {error}") from None


def _zenoh_settings(settings: RouterSettings) -> dict[str, Any]:
    files = settings.files
    return {
        "mode": "router",
        "listen/endpoints": list(settings.listen),
        "listen/exit_on_failure": True,
        "connect/endpoints": list(settings.connect),
        # -1: connect in the background, and again after a failure.
        "connect/timeout_ms": -1,
        "connect/exit_on_failure": False,
        "connect/retry": RETRY,
        "transport/unicast/max_sessions": MAX_LINKS,
        "access_control": settings.access,
        **base_settings(),
        **drop_settings(HOLD_S, HOLD_LARGE_S),
        **tls_settings(files.ca, files.certificate, files.key, listen=True),
    }
