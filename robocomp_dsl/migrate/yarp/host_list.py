"""Reads lists of machines of YARP.

In: a file with the root `<cluster>` (yarpmanager's cluster configuration: `<node user="…"
ssh-options="…" address="…">name</node>`) or `<resources>` (`<computer>` with `<name>`, `<network>`
and `<disable>`). Out: machines, and findings about settings without a counterpart. As in YARP's
`xmlclusterloader.cpp` and `xmlresloader.cpp`.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from dataclasses import dataclass

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate.yarp import codes
from robocomp_dsl.migrate.yarp.document import (
    attribute,
    child,
    children,
    name_of,
    read_document,
    text_of,
)
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast.innermodel import Element

ROOTS = ("cluster", "resources")
_ADDRESS = re.compile(r"[A-Za-z0-9](?:[A-Za-z0-9_.-]*[A-Za-z0-9])?|[0-9A-Fa-f:]+:[0-9A-Fa-f:]*")
_USER = re.compile(r"[A-Za-z_][\w.-]*", re.ASCII)
_DROPPED = ("display", "docker", "conda", "pixi")
_LAST_PORT = 65535


@dataclass(frozen=True, slots=True)
class ListedMachine:
    """A machine of a list. `user` "" and `ssh_port` 0: those of ssh's configuration."""

    name: str
    address: str
    span: Span
    user: str = ""
    ssh_port: int = 0

    @property
    def written_address(self) -> str:
        """The address as in `address "…"`."""
        if not self.ssh_port:
            return self.address
        host = f"[{self.address}]" if ":" in self.address else self.address
        return f"{host}:{self.ssh_port}"


def read_host_list(source: Source, report: Report) -> list[ListedMachine]:
    """The machines of a file, each name once; disabled ones are left out."""
    root = read_document(source, report)
    if root is None:
        return []
    found = _cluster(root, report) if name_of(root) == "cluster" else _resources(root, report)
    machines: dict[str, ListedMachine] = {}
    for machine in found:
        if not _ADDRESS.fullmatch(machine.address):
            message = f"`{machine.address:.60}` is no address of a machine"
            report.add(codes.INCOMPLETE_ELEMENT, machine.span, message)
        elif machines.setdefault(machine.name, machine) is not machine:
            message = f"the machine `{machine.name}` is listed twice; the first one counts"
            report.add(codes.INCOMPLETE_ELEMENT, machine.span, message)
    return list(machines.values())


def _cluster(root: Element, report: Report) -> Iterator[ListedMachine]:
    for node in children(root, "node"):
        span = node.tag.span
        name = text_of(node).strip("/ ")
        if not name:
            report.add(codes.INCOMPLETE_ELEMENT, span, "a `<node>` without a name")
            continue
        for setting in _DROPPED:
            if value := attribute(node, setting):
                message = f"`{setting}` of `{name}` (`{value:.60}`): write it into the command line"
                report.add(codes.SETTING_DROPPED, span, message)
        user, port = _ssh_options(attribute(node, "ssh-options"), name, span, report)
        user = attribute(node, "user") or user or attribute(root, "user")
        if user and not _USER.fullmatch(user):
            report.add(codes.INCOMPLETE_ELEMENT, span, f"`{user:.60}` is not the name of a user")
            user = ""
        yield ListedMachine(name, attribute(node, "address") or name, span, user, port)


def _ssh_options(text: str, name: str, span: Span, report: Report) -> tuple[str, int]:
    """The user and the port among options of ssh(1); others are reported."""
    try:
        words = shlex.split(text)
    except ValueError:
        words = [text]
    user, port, others = "", 0, []
    for option, value in _options(words):
        if option == "-l" and value:
            user = value
        elif option == "-p" and value.isdecimal() and 0 < int(value) <= _LAST_PORT:
            port = int(value)
        else:
            others.append(f"{option} {value}".strip())
    if others:
        message = f"`{' '.join(others):.80}` of `{name}`: write it into ~/.ssh/config"
        report.add(codes.SETTING_DROPPED, span, message)
    return user, port


def _options(words: list[str]) -> Iterator[tuple[str, str]]:
    """Options with their values; `-o Port=22` is `-p 22`."""
    rest = iter(words)
    for word in rest:
        option, value = word[:2], word[2:]
        if option not in ("-p", "-l", "-o"):
            yield word, ""
            continue
        value = value or next(rest, "")
        key, _, setting = value.partition("=")
        known = {"port": "-p", "user": "-l"}.get(key.strip().lower(), "")
        if option == "-o" and known and setting:
            yield known, setting.strip()
        else:
            yield option, value


def _resources(root: Element, report: Report) -> Iterator[ListedMachine]:
    for computer in children(root, "computer"):
        span = computer.tag.span
        name = text_of(child(computer, "name")).strip("/ ")
        network = child(computer, "network")
        ip = text_of(child(network, "ip4")) if network else ""
        if not name:
            report.add(codes.INCOMPLETE_ELEMENT, span, "a `<computer>` without `<name>`")
        elif text_of(child(computer, "disable")).lower() == "yes":
            report.add(codes.SETTING_NOT_NEEDED, span, f"the machine `{name}` is disabled")
        else:
            yield ListedMachine(name, ip or name, span)
