"""Settings of zenoh that routers and their clients share: mutual TLS, no discovery, the lease.

In: certificate files. Out: zenoh settings as data, by path.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

LEASE_MS = 5000
"""After so long without a sign of life the other end of a link counts as lost."""
HANDSHAKE_TIMEOUT_MS = 5000
"""Deadline of one attempt to connect, at both ends; the next attempt follows."""
RETRY = {"period_init_ms": 50, "period_max_ms": 500, "period_increase_factor": 2}
"""When a link is lost, it is tried again after these periods."""


def base_settings() -> dict[str, Any]:
    """No multicast, no gossip, no shared memory; how a lost link is noticed."""
    return {
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
        "transport/link/protocols": ["tls"],
        "transport/link/tx/lease": LEASE_MS,
        "transport/unicast/open_timeout": HANDSHAKE_TIMEOUT_MS,
        "transport/unicast/accept_timeout": HANDSHAKE_TIMEOUT_MS,
        # Other users of the host could open its segments.
        "transport/shared_memory/enabled": False,
    }


def drop_settings(seconds: float, large_seconds: float) -> dict[str, Any]:
    """How long a full link may hold a message before it is dropped, and one of several packets.

    Afterwards messages are dropped at once until the link takes some again.
    """
    section = "transport/link/tx/queue/congestion_control/drop"
    return {
        f"{section}/wait_before_drop": round(seconds * 1e6),
        f"{section}/max_wait_before_drop_fragments": round(large_seconds * 1e6),
    }


def tls_settings(ca: Path, certificate: Path, key: Path, *, listen: bool) -> dict[str, Any]:
    """Both ends of a link show a certificate of this CA, and check that of the other end."""
    tls = {
        "root_ca_certificate": str(ca),
        "enable_mtls": True,
        "verify_name_on_connect": True,
        "connect_certificate": str(certificate),
        "connect_private_key": str(key),
        # What runs goes on: a robot does not stop because a certificate has expired.
        "close_link_on_expiration": False,
    }
    if listen:
        tls |= {"listen_certificate": str(certificate), "listen_private_key": str(key)}
    return {"transport/link/tls": tls}
