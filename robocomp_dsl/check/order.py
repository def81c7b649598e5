"""The order in which components start: each behind those that it names with `after`.

In: instances as written. Out: their names in a stable order, and findings about unknown names and
cycles.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from robocomp_dsl.check import codes
from robocomp_dsl.check.imports import replace
from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.syntax.ast_base import Name
from robocomp_dsl.syntax.ast_ddsl import Instance


def start_order(instances: Sequence[Instance], report: Report) -> list[str]:
    """The names of all instances, those that stand first first where `after` leaves the choice.

    What is part of a cycle keeps its written place.
    """
    known = {one.name.text: one for one in instances}
    waits = {name: _known_names(one, known, report) for name, one in known.items()}
    _report_cycles(waits, report)
    order: dict[str, None] = {}
    for start in known:
        path = {start: None}
        while path:
            last = next(reversed(path))
            ahead = (name for name in waits[last] if name not in order and name not in path)
            if (first := next(ahead, None)) is not None:
                path[first] = None
            else:
                order[last] = None
                del path[last]
    return list(order)


def _known_names(
    instance: Instance, known: Mapping[str, Instance], report: Report
) -> dict[str, Name]:
    found: dict[str, Name] = {}
    for name in instance.after:
        if name.text in known:
            found.setdefault(name.text, name)
            continue
        guess = nearest(name.text, known)
        report.add(
            codes.UNKNOWN_INSTANCE,
            name.span,
            f"`{instance.name.text}` waits for `{name.text}`, which is not in this deployment",
            label=f"did you mean `{guess}`?" if guess else "",
            fix=replace(name.span, guess) if guess else None,
        )
    return found


def _report_cycles(waits: Mapping[str, Mapping[str, Name]], report: Report) -> None:
    """Report every cycle once, at its first name in the file."""
    done: set[str] = set()
    for start in waits:
        path = {start: iter(waits[start])} if start not in done else {}
        while path:
            last = next(reversed(path))
            following = next(path[last], None)
            if following is None:
                done.add(last)
                del path[last]
            elif following in path:
                names = list(path)
                _report_cycle(names[names.index(following) :], waits, report)
            elif following not in done:
                path[following] = iter(waits[following])


def _report_cycle(
    cycle: Sequence[str], waits: Mapping[str, Mapping[str, Name]], report: Report
) -> None:
    steps = list(zip(cycle, (*cycle[1:], cycle[0]), strict=True))
    shown = " → ".join(f"`{name}`" for name in (*cycle, cycle[0]))
    report.add(
        codes.AFTER_CYCLE,
        waits[steps[0][0]][steps[0][1]].span,
        f"`{cycle[0]}` waits for itself: {shown}",
        notes=[
            Note(waits[one][other].span, f"`{one}` waits for `{other}` here")
            for one, other in steps[1:]
        ],
        help="remove one of these `after`: a requirement alone needs none",
    )
