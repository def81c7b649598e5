"""Asks the name server of YARP. In: names. Out: addresses; registrations.

The name server is `HOST PORT` of the file `yarp.conf`, unless a setting names it.
"""

from __future__ import annotations

import os
import re
import time
from collections.abc import Mapping
from pathlib import Path

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.tcp.stream import ConnectionLost
from robocomp_dsl.runtime.middleware.yarp.addresses import PortAddress
from robocomp_dsl.runtime.middleware.yarp.stream import YarpStream

DEFAULT = ("127.0.0.1", 10000)
TIMEOUT_S = 2.0
"""Limit of one request."""
END = "*** end of message"
MAX_LINES = 100_000
_REGISTRATION = re.compile(r"registration name (\S+) ip (\S+) port (\d+) type (\S+)")
_SETTING = re.compile(r"(\[[0-9a-fA-F:.]+\]|[^:\s\[\]]+):(\d{1,5})")


class NameServerLost(Exception):
    """The name server cannot be reached."""


class NameClient:
    """Requests to one name server, each over a connection of its own."""

    def __init__(self, at: tuple[str, int]) -> None:
        self.at = at

    def _ask(self, request: str) -> list[str]:
        """The lines of a reply. Raises `NameServerLost`."""
        where = f"{self.at[0]}:{self.at[1]}"
        try:
            stream = YarpStream.connect(self.at, TIMEOUT_S)
        except ConnectionLost as error:
            raise NameServerLost(f"{where}: {error}") from None
        stream.deadline = time.monotonic() + TIMEOUT_S
        try:
            stream.send(f"NAME_SERVER {request}\r\n".encode(errors="replace"))
            lines: list[str] = []
            while (line := stream.line()) != END:
                lines.append(line)
                if len(lines) > MAX_LINES:
                    raise NameServerLost(f"{where}: it is no name server of YARP")
        except ConnectionLost as error:
            raise NameServerLost(f"{where}: {error}") from None
        else:
            return lines
        finally:
            stream.close()

    def query(self, name: str, carrier: str = "tcp") -> PortAddress | None:
        """The address of a port; None if it is unknown. Raises `NameServerLost`."""
        return _found(self._ask(f"query {name}"), carrier)

    def register(self, name: str, host: str, number: int) -> PortAddress | None:
        """Register a port; returns what the server has noted. Raises `NameServerLost`."""
        return _found(self._ask(f"register {name} tcp {host} {number}"), "tcp")

    def unregister(self, name: str) -> None:
        """Forget a port. Raises `NameServerLost`."""
        self._ask(f"unregister {name}")


def _found(lines: list[str], carrier: str) -> PortAddress | None:
    for line in lines:
        if found := _REGISTRATION.match(line):
            return PortAddress(found[1], carrier, found[2], int(found[3]) % 65536)
    return None


def name_server_address(
    setting: str, environment: Mapping[str, str] = os.environ
) -> tuple[str, int]:
    """Host and TCP port: of the setting, of `yarp.conf`, or the default.

    Raises `MiddlewareError` for a setting that is no address.
    """
    if setting:
        found = _SETTING.fullmatch(setting)
        if not found or not 0 < int(found[2]) < 65536:
            raise MiddlewareError(
                f"`yarp.name_server={setting}` is no address; write HOST:PORT, such as"
                " 127.0.0.1:10000"
            )
        return found[1].strip("[]"), int(found[2])
    for folder in _configuration_folders(environment):
        try:
            text = (folder / _file_name(environment)).read_text(errors="replace")
        except OSError:
            continue
        words = text.split()
        if len(words) >= 2 and words[1].isdigit() and 0 < int(words[1]) < 65536:
            return words[0], int(words[1])
    return DEFAULT


def _file_name(environment: Mapping[str, str]) -> str:
    """`yarp.conf`, or that of the namespace, as YARP names it."""
    namespace = environment.get("YARP_NAMESPACE", "").strip("/")
    return f"_{namespace.replace('/', '_')}.conf" if namespace else "yarp.conf"


def _configuration_folders(environment: Mapping[str, str]) -> list[Path]:
    if home := environment.get("YARP_CONFIG_HOME"):
        return [Path(home)]
    if base := environment.get("XDG_CONFIG_HOME"):
        return [Path(base) / "yarp"]
    return [Path(environment.get("HOME", "/")) / ".config" / "yarp"]
