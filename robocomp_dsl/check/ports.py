"""Names of the ports of a component.

In: ports as written. Out: a name for each, unlike those of the other ports of its side. Proxies and
methods are called after ports: proxies after what a component requires and publishes, methods after
what it implements and subscribes to.

A port has its instance name (`requires Laser as front`), else the name of its interface; from the
second one on with a number behind it: `Laser`, `Laser1`, `Laser2`.
"""

from __future__ import annotations

from collections.abc import Sequence

from robocomp_dsl.check.names import report_repeat
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.syntax.ast_base import Name
from robocomp_dsl.syntax.ast_cdsl import Port


def port_names(ports: Sequence[Port], report: Report) -> dict[int, str]:
    """The names by `id` of the port; one whose name is taken is reported and left out."""
    chosen: dict[int, str] = {}
    for side in ("requires", "publishes"), ("implements", "subscribesTo"):
        chosen.update(_names_of_side([one for one in ports if one.role in side], report))
    return chosen


def _names_of_side(ports: Sequence[Port], report: Report) -> dict[int, str]:
    """As `port_names`. Case does not tell ports apart: proxies are called in lower case."""
    chosen: dict[int, str] = {}
    aliases: dict[str, Name] = {}
    for port in ports:
        if port.alias is not None:
            earlier = aliases.setdefault(port.alias.text.lower(), port.alias)
            if earlier is port.alias:
                chosen[id(port)] = port.alias.text
            else:
                report_repeat(port.alias, earlier, "port", report)
    taken: set[str] = set()
    tried: dict[str, int] = {}
    for port in ports:
        if port.alias is None:
            name = _numbered(port.interface.name.text, taken, tried)
            if name.lower() in aliases:
                report_repeat(aliases[name.lower()], port.interface.name, "port", report)
            else:
                chosen[id(port)] = name
            taken.add(name.lower())
    return chosen


def _numbered(stem: str, taken: set[str], tried: dict[str, int]) -> str:
    """`stem` with the first free number; `tried` says where the last search for it ended."""
    number = tried.get(stem, 0)
    name = f"{stem}{number or ''}"
    while name.lower() in taken:
        number += 1
        name = f"{stem}{number}"
    tried[stem] = number
    return name
