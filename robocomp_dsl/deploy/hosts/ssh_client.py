"""Opening a connection with OpenSSH: which key the host has, and why a connection fails.

In: a host. Out: an open connection of asyncssh, or a `HostError` in the user's words. The settings
of `~/.ssh/config` count, except those that weaken the check of host keys.
"""

from __future__ import annotations

import asyncio
import errno
import logging
import socket
from typing import TYPE_CHECKING, Any

from robocomp_dsl.deploy.hosts import codes, known_hosts
from robocomp_dsl.deploy.hosts.address import describe_host, ssh_arguments
from robocomp_dsl.deploy.hosts.commands import CONNECT_SILENCE_S
from robocomp_dsl.deploy.hosts.errors import ANY_FILE, HostError, HostRefused, HostUnreachable
from robocomp_dsl.extras import MissingExtra
from robocomp_dsl.model.deployment import Host

try:
    import asyncssh
except ModuleNotFoundError as error:
    raise MissingExtra("a deployment over several hosts", "hosts", error) from None

if TYPE_CHECKING:
    from collections.abc import Callable

    from robocomp_dsl.deploy.hosts.known_hosts import KnownKey

KEEPALIVE_S = 5.0
KEEPALIVE_COUNT = 3
"""After `KEEPALIVE_S` of silence the host is asked to answer; after `KEEPALIVE_COUNT` questions
without an answer, the link is lost. TCP repeats a lost packet after about 0.4, 1.2, 2.8, 6 and 12 s
at a round trip of 0.2 s: a link that loses 10 % of all packets is not taken for cut."""

logging.getLogger("asyncssh").setLevel(logging.CRITICAL)  # errors are reported as findings


class HostKeyCheck(asyncssh.SSHClient):
    """Compares the key of a host with the confirmed keys; keeps what it has seen.

    `presented` is the key that the host showed and that is not confirmed; `known` are the confirmed
    keys of the host, which the files know as `id`. `lost` is why the connection ended. `progress`
    is called with each step of the login that the host has answered.
    """

    def __init__(self, progress: Callable[[], object] = lambda: None) -> None:
        self.progress = progress
        self.id = ""
        self.known: list[KnownKey] = []
        self.presented: asyncssh.SSHKey | None = None
        self.lost: Exception | None = None
        self._connection: asyncssh.SSHClientConnection | None = None

    def connection_made(self, conn: asyncssh.SSHClientConnection) -> None:
        """Keep the connection, which knows an accepted key."""
        self._connection = conn
        self.progress()

    def begin_auth(self, *_: Any) -> None:
        """The keys are exchanged."""
        self.progress()

    def auth_completed(self) -> None:
        """The user is logged in."""
        self.progress()

    def lookup(self, host: str, address: str, port: int | None) -> Any:
        """The confirmed keys, for asyncssh; `port` None: that of SSH."""
        self.id = known_hosts.host_id(host, port or known_hosts.DEFAULT_PORT)
        self.known = known_hosts.find_keys(host, address, port or known_hosts.DEFAULT_PORT)
        return known_hosts.asyncssh_keys(self.known)

    @property
    def has_seen_no_key(self) -> bool:
        """Whether the host may have no key of the kind of the confirmed keys."""
        key = self._connection.get_server_host_key() if self._connection else None
        return bool(self.known) and self.presented is None and key is None

    def validate_host_public_key(self, *server: Any) -> bool:
        """Refuse a key that is not confirmed: the last of `host`, `address`, `port` and `key`."""
        self.presented = server[-1]
        return False

    def connection_lost(self, exc: Exception | None) -> None:
        """Keep the reason."""
        self.lost = exc


async def open_connection(
    host: Host, check: HostKeyCheck, silence_s: float = CONNECT_SILENCE_S
) -> asyncssh.SSHClientConnection:
    """Connect and log in. Raises `HostUnreachable` or `HostRefused`.

    A host that does not answer a step of the login within `silence_s` seconds is out of reach; a
    slow one may take longer for all steps.
    """
    try:
        async with asyncio.timeout(silence_s) as limit:
            clock = asyncio.get_running_loop().time
            check.progress = lambda: limit.reschedule(clock() + silence_s)
            try:
                return await _try_kinds_of_keys(host, check)
            finally:
                check.progress = lambda: None
    except TimeoutError as error:
        if not limit.expired():  # the kernel's
            raise describe_error(host, check, error) from None
        text = f"{describe_host(host)}: no answer within {silence_s:g} s"
        raise HostUnreachable(text, _reachability_help(host)) from None
    except (OSError, ValueError, asyncssh.Error) as error:
        raise describe_error(host, check, error) from None


async def _try_kinds_of_keys(host: Host, check: HostKeyCheck) -> asyncssh.SSHClientConnection:
    try:
        return await _connect(host, check)
    except (ConnectionError, asyncssh.ConnectionLost, asyncssh.KeyExchangeFailed):
        if not check.has_seen_no_key:
            raise
    # Only kinds of confirmed keys were accepted; now the host shows another, which is refused.
    return await _connect(host, check, server_host_key_algs="default")


async def _connect(host: Host, check: HostKeyCheck, **options: Any) -> asyncssh.SSHClientConnection:
    if host.ssh_port:
        options["port"] = host.ssh_port
    if host.user:
        options["username"] = host.user
    return await asyncssh.connect(
        host.address,
        client_factory=lambda: check,
        known_hosts=check.lookup,
        x509_trusted_certs=None,
        password_auth=False,
        kbdint_auth=False,
        gss_kex=False,  # it proves the host by Kerberos instead of its key
        ignore_encrypted=True,
        keepalive_interval=KEEPALIVE_S,
        keepalive_count_max=KEEPALIVE_COUNT,
        connect_timeout=None,  # `open_connection` has a limit for each step
        **options,
    )


