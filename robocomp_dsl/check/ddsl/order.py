"""Computes the start order of components from `after`.

In: the scopes of a deployment. Out: the qualified instance names in a stable order, and diagnostics
about unknown names and cycles.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from robocomp_dsl.check.codes import deployment as codes
from robocomp_dsl.check.ddsl.scopes import DeploymentScope
from robocomp_dsl.check.literals import join_names
from robocomp_dsl.check.names.unknown_names import report_unknown_name
from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.syntax.ast.base import Name
from robocomp_dsl.syntax.ast.ddsl import Group, Instance


def start_order(scope: DeploymentScope, report: Report) -> list[str]:
    """The qualified names of all instances in start order; groups stay together."""
    items: list[Instance] = [*scope.instances.values(), *map(_as_instance, scope.groups.values())]
    items.sort(key=lambda item: item.span.start)
    closed = scope.outer is None or scope.definitions
    farther = [] if closed or scope.outer is None else scope.outer.visible_names()
    order: list[str] = []
    for name in _sorted(items, farther, report):
        group = scope.groups.get(name)
        order += start_order(group, report) if group else [scope.qualified_name(name)]
    return order


def _as_instance(group: DeploymentScope) -> Instance:
    """A group as an instance with all its dependencies on components outside the group."""
    tree = group.tree
    after = tree.after if isinstance(tree, Group) else ()
    return Instance(tree.span, tree.name, after=(*after, *_outward_dependencies(group)))


def _outward_dependencies(group: DeploymentScope) -> Iterator[Name]:
    """The dependencies of a group's members on components outside the group."""
    inner = [(item.after, group) for item in group.instances.values()]
    for item in group.groups.values():
        yield from (name for name in _outward_dependencies(item) if not _is_in(name.text, group))
        if isinstance(item.tree, Group):
            inner.append((item.tree.after, group))
    for names, scope in inner:
        yield from (n for n in names if scope.lookup(n.text) and not _is_in(n.text, scope))


def _is_in(name: str, scope: DeploymentScope) -> bool:
    return name in scope.instances or name in scope.groups


def _sorted(instances: Sequence[Instance], farther: Sequence[str], report: Report) -> list[str]:
    """The names of one scope in a stable topological order.

    Members of a cycle keep their written order; `farther` are names outside the scope.
    """
    known = {item.name.text: item for item in instances}
    waits = {name: _known_names(item, known, farther, report) for name, item in known.items()}
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
        report_unknown_name(
            report,
            codes.UNKNOWN_INSTANCE,
            name,
            f"`{instance.name.text}` waits for `{name.text}`, which is not in this deployment",
            [*known, *farther],
            _others(instance, [*known, *farther]),
            declared=[item.name.span for item in known.values()],
        )
    return found


def _others(instance: Instance, known: Sequence[str]) -> str:
    others = [item for item in known if item != instance.name.text]
    return f"in it are {join_names(others)}" if others else "nothing else is in it"


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
            Note(waits[item][other].span, f"`{item}` waits for `{other}` here")
            for item, other in steps[1:]
        ],
        help="remove one of these `after`: a requirement alone needs none",
    )
