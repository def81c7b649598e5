"""The boxes of a state diagram and what is in each of them, laid out.

In: a state machine. Out: `Level`s within levels. Each is a graph of its own. A transition that
leads out of a box, or into one, goes to a point on its border inside and from there on outside;
from which side is known from the ranks outside, which need no sizes. So ranks are found from the
outermost box inwards, sizes and places on the way back.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from robocomp_dsl.generate.doc import layered
from robocomp_dsl.generate.doc.drawing import LINE, text_width
from robocomp_dsl.generate.doc.graph import label_size
from robocomp_dsl.generate.doc.state_words import Pair, lines_of, shown
from robocomp_dsl.model.statemachine import State, StateMachine

LEAST = 72.0
DOT = 12.0
INSET = 18.0
HEAD = LINE + 10.0
"""Height of the head of a box with states in it."""


@dataclass(frozen=True, slots=True)
class Crossing:
    """A line through the border of a box; `inside` is the state in it that is or holds its end.

    `out` tells its direction, `right` the side of the box; one that `ends` goes no further.
    """

    pair: Pair
    inside: str
    out: bool
    right: bool
    ends: bool = False


@dataclass(frozen=True, slots=True)
class Way:
    """A line between two nodes of a level; `arrow` where it ends at its target."""

    source: int
    target: int
    pair: Pair
    labels: tuple[str, ...] = ()
    arrow: bool = True


@dataclass(slots=True)
class Level:
    """What is in one box, and where. The nodes: states, crossings, and the dot if there is one.

    `width` and `height` are those of the whole box; `left` and `top` of its contents in it.
    """

    states: tuple[State, ...]
    crossings: list[Crossing]
    ways: list[Way]
    nodes: list[layered.Node] = field(default_factory=list)
    inner: dict[int, Level] = field(default_factory=dict)
    made: layered.Layout = field(default_factory=lambda: layered.layout((), ()))
    width: float = 0.0
    height: float = 0.0
    left: float = 0.0
    top: float = 0.0

    def crosses_at(self, pair: Pair) -> float | None:
        """How far from the top of the box a line crosses its border; None for one that does not."""
        for i, one in enumerate(self.crossings, len(self.states)):
            if one.pair == pair:
                return self.top + self.made.nodes[i][1]
        return None


@dataclass(frozen=True, slots=True)
class Levels:
    """Lays out the boxes of one machine. `home` is the box of each state, "" the outermost one."""

    home: Mapping[str, str]
    lines: Mapping[Pair, tuple[str, ...]]

    def level(self, name: str, states: tuple[State, ...], passing: Sequence[Crossing]) -> Level:
        """The box `name`, through whose border lines are `passing`; its size is left to do."""
        crossings = [*passing, *self._own_crossings(name)]
        made = Level(states, crossings, [])
        at = {state.name: i for i, state in enumerate(states)}
        made.ways = [*self._ways(name, at), *_crossing_ways(crossings, at, self.lines)]
        nodes = [_node(state) for state in states]
        nodes += [layered.Node(0, 0, "last" if one.right else "first") for one in crossings]
        begins = [i for i, state in enumerate(states) if state.initial and not state.history]
        if begins:
            made.ways += [Way(len(nodes), i, ("", states[i].name)) for i in begins]
            nodes.append(layered.Node(DOT, DOT))
        bare = [layered.Edge(way.source, way.target) for way in made.ways]
        ranks = layered.ranks_of(nodes, bare)
        made.nodes = layered.roomy(nodes, bare, ranks)
        for i, state in enumerate(states):
            if state.inside:
                inside = self._passing(i, state.name, made.ways, ranks)
                inner = _measured(self.level(state.name, state.inside, inside), shown(state))
                made.inner[i] = inner
                made.nodes[i] = layered.Node(inner.width, inner.height)
        made.made = layered.layout(made.nodes, [_edge(way, made) for way in made.ways], ranks)
        return made

    def _own_crossings(self, name: str) -> list[Crossing]:
        """Lines between this state itself and what is inside it: they end at its border inside."""
        made = []
        for pair in self.lines:
            source, target = pair
            if target == name and source != name and name in self._around(source):
                made.append(Crossing(pair, self._child(source, name), True, True, True))
            elif source == name and target != name and name in self._around(target):
                made.append(Crossing(pair, self._child(target, name), False, False, True))
        return made

    def _ways(self, name: str, at: Mapping[str, int]) -> list[Way]:
        """Lines between two states of this box, or between what is inside them."""
        made = []
        for pair, labels in self.lines.items():
            source, target = (self._child(one, name) for one in pair)
            if source in at and target in at and (source != target or pair[0] == pair[1] == source):
                arrow = target == pair[1]
                made.append(Way(at[source], at[target], pair, labels, arrow))
        return made

    def _passing(
        self, node: int, name: str, ways: Sequence[Way], ranks: layered.Ranks
    ) -> list[Crossing]:
        """The lines that pass the border of one of the states of a level."""
        made = []
        for i, way in enumerate(ways):
            if way.source == way.target:
                continue
            turned = i in ranks.turned
            if way.source == node and way.pair[0] not in ("", name):
                made.append(Crossing(way.pair, self._child(way.pair[0], name), True, not turned))
            if way.target == node and way.pair[1] != name:
                made.append(Crossing(way.pair, self._child(way.pair[1], name), False, turned))
        return made

    def _around(self, state: str) -> list[str]:
        """The boxes around a state, the innermost first."""
        made = []
        while state:
            state = self.home.get(state, "")
            made.append(state)
        return made

    def _child(self, state: str, box: str) -> str:
        """The state in `box` that is `state` or around it; "" if there is none."""
        while state and self.home.get(state, "") != box:
            state = self.home.get(state, "")
        return state


def _crossing_ways(
    crossings: Sequence[Crossing], at: Mapping[str, int], lines: Mapping[Pair, tuple[str, ...]]
) -> list[Way]:
    """The lines between the border and what is inside; the label is where the line ends or begins.

    Of a line that goes on outside, it is there.
    """
    made = []
    for i, one in enumerate(crossings, len(at)):
        labels = lines[one.pair] if one.ends else ()
        inside = at[one.inside]
        if one.out:
            made.append(Way(inside, i, one.pair, labels, one.ends))
        else:
            made.append(Way(i, inside, one.pair, labels, one.inside == one.pair[1]))
    return made


def _edge(way: Way, level: Level) -> layered.Edge:
    source, target = level.inner.get(way.source), level.inner.get(way.target)
    leaves = source.crosses_at(way.pair) if source else None
    enters = target.crosses_at(way.pair) if target else None
    size = label_size([(one, None) for one in way.labels])
    return layered.Edge(way.source, way.target, *size, leaves, enters)


def _node(state: State) -> layered.Node:
    return layered.Node(max(LEAST, text_width(shown(state)) + 28), LINE + 17)


def _measured(level: Level, title: str = "") -> Level:
    """The size of a box with its head; the outermost one has neither head nor border."""
    inner = level.made
    room = INSET if title else 0.0
    level.width = max(inner.width, text_width(title)) + 2 * room
    level.left = (level.width - inner.width) / 2
    level.top = HEAD + room * 0.8 if title else 0.0
    level.height = level.top + inner.height + room
    return level


def levels_of(machine: StateMachine) -> Level:
    """The outermost box of a machine, with all others in it."""
    home: dict[str, str] = {}
    todo = [("", one) for one in machine.states]
    while todo:
        box, state = todo.pop()
        home[state.name] = box
        todo += [(state.name, one) for one in state.inside]
    return _measured(Levels(home, lines_of(machine)).level("", machine.states, ()))
