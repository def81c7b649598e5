"""The monitors of a component, as `--monitors` gives them.

In: JSON, or `@FILE` with it. Out: `ConnectionMonitors`, one for each connection with monitors or a
constraint, or an `InvalidSetting` that names the entry.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from robocomp_dsl.monitors.constraint import ConstraintError, parse_constraint
from robocomp_dsl.runtime.component.invalid_setting import InvalidSetting
from robocomp_dsl.runtime.connection.monitor_settings import ConnectionMonitors, MonitorSettings

POSITIONS = ("receiver", "sender", "identify")
FAILURE_POLICIES = ("bypass", "close")
MAX_MONITORS = 16
"""Monitors of one connection."""
_JSON_TYPES = {"text": str, "list": list, "object": dict}


def parse_monitors(text: str) -> tuple[ConnectionMonitors, ...]:
    """The value of `--monitors`. Raises `InvalidSetting`."""
    source = "--monitors"
    if text.startswith("@"):
        source = text[1:]
        try:
            text = Path(source).read_text("utf-8")
        except (OSError, UnicodeDecodeError, ValueError) as error:
            raise InvalidSetting(f"cannot read {source}: {error}") from None
    try:
        entries = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise InvalidSetting(f"{source} is no JSON: {error}") from None
    if not isinstance(entries, list):
        raise InvalidSetting(f"{source} is a list of connections, such as {_EXAMPLE}")
    connections = tuple(
        _connection(entry, f"{source}: connection {i}") for i, entry in enumerate(entries, 1)
    )
    _check_arbitration(source, connections)
    return connections


_EXAMPLE = '[{"port": "Target", "at": "receiver", "peer": "face.Target", "monitors": [...]}]'


def _check_arbitration(source: str, connections: tuple[ConnectionMonitors, ...]) -> None:
    """Check that all connections into a port are arbitrated, or none, and that each occurs once."""
    arbitrated: dict[str, bool] = {}
    ends = set()
    for connection in connections:
        end = (connection.port, connection.peer, connection.position)
        if end in ends:
            raise InvalidSetting(f"{source}: {connection.port} with {connection.peer} occurs twice")
        ends.add(end)
        if connection.position != "receiver":
            continue
        has_constraint = connection.constraint is not None
        if arbitrated.setdefault(connection.port, has_constraint) != has_constraint:
            raise InvalidSetting(
                f"{source}: some connections into {connection.port} have `when`, others have not;"
                " give each of them one"
            )


def _connection(entry: Any, where: str) -> ConnectionMonitors:
    known = dict.fromkeys(("port", "peer", "at", "when"), "text") | {"monitors": "list"}
    values = _object(entry, known, ("port", "peer", "at"), where)
    component, _, port = values["peer"].rpartition(".")
    if not component.strip("/") or not port or not values["port"]:
        raise InvalidSetting(f"{where}: `peer` is component.Port, not `{values['peer']}`")
    if values["at"] not in POSITIONS:
        positions = ", ".join(POSITIONS)
        raise InvalidSetting(f"{where}: `at` is one of {positions}, not `{values['at']}`")
    constraint = None
    if values.get("when"):
        if values["at"] != "receiver":
            raise InvalidSetting(f"{where}: `when` needs `at` receiver")
        try:
            constraint = parse_constraint(values["when"])
        except ConstraintError as error:
            column = error.start + 1
            text = f"{where}: `when {values['when']}`, column {column}: {error.message}"
            raise InvalidSetting(f"{text}; {error.help}" if error.help else text) from None
    items = values.get("monitors", [])
    if len(items) > MAX_MONITORS:
        raise InvalidSetting(f"{where}: {len(items)} monitors; at most {MAX_MONITORS}")
    monitors = tuple(_monitor(item, f"{where}, monitor {i}") for i, item in enumerate(items, 1))
    return ConnectionMonitors(values["port"], values["peer"], values["at"], monitors, constraint)


def _monitor(entry: Any, where: str) -> MonitorSettings:
    known = dict.fromkeys(("file", "class", "on_failure"), "text") | {"parameters": "object"}
    values = _object(entry, known, ("file", "class"), where)
    policy = values.get("on_failure", FAILURE_POLICIES[0])
    if policy not in FAILURE_POLICIES:
        policies = " or ".join(FAILURE_POLICIES)
        raise InvalidSetting(f"{where}: `on_failure` is {policies}, not `{policy}`")
    return MonitorSettings(
        Path(values["file"]),
        values["class"],
        tuple(_parameters(values.get("parameters", {}), where)),
        policy == "close",
    )


def _parameters(values: dict[str, Any], where: str) -> Iterator[tuple[str, Any]]:
    for name, value in values.items():
        if not isinstance(value, bool | int | float | str):
            raise InvalidSetting(f"{where}: parameter `{name}` is a bool, a number or a text")
        yield name, value


def _object(
    entry: Any, known: Mapping[str, str], required: tuple[str, ...], where: str
) -> dict[str, Any]:
    """Check an object of the JSON. Raises `InvalidSetting`."""
    if not isinstance(entry, dict):
        raise InvalidSetting(f"{where} is an object, not {json.dumps(entry)[:40]}")
    for name, value in entry.items():
        if name not in known:
            raise InvalidSetting(f"{where} has no `{name}`; its items: {', '.join(known)}")
        if not isinstance(value, _JSON_TYPES[known[name]]):
            kind = "an object" if known[name] == "object" else f"a {known[name]}"
            raise InvalidSetting(f"{where}: `{name}` is {kind}")
    for name in required:
        if name not in entry:
            raise InvalidSetting(f"{where} needs `{name}`")
    return entry
