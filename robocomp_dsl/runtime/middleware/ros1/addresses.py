"""Addresses of ports: `/base/scan`, of components with the place where they listen.

In: texts of the command line and of records. Out: `RosAddress`, or `MiddlewareError`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.ros_common.names import absolute_name

_NO_WORD = re.compile(r"[^A-Za-z0-9_/]")


def own_name(name: str) -> str:
    """The ROS name of a component or port: other characters than letters and digits are `_`."""
    return "/" + _NO_WORD.sub("_", name.strip("/"))


@dataclass(frozen=True, slots=True)
class RosAddress:
    """The name of a topic, service or port; `number` is the TCP port, 0: the master knows it."""

    name: str
    host: str = ""
    number: int = 0

    def __str__(self) -> str:
        return f"{self.name}@{self.host}:{self.number}" if self.number else self.name


def parse_address(text: str, port: str) -> RosAddress:
    """The address that `text` is. Raises `MiddlewareError`, naming `port`."""
    name, at, place = text.partition("@")
    host, _, number = place.rpartition(":")
    if at and not (host and number.isdecimal() and 0 < int(number) < 65536):
        raise MiddlewareError(
            f"{port}: `{text}` is no address of ROS; write its name, as in `ros1:/base/scan`"
        )
    return RosAddress(absolute_name(name, port), host, int(number) if at else 0)
