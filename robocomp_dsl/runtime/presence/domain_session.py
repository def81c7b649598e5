"""Opens a session in a domain: between the processes of one machine, or through a router.

In: a domain. Out: an open zenoh session. With `NetworkSettings` it is a client of the router of its
host. Otherwise the domain is a folder of sockets, for the processes of one user on one machine:
each process listens on a socket in the folder and connects to all members before it. Connections
are made in the background: a peer that does not respond is tried again until it does, and delays
nobody. There is no multicast and no TCP port, unless a port is requested, which is bound to
loopback. Every peer proves that it knows the token of the user.
"""

from __future__ import annotations

import json
import socket
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import zenoh

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.file_lock import FileLock
from robocomp_dsl.runtime.presence.client_session import open_client_session
from robocomp_dsl.runtime.presence.close_session import close_client_session, close_session
from robocomp_dsl.runtime.presence.domain_folder import Membership, join
from robocomp_dsl.runtime.presence.domain_names import NameTaken, claim_component
from robocomp_dsl.runtime.presence.network_settings import NetworkSettings, find_network_settings
from robocomp_dsl.runtime.presence.router_watch import RouterWatch, TokenCallback
from robocomp_dsl.runtime.private_folder import USER, UnsafeFolder, read_token, token_file

_WAIT_BEFORE_DROP_US = "transport/link/tx/queue/congestion_control/drop/wait_before_drop"
CONNECT_WAIT_MS = 250
"""The start waits this long for peers to respond; usually all do within 5 ms."""
HANDSHAKE_TIMEOUT_MS = 3000
"""Deadline of one attempt to connect, at both ends; the next attempt follows."""


@dataclass(frozen=True, slots=True)
class DomainSession:
    """A session, the socket that it listens on, and the component's claim on its name.

    `membership` is None, and `network` and `routers` are not, if the session is a client of a
    router.
    """

    session: zenoh.Session
    membership: Membership | None
    name: FileLock | None = None
    port: int = 0
    network: NetworkSettings | None = None
    routers: RouterWatch | None = None
    subscribers: list[Any] = field(default_factory=list)

    @property
    def socket(self) -> Path:
        """The socket that a session without network listens on."""
        assert self.membership  # noqa: S101 - the caller has asked for a session without network
        return self.membership.socket

    def watch_tokens(self, key: str, on_token: TokenCallback) -> None:
        """Report the liveliness tokens of a key expression, those that exist first.

        A token is not lost because a router is away.
        """
        if self.routers:
            self.routers.watch(key, on_token)
            return

        def on_sample(sample: zenoh.Sample) -> None:
            on_token(str(sample.key_expr), sample.kind != zenoh.SampleKind.DELETE)

        self.subscribers.append(
            self.session.liveliness().declare_subscriber(key, on_sample, history=True)
        )

    def close(self) -> None:
        """Close the session and delete the socket; the last process also deletes the folder."""
        if self.membership:
            close_session(self.session, self.socket, self.port)
        else:
            close_client_session(self.session)
        if self.routers:
            self.routers.close()
        if self.name:
            self.name.release(delete=True)
        if self.membership:
            self.membership.leave()


def open_session(
    domain: str,
    port: int = 0,
    name: str = "",
    *,
    hold_s: float = 0.0,
    network: NetworkSettings | None = None,
) -> DomainSession:
    """Open a session in `domain`, which also listens on TCP `port` of loopback if not 0.

    With `name`, the session is that of a component, which no other component of the domain may be
    called. `hold_s`: how long a peer that receives nothing may hold a publication; 0: the default
    of zenoh. `network`: that of another session of this program; otherwise it is looked for.

    Raises `MiddlewareError` if the name is taken, or the folder, the port or the router cannot be
    used.
    """
    network = network or find_network_settings(domain)
    if network and port:
        raise MiddlewareError(
            f"port {port} cannot be used: in a network of hosts only routers listen; remove `port`"
            " from the component"
        )
    try:
        lock = claim_component(domain, name) if name else None
    except (NameTaken, UnsafeFolder, OSError) as error:
        raise MiddlewareError(str(error)) from None
    membership: Membership | None = None
    try:
        if network:
            session = open_client_session(network, hold_s=hold_s)
            return DomainSession(session, None, lock, network=network, routers=RouterWatch(session))
        membership, others = join(domain)
        session = _open(membership.socket, others, port, hold_s)
    except (UnsafeFolder, MiddlewareError) as error:
        if lock:
            lock.release(delete=True)
        if membership:
            membership.leave()
        raise MiddlewareError(str(error)) from None
    return DomainSession(session, membership, lock, port)


def _open(own: Path, others: list[Path], port: int, hold_s: float) -> zenoh.Session:
    listen = [f"unixsock-stream/{own}"]
    if port:
        _check_port_free(port)
        listen.append(f"tcp/127.0.0.1:{port}")
    config = _config(listen, [f"unixsock-stream/{path}" for path in others], own.parent.parent)
    if hold_s:
        config.insert_json5(_WAIT_BEFORE_DROP_US, str(round(hold_s * 1e6)))
    try:
        return zenoh.open(config)
    except zenoh.ZError as error:
        raise MiddlewareError(f"zenoh cannot listen at {', '.join(listen)}: {error}") from None


def _config(listen: list[str], connect: list[str], user_folder: Path) -> zenoh.Config:
    config = zenoh.Config()
    settings: dict[str, Any] = {
        "mode": "peer",
        "listen/endpoints": listen,
        "connect/endpoints": connect,
        # -1: connect in the background, and again after a failure.
        "connect/timeout_ms": -1,
        "connect/exit_on_failure": False,
        # A member that has joined may not listen yet.
        "connect/retry": {
            "period_init_ms": 10,
            "period_max_ms": 2000,
            "period_increase_factor": 2,
        },
        "open/return_conditions/connect_scouted": True,
        # With gossip off, declarations would be waited for until the delay is over.
        "open/return_conditions/declares": False,
        "scouting/delay": CONNECT_WAIT_MS,
        "transport/unicast/open_timeout": HANDSHAKE_TIMEOUT_MS,
        "transport/unicast/accept_timeout": HANDSHAKE_TIMEOUT_MS,
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
        "transport/auth/usrpwd/user": USER,
        "transport/auth/usrpwd/password": read_token(user_folder),
        "transport/auth/usrpwd/dictionary_file": str(token_file(user_folder)),
    }
    for key, value in settings.items():
        config.insert_json5(key, json.dumps(value))
    return config


def _check_port_free(port: int) -> None:
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", port))
        except OSError as error:
            raise MiddlewareError(
                f"port {port} cannot be used: {error.strerror}; use another port, or none"
            ) from None
