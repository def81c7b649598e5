"""Says why a router cannot be reached. zenoh itself only says `Unable to connect … Timeout!`.

In: `NetworkSettings`. Out: for each endpoint the reason, found with Python's own TLS: address,
port, certificate of the router, or certificate of this program.
"""

from __future__ import annotations

import contextlib
import errno
import socket
import ssl
import time
from pathlib import Path

from robocomp_dsl.runtime.presence.network_settings import NetworkSettings, parse_endpoint

PROBE_TIMEOUT_S = 2.0
_ALERT_WAIT_S = 0.5
"""A router that refuses the certificate of its client says so within this time."""
_NEW_KEYS = "run `rcdeploy keys APP.ddsl`, then `rcdeploy APP.ddsl up`"
_ACCEPTED = "it accepts the certificate, but does not complete the connection"
_REFUSALS = {
    10: f"the certificate of the router has expired; {_NEW_KEYS}",
    9: "the certificate of the router is not valid yet: check the clock of this host and of the"
    " router's (`rcdeploy hosts APP.ddsl` shows the offset)",
    62: "the certificate of the router is for another name or address; after a change of `address`"
    f" in the DDSL file {_NEW_KEYS}",
    64: "the certificate of the router is for another address; after a change of `address` in the"
    f" DDSL file {_NEW_KEYS}",
}
_OTHER_AUTHORITY = (
    "the router has a certificate of another authority (CA): it belongs to another deployment, or"
    " the keys were made anew on another machine; run `rcdeploy APP.ddsl up` on the machine with"
    " the keys"
)
_ALERTS = (
    ("CERTIFICATE_REQUIRED", "it requires a certificate, and this program has shown none"),
    ("CERTIFICATE_EXPIRED", "it refuses the certificate of this program: it is not valid now"),
    ("UNKNOWN_CA", "it refuses the certificate of this program: another authority (CA) signed it"),
    ("DECRYPT_ERROR", "it refuses the certificate of this program: another authority (CA) made it"),
    ("ALERT", "it refuses the certificate of this program"),
)
_SOCKET_ERRORS = {
    errno.ECONNREFUSED: "no router listens there; `rcdeploy status` shows whether it runs",
    errno.EHOSTUNREACH: "there is no way to this address; is the host on, and in this network?",
    errno.ENETUNREACH: "there is no way to this address; is the host on, and in this network?",
}


def explain_failure(settings: NetworkSettings, error: str) -> str:
    """Why no endpoint can be reached; `error` is what zenoh said."""
    reasons = [f"{endpoint}: {probe(settings, endpoint)}" for endpoint in settings.endpoints]
    if all(reason.endswith(_ACCEPTED) for reason in reasons):
        reasons.append(f"zenoh says: {error}")
    return f"no router can be reached: {'; '.join(reasons)}"


def probe(settings: NetworkSettings, endpoint: str) -> str:
    """Connect to one endpoint as a client does; returns what is wrong."""
    try:
        context = _context(settings)
    except (OSError, ssl.SSLError) as error:
        return f"{settings.certificate} and {settings.key} cannot be used: {error}; {_NEW_KEYS}"
    return certificate_problem(settings.certificate) or _connect(context, endpoint)


def _connect(context: ssl.SSLContext, endpoint: str) -> str:
    host, port = parse_endpoint(endpoint, "endpoint")
    try:
        with (
            socket.create_connection((host, port), PROBE_TIMEOUT_S) as opened,
            context.wrap_socket(opened, server_hostname=host) as link,
        ):
            link.settimeout(_ALERT_WAIT_S)
            with contextlib.suppress(TimeoutError):
                link.recv(1)
            return _ACCEPTED
    except ssl.SSLCertVerificationError as error:
        return _REFUSALS.get(error.verify_code, _OTHER_AUTHORITY)
    except ssl.SSLError as error:
        return _describe_alert(error)
    except OSError as error:
        return _describe_socket_error(host, error)


def _context(settings: NetworkSettings) -> ssl.SSLContext:
    context = ssl.create_default_context(cafile=str(settings.ca))
    context.load_cert_chain(str(settings.certificate), str(settings.key))
    return context


def _describe_socket_error(host: str, error: OSError) -> str:
    if isinstance(error, socket.gaierror):
        return f"`{host}` is not a known host name ({error.strerror})"
    if isinstance(error, TimeoutError):
        return "the address does not respond; is the host on, and does a firewall block the port?"
    return _SOCKET_ERRORS.get(error.errno or 0, error.strerror or str(error))


def _describe_alert(error: ssl.SSLError) -> str:
    reason = error.reason or ""
    known = next((text for mark, text in _ALERTS if mark in reason), "")
    return known or f"what listens there is no router of a deployment ({reason or error})"


def certificate_problem(certificate: Path) -> str:
    """Whether the clock of this host is outside the validity of a certificate; empty: it is not."""
    now = time.time()
    try:
        # The only way of the standard library to read the dates of a file.
        fields = ssl._ssl._test_decode_cert(str(certificate))  # type: ignore[attr-defined]
        begin, end = (ssl.cert_time_to_seconds(fields[name]) for name in ("notBefore", "notAfter"))
    except (AttributeError, KeyError, ValueError, OSError):
        return ""
    if now > end:
        return f"the certificate {certificate} expired at {_day(end)}; {_NEW_KEYS}"
    if now < begin:
        return (
            f"the certificate {certificate} is not valid before {_day(begin)}, and the clock of"
            f" this host says {_day(now)}: set the clock"
        )
    return ""


def _day(seconds: float) -> str:
    return time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime(seconds))
