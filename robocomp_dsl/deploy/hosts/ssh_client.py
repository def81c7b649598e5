"""Opening a connection with OpenSSH: which key the host has, and why a connection fails.

In: a host. Out: an open connection of asyncssh, or a `HostError` in the user's words. The settings
of `~/.ssh/config` count, except those that weaken the check of host keys.
"""

from __future__ import annotations

import errno
import logging
import socket
from typing import TYPE_CHECKING, Any

from robocomp_dsl.deploy.hosts import codes, known_hosts
from robocomp_dsl.deploy.hosts.address import describe_host, ssh_arguments
from robocomp_dsl.deploy.hosts.errors import ANY_FILE, HostError, HostRefused, HostUnreachable
from robocomp_dsl.extras import MissingExtra
from robocomp_dsl.model.deployment import Host

try:
    import asyncssh
except ModuleNotFoundError as error:
    raise MissingExtra("a deployment over several hosts", "hosts", error) from None

if TYPE_CHECKING:
    from robocomp_dsl.deploy.hosts.known_hosts import KnownKey

CONNECT_TIMEOUT_S = 15.0
KEEPALIVE_S = 2.0
KEEPALIVE_COUNT = 3
"""A lost link is noticed after `KEEPALIVE_COUNT` times `KEEPALIVE_S`."""

logging.getLogger("asyncssh").setLevel(logging.CRITICAL)  # errors are reported as findings


class HostKeyCheck(asyncssh.SSHClient):
    """Compares the key of a host with the confirmed keys; keeps what it has seen.

    `presented` is the key that the host showed and that is not confirmed; `known` are the confirmed
    keys of the host, which the files know as `id`. `lost` is why the connection ended.
    """

    def __init__(self) -> None:
        self.id = ""
        self.known: list[KnownKey] = []
        self.presented: asyncssh.SSHKey | None = None
        self.lost: Exception | None = None

    def lookup(self, host: str, address: str, port: int | None) -> Any:
        """The confirmed keys, for asyncssh; `port` None: that of SSH."""
        self.id = known_hosts.host_id(host, port or known_hosts.DEFAULT_PORT)
        self.known = known_hosts.find_keys(host, address, port or known_hosts.DEFAULT_PORT)
        return known_hosts.asyncssh_keys(self.known)

    @property
    def has_seen_no_key(self) -> bool:
        """Whether the host may have no key of the kind of the confirmed keys."""
        return bool(self.known) and self.presented is None

    def validate_host_public_key(self, *server: Any) -> bool:
        """Refuse a key that is not confirmed: the last of `host`, `address`, `port` and `key`."""
        self.presented = server[-1]
        return False

    def connection_lost(self, exc: Exception | None) -> None:
        """Keep the reason."""
        self.lost = exc


async def open_connection(host: Host, check: HostKeyCheck) -> asyncssh.SSHClientConnection:
    """Connect and log in. Raises `HostUnreachable` or `HostRefused`."""
    try:
        try:
            return await _connect(host, check)
        except (ConnectionError, asyncssh.ConnectionLost, asyncssh.KeyExchangeFailed):
            if not check.has_seen_no_key:
                raise
        # Only kinds of confirmed keys were accepted; now the host shows another, which is refused.
        return await _connect(host, check, server_host_key_algs="default")
    except (OSError, ValueError, asyncssh.Error) as error:
        raise describe_error(host, check, error) from None


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
        connect_timeout=CONNECT_TIMEOUT_S,
        **options,
    )


def describe_error(host: Host, check: HostKeyCheck, error: Exception) -> HostError:
    """Why `host` cannot be used, and what to do."""
    name = describe_host(host)
    match error:
        case asyncssh.HostKeyNotVerifiable() | asyncssh.KeyExchangeFailed():
            described: HostError = _host_key_error(name, host, check, error)
        case asyncssh.PermissionDenied():
            described = _login_error(name, host)
        case TimeoutError():
            text = f"{name}: no answer within {CONNECT_TIMEOUT_S:g} s"
            described = HostUnreachable(text, _reachability_help(host))
        case asyncssh.ConnectionLost() | ConnectionResetError() | BrokenPipeError():
            text = f"{name}: the connection was closed before the login"
            remedy = "check the port of the address, and the log of the server: `journalctl -u ssh`"
            described = HostUnreachable(text, remedy)
        case asyncssh.ProtocolError() | asyncssh.ProtocolNotSupported():
            text = f"{name}: what answers at the address is no SSH server ({error.reason})"
            described = HostUnreachable(text, "check the port of the address")
        case asyncssh.ConfigParseError():
            text = f"{name}: ~/.ssh/config has an error: {error}"
            described = HostRefused(text, "correct that file")
        case asyncssh.DisconnectError():
            described = HostRefused(f"{name}: the host ended the connection: {error.reason}")
        case asyncssh.KeyImportError() | asyncssh.KeyEncryptionError():
            described = HostRefused(f"{name}: an SSH key of yours cannot be read: {error}")
        case OSError():
            described = _network_error(name, host, error)
        case _:
            described = HostRefused(f"{name}: {error}")
    return described


def _network_error(name: str, host: Host, error: OSError) -> HostUnreachable:
    if isinstance(error, socket.gaierror):
        text = f"{name}: the name `{host.address}` has no address ({error.strerror})"
        return HostUnreachable(text, "correct the name, or write an IP address")
    if isinstance(error, ConnectionRefusedError):
        port = f"port {host.ssh_port}" if host.ssh_port else "the port of SSH"
        text = f"{name}: the computer answers, but nothing listens at {port}"
        remedy = "start its SSH server (`systemctl start ssh`), or correct the port of the address"
        return HostUnreachable(text, remedy)
    if error.errno in {errno.EHOSTUNREACH, errno.ENETUNREACH}:
        return HostUnreachable(f"{name}: no way to the address", _reachability_help(host))
    # asyncio joins the errors of all addresses of a name into one text.
    return HostUnreachable(f"{name}: {error.strerror or error}", _reachability_help(host))


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
        return HostRefused(f"{name}: the SSH server refuses a session: {error.reason}")
    return HostUnreachable(f"{name}: the connection was lost: {check.lost or error}")
