"""The settings of `ros1`. In: texts of command line and environment. Out: checked values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from urllib.parse import urlsplit

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.ros_common.settings import only_known

MASTER = "http://127.0.0.1:11311"
HOST = "127.0.0.1"
_KNOWN = ("host", "master")
_EVERY = frozenset({"0.0.0.0", "::", "*"})  # noqa: S104 - refused


@dataclass(frozen=True, slots=True)
class Ros1Settings:
    """`master` is its URI; `host` is the address where the component listens, and announces."""

    master: str
    host: str

    @property
    def is_unreachable(self) -> bool:
        """Whether the master runs on another machine, which cannot reach `host`."""
        return _is_loopback(self.host) and not _is_loopback(urlsplit(self.master).hostname or "")


def read_settings(settings: Mapping[str, str], environment: Mapping[str, str]) -> Ros1Settings:
    """The settings, else the variables of ROS, else the defaults. Raises `MiddlewareError`."""
    only_known("ros1", settings, _KNOWN)
    variables = environment.get("ROS_IP") or environment.get("ROS_HOSTNAME")
    host = settings.get("host") or variables or HOST
    if host in _EVERY:
        raise MiddlewareError(
            f"ros1.host: other nodes cannot connect to {host}; write the address of this machine"
            " that they reach"
        )
    return Ros1Settings(master_uri(settings.get("master", ""), environment), host)


def _is_loopback(host: str) -> bool:
    return host in {"localhost", "::1"} or host.startswith("127.")


def master_uri(text: str, environment: Mapping[str, str]) -> str:
    """The URI of the master: `text`, else ROS_MASTER_URI, else that of this machine.

    Raises `MiddlewareError` for a text that is no `http://HOST:PORT`.
    """
    source = "ros1.master" if text else "ROS_MASTER_URI"
    uri = text or environment.get("ROS_MASTER_URI") or MASTER
    try:
        parts = urlsplit(uri)
        valid = parts.scheme == "http" and bool(parts.hostname) and bool(parts.port)
    except ValueError:
        valid = False
    if not valid:
        raise MiddlewareError(f"{source}: `{uri}` is no address; write it as in {MASTER}")
    return uri.rstrip("/")
