"""What a name server of YARP knows. In: commands as words. Out: the lines of the reply."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

FIRST_PORT = 10002
MAX_PORTS = 10_000
_MULTICAST_PORT = 10000
_CHOOSE = "..."
_HELP = (
    "Here are some ways to use the name server:",
    "+ help",
    "+ list",
    "+ list $prefix",
    "+ register $portname $carrier $ipAddress $portNumber",
    '  (put "..." for any arguments you want the server to fill)',
    "+ unregister $portname",
    "+ query $portname",
    "+ set $portname $property $value",
    "+ get $portname $property",
    "+ check $portname $property $value",
    "+ route $port1 $port2",
)


@dataclass(slots=True)
class Registered:
    """One registered port."""

    name: str
    host: str
    number: int
    carrier: str = "tcp"
    properties: dict[str, list[str]] = field(default_factory=dict)

    @property
    def line(self) -> str:
        """As in replies."""
        return (
            f"registration name {self.name} ip {self.host} port {self.number} type {self.carrier}"
        )


class RegistrationTable:
    """The registered ports; safe for several threads."""

    def __init__(self, root: str, host: str, number: int) -> None:
        self._lock = threading.Lock()
        self._next_name = 1
        self._next_number = FIRST_PORT
        self._next_group = 1
        self._ports = {
            root: Registered(root, host, number),
            "fallback": Registered("fallback", "224.2.1.1", _MULTICAST_PORT, "mcast"),
        }

    def reply(self, words: list[str], caller: str) -> list[str]:
        """The lines of the reply to a command; `caller` is the host that asks."""
        command = _COMMANDS.get(words[0]) if words else None
        if command is None:
            return []
        with self._lock:
            return list(command(self, words[1:], caller))

    def found(self, prefix: str = "") -> list[Registered]:
        """The ports below a prefix, sorted by name."""
        return [
            port
            for name, port in sorted(self._ports.items())
            if not prefix or name == prefix or name.startswith(prefix.rstrip("/") + "/")
        ]

    def _query(self, words: list[str], _caller: str) -> Iterable[str]:
        port = self._ports.get(words[0]) if words else None
        return [port.line] if port else []

    def _list(self, words: list[str], _caller: str) -> Iterable[str]:
        return [port.line for port in self.found(words[0] if words else "")]

    def _register(self, words: list[str], caller: str) -> Iterable[str]:
        name, carrier, host, number = (*words, *[_CHOOSE] * 4)[:4]
        if name == _CHOOSE:
            name = f"/tmp/port/{self._next_name}"  # noqa: S108 - a name of YARP, no file
            self._next_name += 1
        if len(self._ports) >= MAX_PORTS and name not in self._ports:
            return []
        carrier = "tcp" if carrier == _CHOOSE else carrier
        if host == _CHOOSE:
            host = caller
            if carrier == "mcast":
                host = f"224.1.1.{self._next_group}"
                self._next_group = self._next_group % 254 + 1
        valid = number.isdigit() and len(number) <= 5 and 0 < int(number) < 65536
        port = Registered(name, host, int(number) if valid else self._free_number(), carrier)
        self._ports[name] = port
        return [port.line]

    def _free_number(self) -> int:
        used = {port.number for port in self._ports.values()}
        for _ in range(65536 - FIRST_PORT):
            number = self._next_number
            self._next_number = number + 1 if number < 65535 else FIRST_PORT
            if number not in used:
                return number
        return 0

    def _unregister(self, words: list[str], _caller: str) -> Iterable[str]:
        if words:
            self._ports.pop(words[0], None)
        return []

    def _set(self, words: list[str], _caller: str) -> Iterable[str]:
        port = self._ports.get(words[0]) if words else None
        if port is None or len(words) < 2:
            return []
        port.properties[words[1]] = sorted(words[2:])
        return self._get(words, "")

    def _get(self, words: list[str], _caller: str) -> Iterable[str]:
        port = self._ports.get(words[0]) if words else None
        if port is None or len(words) < 2:
            return []
        values = port.properties.get(words[1], [])
        return [" ".join(["port", port.name, "property", words[1], "=", *values])]

    def _check(self, words: list[str], _caller: str) -> Iterable[str]:
        if len(words) < 3:
            return []
        port = self._ports.get(words[0])
        is_present = port is not None and words[2] in port.properties.get(words[1], [])
        present = "true" if is_present else "false"
        return [f"port {words[0]} property {words[1]} value {words[2]} present {present}"]

    def _route(self, words: list[str], _caller: str) -> Iterable[str]:
        if len(words) < 2:
            return []
        ends = [self._ports.get(name) for name in words[:2]]
        if any(port is None for port in ends):
            return [f"port {words[0]} route {words[1]} = {words[1]}"]
        return [f"port {words[0]} route {words[1]} = tcp:/{words[1]}"]

    def _help(self, _words: list[str], _caller: str) -> Iterable[str]:
        return _HELP

    def _runners(self, _words: list[str], _caller: str) -> Iterable[str]:
        return []


_COMMANDS: dict[str, Callable[[RegistrationTable, list[str], str], Iterable[str]]] = {
    "query": RegistrationTable._query,
    "list": RegistrationTable._list,
    "register": RegistrationTable._register,
    "unregister": RegistrationTable._unregister,
    "set": RegistrationTable._set,
    "get": RegistrationTable._get,
    "check": RegistrationTable._check,
    "route": RegistrationTable._route,
    "help": RegistrationTable._help,
    "runners": RegistrationTable._runners,
}
