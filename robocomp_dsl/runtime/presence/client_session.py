"""A zenoh session that is a client of one router, with mutual TLS; it listens nowhere.

In: `NetworkSettings`. Out: an open session. It connects again by itself when the router was away,
and declares again what it had declared.
"""

from __future__ import annotations

import json
from typing import Any

import zenoh

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.presence.network_settings import NetworkSettings
from robocomp_dsl.runtime.presence.tls_settings import (
    RETRY,
    base_settings,
    drop_settings,
    tls_settings,
)

CONNECT_TIMEOUT_S = 10.0
"""The start waits this long for the router; afterwards the session connects again for ever."""


def open_client_session(
    settings: NetworkSettings, timeout_s: float = CONNECT_TIMEOUT_S, hold_s: float = 0.0
) -> zenoh.Session:
    """Connect to the router; `hold_s` as in `open_session`.

    Raises `MiddlewareError` with the reason: files, address, port, or certificate.
    """
    settings.check_files()
    config = zenoh.Config()
    for key, value in _settings(settings, timeout_s, hold_s).items():
        config.insert_json5(key, json.dumps(value))
    try:
        return zenoh.open(config)
    except zenoh.ZError as error:
        # Most starts succeed and load no TLS library.
        from robocomp_dsl.runtime.presence.connection_failure import explain_failure  # noqa: PLC0415

        raise MiddlewareError(explain_failure(settings, str(error))) from None


def _settings(settings: NetworkSettings, timeout_s: float, hold_s: float) -> dict[str, Any]:
    values: dict[str, Any] = {
        "mode": "client",
        "connect/endpoints": list(settings.endpoints),
        "connect/timeout_ms": round(timeout_s * 1e3),
        "connect/exit_on_failure": True,
        "connect/retry": RETRY,
        **base_settings(),
        **tls_settings(settings.ca, settings.certificate, settings.key, listen=False),
    }
    if hold_s:
        values |= drop_settings(hold_s, hold_s)
    return values