def describe_error(host: Host, check: HostKeyCheck, error: Exception) -> HostError:
    """Why `host` cannot be used, and what to do."""
    name = describe_host(host)
    match error:
        case OSError() | asyncssh.ConnectionLost():
            return _network_error(name, host, error)
        case asyncssh.ConfigParseError():
            text = f"{name}: ~/.ssh/config has an error: {error}"
            return HostRefused(text, "correct that file")
        case asyncssh.KeyImportError() | asyncssh.KeyEncryptionError():
            return HostRefused(f"{name}: an SSH key of yours cannot be read: {error}")
        case asyncssh.DisconnectError():
            return _handshake_error(name, host, check, error)
    return HostRefused(f"{name}: {error}")


def _handshake_error(
    name: str, host: Host, check: HostKeyCheck, error: asyncssh.DisconnectError
) -> HostError:
    """Why the two programs do not come together."""
    described: HostError
    match error:
        case asyncssh.HostKeyNotVerifiable() | asyncssh.PermissionDenied() if not check.id:
            text = f"{name}: the jump host of ~/.ssh/config cannot be used: {error.reason}"
            described = HostRefused(text, f"try `ssh {ssh_arguments(host)}`")
        case asyncssh.HostKeyNotVerifiable():
            described = _host_key_error(name, host, check, error)
        case asyncssh.PermissionDenied():
            described = _login_error(name, host)
        case asyncssh.KeyExchangeFailed():
            text = f"{name}: there is no SSH algorithm in common: {error.reason}"
            described = HostRefused(text, "update the SSH server of the host")
        case asyncssh.ProtocolError() | asyncssh.ProtocolNotSupported():
            text = f"{name}: what answers at the address is no SSH server ({error.reason})"
            described = HostUnreachable(text, "check the port of the address")
        case _:
            described = HostRefused(f"{name}: the host ended the connection: {error.reason}")
    return described


def _network_error(name: str, host: Host, error: Exception) -> HostUnreachable:
    remedy = _reachability_help(host)
    match error:
        case TimeoutError():
            text = "no answer"
        case asyncssh.ConnectionLost() | ConnectionResetError() | BrokenPipeError():
            text = "the connection was closed before the login"
            remedy = "check the port of the address, and the log of the server: `journalctl -u ssh`"
        case socket.gaierror():
            text = f"the name `{host.address}` has no address ({error.strerror})"
            remedy = "correct the name, or write an IP address"
        case ConnectionRefusedError():
            port = f"port {host.ssh_port}" if host.ssh_port else "the port of SSH"
            text = f"the computer answers, but nothing listens at {port}"
            remedy = "start its SSH server (`systemctl start ssh`), or correct the port"
        case OSError(errno=errno.EHOSTUNREACH | errno.ENETUNREACH):
            text = "no way to the address"
        case _:  # asyncio joins the errors of all addresses of a name into one text
            text = getattr(error, "strerror", None) or str(error)
    return HostUnreachable(f"{name}: {text}", remedy)


def _reachability_help(host: Host) -> str:
    return f"check that the computer is on, and that `ping {host.address}` reaches it"


def _login_error(name: str, host: Host) -> HostRefused:
    return HostRefused(
        f"{name}: the login was refused: no key of ~/.ssh or of the SSH agent is accepted",
        f"correct the `user` of the host, or install your key: `ssh-copy-id {ssh_arguments(host)}`",
    )


def _host_key_error(name: str, host: Host, check: HostKeyCheck, error: Exception) -> HostRefused:
    trust = f"rcdeploy hosts trust {ANY_FILE} {host.name}"
    revoked = [key for key in check.known if key.kind == known_hosts.REVOKED]
    pinned = [key for key in check.known if not key.kind]
    shown = check.presented
    text = f" {known_hosts.fingerprint(shown)}" if shown else ""
    if "revoked" in str(error) and revoked:
        message = f"{name}: its host key is revoked in {revoked[0].place}"
        return HostRefused(message, "ask who revoked it, and why", codes.CHANGED_KEY)
    if pinned:
        places = ", ".join(dict.fromkeys(key.place for key in pinned))
        kind = "has another host key than the confirmed one"
        message = f"{name}: the host {kind}{f':{text}' if text else ''} (confirmed: {places})"
        remedy = (
            "if it was installed again, compare the fingerprint on the host itself, then run "
            f"`{trust} --replace`; otherwise another computer may pretend to be it"
        )
        return HostRefused(message, remedy, codes.CHANGED_KEY)
    if shown is None:
        return HostRefused(f"{name}: {error}", "", codes.UNKNOWN_KEY)
    message = f"{name}: its host key is not confirmed yet:{text}"
    return HostRefused(message, f"compare and confirm it: `{trust}`", codes.UNKNOWN_KEY)


def describe_loss(host: Host, check: HostKeyCheck, error: Exception) -> HostError:
    """The error of an operation on an open connection, which may have ended."""
    name = describe_host(host)
    if isinstance(error, asyncssh.ChannelOpenError) and "closed" not in error.reason:
        remedy = "allow more sessions: `MaxSessions` in /etc/ssh/sshd_config of the host"
        return HostRefused(f"{name}: the SSH server refuses a session: {error.reason}", remedy)
    return HostUnreachable(f"{name}: the connection was lost: {check.lost or error}")
