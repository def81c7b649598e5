"""Assigns names to the ports of a component.

In: ports of a tree. Out: a name for each, unique on its side (proxies: `requires` and `publishes`;
methods: `implements` and `subscribesTo`), because proxies and methods are named after ports.

A port has its instance name (`requires Laser as front`), else the name of its interface, with a
number from the second port on: `Laser`, `Laser1`, `Laser2`.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check.names.duplicates import report_duplicate
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.syntax.ast.base import Name
from robocomp_dsl.syntax.ast.cdsl import Port


def port_names(ports: Sequence[Port], report: Report) -> dict[int, str]:
    """The names by `id` of the port; a duplicate alias is reported and left out."""
    chosen: dict[int, str] = {}
    for side in ("requires", "publishes"), ("implements", "subscribesTo"):
        chosen.update(_names_of_side([port for port in ports if port.role in side], report))
    return chosen


def _names_of_side(ports: Sequence[Port], report: Report) -> dict[int, str]:
    """As `port_names`. Names are compared without case: proxies have lower-case names."""
    chosen: dict[int, str] = {}
    aliases: dict[str, Name] = {}
    for port in ports:
        if port.alias is not None:
            earlier = aliases.setdefault(port.alias.text.lower(), port.alias)
            if earlier is port.alias:
                chosen[id(port)] = port.alias.text
            else:
                report_duplicate(port.alias, earlier, "port", report)
    taken: set[str] = set()
    tried: dict[str, int] = {}
    for port in ports:
        if port.alias is None:
            name = _numbered(port.interface.name.text, taken, tried)
            if name.lower() in aliases:
                report_duplicate(aliases[name.lower()], port.interface.name, "port", report)
            else:
                chosen[id(port)] = name
            taken.add(name.lower())
    return chosen


def _numbered(stem: str, taken: set[str], tried: dict[str, int]) -> str:
    """`stem` with the first free number; `tried` caches where the last search ended."""
    number = tried.get(stem, 0)
    name = f"{stem}{number or ''}"
    while name.lower() in taken:
        number += 1
        name = f"{stem}{number}"
    tried[stem] = number
    return name
