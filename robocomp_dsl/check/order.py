"""The order in which components start: each behind those that it names with `after`.

In: the scopes of a deployment. Out: the full names of its instances in a stable order, and findings
about unknown names and cycles.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from robocomp_dsl.check import codes
from robocomp_dsl.check.imports import replace
from robocomp_dsl.check.literals import listing
from robocomp_dsl.check.scopes import Scope
from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.syntax.ast_base import Name
from robocomp_dsl.syntax.ast_ddsl import Group, Instance


def start_order(scope: Scope, report: Report) -> list[str]:
    """The full names of all instances, those of a group together, in the order of starting."""
    items: list[Instance] = [*scope.instances.values(), *map(_as_instance, scope.groups.values())]
    items.sort(key=lambda one: one.span.start)
    farther = scope.outer.visible() if scope.outer else []
    made: list[str] = []
    for name in _sorted(items, farther, report):
        group = scope.groups.get(name)
        made += start_order(group, report) if group else [scope.full(name)]
    return made


def _as_instance(group: Scope) -> Instance:
    """A group as one thing that waits for what it and those in it wait for outside of it."""
    tree = group.tree
    after = tree.after if isinstance(tree, Group) else ()
    return Instance(tree.span, tree.name, after=(*after, *_outward(group)))


def _outward(group: Scope) -> Iterator[Name]:
    """The names after which something in a group starts, and that stand for something outside."""
    inner = [(one.after, group) for one in group.instances.values()]
    for one in group.groups.values():
        yield from (name for name in _outward(one) if not _is_in(name.text, group))
        if isinstance(one.tree, Group):
            inner.append((one.tree.after, group))
    for names, scope in inner:
        yield from (n for n in names if scope.find(n.text) and not _is_in(n.text, scope))


def _is_in(name: str, scope: Scope) -> bool:
    return name in scope.instances or name in scope.groups


def _sorted(instances: Sequence[Instance], farther: Sequence[str], report: Report) -> list[str]:
    """The names of one scope, those that stand first first where `after` leaves the choice.

    What is part of a cycle keeps its written place; `farther` names stand outside of the scope.
    """
    known = {one.name.text: one for one in instances}
    waits = {name: _known_names(one, known, farther, report) for name, one in known.items()}
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
    instance: Instance, known: Mapping[str, Instance], farther: Sequence[str], report: Report
) -> dict[str, Name]:
    found: dict[str, Name] = {}
    for name in instance.after:
        if name.text in known:
            found.setdefault(name.text, name)
            continue
        if name.text in farther:
            continue
        guess = nearest(name.text, [*known, *farther])
        report.add(
            codes.UNKNOWN_INSTANCE,
            name.span,
            f"`{instance.name.text}` waits for `{name.text}`, which is not in this deployment",
            label=f"did you mean `{guess}`?" if guess else "",
            fix=replace(name.span, guess) if guess else None,
            help="" if guess else _others(instance, [*known, *farther]),
        )
    return found


def _others(instance: Instance, known: Sequence[str]) -> str:
    others = [one for one in known if one != instance.name.text]
    return f"in it are {listing(others)}" if others else "nothing else is in it"


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
