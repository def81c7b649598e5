"""Settings that the ROS 2 middlewares share. In: texts of the command line. Out: checked values."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from robocomp_dsl.runtime.errors import MiddlewareError

DOMAIN_VARIABLE = "ROS_DOMAIN_ID"
MAX_DOMAIN_ID = 232
"""The largest DDS domain whose ports fit into 16 bits."""


def only_known(middleware: str, settings: Mapping[str, str], known: Collection[str]) -> None:
    """Raise `MiddlewareError` for a setting that the middleware does not have."""
    for key in settings:
        if key not in known:
            raise MiddlewareError(
                f"{middleware} has no setting `{key}`; known: {', '.join(sorted(known))}"
            )


def domain_id(middleware: str, settings: Mapping[str, str], environment: Mapping[str, str]) -> int:
    """The setting `domain_id`, else ROS_DOMAIN_ID, else 0. Raises `MiddlewareError`."""
    text = settings.get("domain_id") or environment.get(DOMAIN_VARIABLE) or "0"
    if not text.isdecimal() or int(text) > MAX_DOMAIN_ID:
        where = f"{middleware}.domain_id" if settings.get("domain_id") else DOMAIN_VARIABLE
        raise MiddlewareError(f"{where}: `{text}` is no ROS domain; use 0 to {MAX_DOMAIN_ID}")
    return int(text)
